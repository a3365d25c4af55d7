// B-spline basis functions by Bézier extraction, to compare with: Bernstein polynomials times a matrix a span, made on the CPU.
// Function k is row k of the matrix.
// requires: shared/patch_basis.wgsl

fn basis(span: u32, degree: u32, f: f32, g: f32) -> Basis {
    var bernstein: array<f32, 8>;
    var lower: array<f32, 9>; // of degree p - 1, from index 1 on
    bernstein[0] = 1.0;
    for (var j = 1u; j <= degree; j++) {
        var saved = 0.0;
        for (var r = 0u; r < j; r++) {
            let before = bernstein[r];
            lower[r + 1u] = before;
            bernstein[r] = saved + g * before;
            saved = f * before;
        }
        bernstein[j] = saved;
    }
    var n: Basis;
    var slope = 0.0;
    for (var k = 0u; k <= degree; k++) {
        for (var m = 0u; m <= degree; m++) {
            let weight = bitcast<f32>(surface_b[span + (degree + 1u) * k + m]);
            n.value[k] += weight * bernstein[m];
            // The derivative of function m, over p; the slopes are the sums that its differences undo.
            slope -= weight * (lower[m] - select(lower[m + 1u], 0.0, m == degree));
        }
        n.slope[k] = slope;
    }
    return n;
}
