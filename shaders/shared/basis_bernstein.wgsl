// Bernstein polynomials by their recurrence, which neither cancels nor goes negative. Twin: keyleaf-surface `basis`.
// requires: shared/patch_basis.wgsl

fn basis(span: u32, degree: u32, f: f32, g: f32) -> Basis {
    var n: Basis;
    n.value[0] = 1.0;
    for (var j = 1u; j <= degree; j++) {
        var saved = 0.0;
        for (var r = 0u; r < j; r++) {
            let before = n.value[r];
            n.slope[r] = before; // those of degree p - 1 stay
            n.value[r] = saved + g * before;
            saved = f * before;
        }
        n.value[j] = saved;
    }
    return n;
}
