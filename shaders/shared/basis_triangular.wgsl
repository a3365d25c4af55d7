// B-spline basis functions by the triangular table of Piegl and Tiller, "The NURBS Book", algorithm A2.2: sums of positive terms, so
// that the error is a few units in the last place whatever the knots. On a span that is not empty no 0/0 occurs.
// Twin: keyleaf-surface `basis`.
// requires: shared/knot_span.wgsl

fn basis(span: u32, degree: u32, f: f32, g: f32) -> Basis {
    var knots = knots_about(span, degree, f, g);
    var n: Basis;
    n.value[0] = 1.0;
    for (var j = 1u; j <= degree; j++) {
        var saved = 0.0;
        for (var r = 0u; r < j; r++) {
            let quotient = n.value[r] / (knots.right[r + 1u] + knots.left[j - r]);
            n.slope[r] = quotient; // those of degree p - 1 stay
            n.value[r] = saved + knots.right[r + 1u] * quotient;
            saved = knots.left[j - r] * quotient;
        }
        n.value[j] = saved;
    }
    return n;
}
