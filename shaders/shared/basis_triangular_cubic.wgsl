// `basis_triangular` for degrees up to 3, its loops written out. Twin: keyleaf-surface `basis`.
// requires: shared/patch_cubic.wgsl

fn cubic_basis(span: u32, degree: u32, f: f32, g: f32) -> CubicBasis {
    var left = vec3f(f);
    var right = vec3f(g);
    var value = vec4f(g, f, 0.0, 0.0);
    var slope = vec3f(1.0, 0.0, 0.0); // those of degree p - 1 over the sums of knots
    if degree > 1u {
        left.y += bitcast<f32>(surface_b[span]);
        right.y += bitcast<f32>(surface_b[span + degree - 1u]);
        slope = vec3f(value.xy / vec2f(right.x + left.y, right.y + left.x), 0.0);
        value = vec4f(right.x * slope.x, left.y * slope.x + right.y * slope.y, left.x * slope.y, 0.0);
    }
    if degree > 2u {
        left.z += bitcast<f32>(surface_b[span + 1u]);
        right.z += bitcast<f32>(surface_b[span + 3u]);
        slope = value.xyz / vec3f(right.x + left.z, right.y + left.y, right.z + left.x);
        value = vec4f(right.x * slope.x, left.z * slope.x + right.y * slope.y, left.y * slope.y + right.z * slope.z, left.x * slope.z);
    }
    return CubicBasis(value, slope);
}
