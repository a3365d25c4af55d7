// B-spline basis functions by the recursion of Cox and de Boor, each by itself, to compare with: what Concheiro's thesis compares the
// stair strategy with (table 6.2).
// requires: shared/basis_slopes.wgsl

fn basis_values(knots: ptr<function, Knots>, degree: u32) -> array<f32, 8> {
    var n: array<f32, 8>;
    for (var k = 0u; k <= degree; k++) {
        // Functions s = k, k + 1, … count from the first that is not zero; only number `degree` is one at degree 0.
        var below: array<f32, 9>;
        below[degree - k] = 1.0;
        for (var d = 1u; d <= degree; d++) {
            for (var m = 0u; m + d <= degree; m++) {
                let s = k + m;
                var sum = 0.0;
                if below[m] > 0.0 { // 0/0 counts as 0
                    let u = (*knots).left[degree + 1u - s];
                    sum += u / (u + (*knots).right[s + d - degree]) * below[m];
                }
                if below[m + 1u] > 0.0 {
                    let u = (*knots).right[s + d + 1u - degree];
                    sum += u / (u + (*knots).left[degree - s]) * below[m + 1u];
                }
                below[m] = sum;
            }
        }
        n[k] = below[0];
    }
    return n;
}
