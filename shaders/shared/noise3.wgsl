// Gradient noise in three dimensions (Perlin, "Improving Noise", SIGGRAPH 2002, quintic fade) with its gradient. The gradients of
// the lattice points are uniform in the cube [-1, 1)^3, in 16 bits a component, exact in f32. Twin: keyleaf-surface `noise`.
// requires: shared/hash.wgsl

// The suprema of the noise and of its slope in any direction: sums of absolute weights, greatest in the middle of a cell.
const NOISE3_LARGEST: f32 = 1.5;
const NOISE3_SLOPE: f32 = 4.625;

fn lattice_gradient3(cell: vec3u, seed: u32) -> vec3f {
    return vec3f(vec3i(hash3(cell, seed) >> vec3u(16u)) - vec3i(32768)) * 3.0517578125e-5;
}

// (value, gradient) at `cell` + f, f in 0..1.
fn noise3(cell: vec3u, f: vec3f, seed: u32) -> vec4f {
    let s = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let ds = 30.0 * f * f * (f - 1.0) * (f - 1.0);
    var sum = vec4f(0.0);
    for (var corner = 0u; corner < 8u; corner++) {
        let offset = vec3u(corner & 1u, (corner >> 1u) & 1u, corner >> 2u);
        let is_far = offset == vec3u(1u);
        let g = lattice_gradient3(cell + offset, seed);
        let d = dot(g, f - vec3f(offset));
        let w = select(1.0 - s, s, is_far);
        let dw = select(-ds, ds, is_far);
        sum += vec4f(w.x * w.y * w.z * d,
            w.x * w.y * w.z * g + d * vec3f(dw.x * w.y * w.z, w.x * dw.y * w.z, w.x * w.y * dw.z));
    }
    return sum;
}
