// The same by the adjugate over the determinant (Komar 2020), to compare with: it squares the condition. Twin: keyleaf-surface
// `gaussian::solve`.
// requires: shared/symmetric.wgsl

struct Factors {
    is_definite: bool,
    adjugate: Symmetric,
    determinant: f32,
}

fn factors(s: Symmetric) -> Factors {
    let adjugate = Symmetric(s.diagonal.yzx * s.diagonal.zxy - s.opposite * s.opposite,
        s.opposite.yzx * s.opposite.zxy - s.diagonal * s.opposite);
    let determinant = s.diagonal.x * adjugate.diagonal.x + s.opposite.z * adjugate.opposite.z
        + s.opposite.y * adjugate.opposite.y;
    return Factors(determinant > LEAST_PIVOT, adjugate, determinant);
}

fn solve(f: Factors, right: vec3f) -> vec3f {
    return in_range(times(f.adjugate, right) / f.determinant);
}
