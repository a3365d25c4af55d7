// Slopes for methods that have values only: N(k, p-1) / D(k) from the functions of degree p - 1.
// The method defines `fn basis_values(knots: ptr<function, Knots>, degree: u32) -> array<f32, 8>`.
// requires: shared/knot_span.wgsl

fn basis(span: u32, degree: u32, f: f32, g: f32) -> Basis {
    var knots = knots_about(span, degree, f, g);
    var n: Basis;
    n.value = basis_values(&knots, degree);
    // Drivers give idle lanes a degree of 0, and their loops must end as well.
    n.slope = basis_values(&knots, max(degree, 1u) - 1u);
    for (var k = 0u; k < degree; k++) {
        n.slope[k] /= knots.right[k + 1u] + knots.left[degree - k];
    }
    return n;
}
