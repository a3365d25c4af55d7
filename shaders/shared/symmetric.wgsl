// Symmetric 3 x 3 matrices.

struct Symmetric {
    diagonal: vec3f,
    opposite: vec3f, // yz, xz, xy: beside the diagonal, without the row and column of this number
}

fn times(s: Symmetric, v: vec3f) -> vec3f {
    return s.diagonal * v + s.opposite.zxy * v.yzx + s.opposite.yzx * v.zxy;
}

// Matrices are about 1. Pivots below this are rounding, and with values up to LARGEST nothing overflows.
const LEAST_PIVOT: f32 = 1e-15;
const LARGEST: f32 = 1e19;

fn in_range(v: vec3f) -> vec3f {
    return clamp(v, vec3f(-LARGEST), vec3f(LARGEST));
}
