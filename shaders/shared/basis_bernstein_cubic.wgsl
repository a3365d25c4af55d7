// `basis_bernstein` for degrees up to 3, its loops written out. Twin: keyleaf-surface `basis`.
// requires: shared/patch_cubic.wgsl

fn cubic_basis(span: u32, degree: u32, f: f32, g: f32) -> CubicBasis {
    var value = vec4f(g, f, 0.0, 0.0);
    var slope = vec3f(1.0, 0.0, 0.0); // those of degree p - 1
    if degree > 1u {
        slope = value.xyz;
        value = vec4f(g * slope.x, f * slope.x + g * slope.y, f * slope.y, 0.0);
    }
    if degree > 2u {
        slope = value.xyz;
        value = vec4f(g * slope.x, f * slope.x + g * slope.y, f * slope.y + g * slope.z, f * slope.z);
    }
    return CubicBasis(value, slope);
}
