// Gradient noise in two dimensions (Perlin, "Improving Noise", SIGGRAPH 2002, quintic fade) with its gradient. The gradients of
// the lattice points are uniform in the square [-1, 1)^2, in 16 bits a component, exact in f32. Twin: keyleaf-surface `noise`.
// requires: shared/hash.wgsl

// The suprema of the noise and of its slope in any direction: sums of absolute weights, greatest in the middle of a cell.
const NOISE2_LARGEST: f32 = 1.0;
const NOISE2_SLOPE: f32 = 2.75;

fn lattice_gradient2(cell: vec2u, seed: u32) -> vec2f {
    return vec2f(vec2i(hash2(cell, seed) >> vec2u(16u)) - vec2i(32768)) * 3.0517578125e-5;
}

// (value, gradient) at `cell` + f, f in 0..1. The lattice repeats: its coordinates are taken modulo mask + 1.
fn noise2(cell: vec2u, mask: u32, f: vec2f, seed: u32) -> vec3f {
    let s = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let ds = 30.0 * f * f * (f - 1.0) * (f - 1.0);
    let far = (cell + 1u) & vec2u(mask);
    let g00 = lattice_gradient2(cell, seed);
    let g10 = lattice_gradient2(vec2u(far.x, cell.y), seed);
    let g01 = lattice_gradient2(vec2u(cell.x, far.y), seed);
    let g11 = lattice_gradient2(far, seed);
    let d00 = dot(g00, f);
    let d10 = dot(g10, f - vec2f(1.0, 0.0));
    let d01 = dot(g01, f - vec2f(0.0, 1.0));
    let d11 = dot(g11, f - vec2f(1.0, 1.0));
    let g0 = mix(g00, g10, s.x);
    let g1 = mix(g01, g11, s.x);
    let d0 = mix(d00, d10, s.x);
    let d1 = mix(d01, d11, s.x);
    let gradient = mix(g0, g1, s.y) + ds * vec2f(mix(d10 - d00, d11 - d01, s.y), d1 - d0);
    return vec3f(mix(d0, d1, s.y), gradient);
}
