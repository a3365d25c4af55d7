// The parameters (u, v) of a point of a four-cornered face, whose corners 0..3 are (0, 0), (1, 0), (1, 1), (0, 1): exact at every
// level, with 32 fraction bits, since the centre has the parameters 1/2. Twin: keyleaf-surface `quad_coord`.
// requires: shared/place.wgsl

struct QuadCoord {
    u: u32, // 2^-32; 0 where u = 1
    v: u32,
    u_is_one: bool,
    v_is_one: bool,
}

fn quad_coord(at: FaceCoord) -> QuadCoord {
    let r = at.root;
    // u is 1 at corners 1 and 2, v at corners 2 and 3.
    let u_corners = at.x * (((r + 1u) >> 1u) & 1u) + at.y * (((r + 2u) >> 1u) & 1u);
    let v_corners = at.x * ((r >> 1u) & 1u) + at.y * (((r + 1u) >> 1u) & 1u);
    let z = ONE - at.x - at.y;
    return QuadCoord(z + 2u * u_corners, z + 2u * v_corners, u_corners == ONE, v_corners == ONE);
}

// value * 2^-32, correctly rounded.
fn fraction_to_float(value: u32) -> f32 {
    return f32(value) * 2.3283064365386963e-10;
}

fn parameter(value: u32, is_one: bool) -> f32 {
    return select(fraction_to_float(value), 1.0, is_one);
}

// 1 - parameter: the subtraction is done in integers.
fn complement(value: u32, is_one: bool) -> f32 {
    return select(select(fraction_to_float(0u - value), 1.0, value == 0u), 0.0, is_one);
}

// parameter - origin in 2^-32, rounded once: exact where the difference has 24 bits.
fn parameter_difference(value: u32, is_one: bool, origin: u32) -> f32 {
    if is_one {
        return select(f32(0u - origin), 4294967296.0, origin == 0u);
    }
    return select(-f32(origin - value), f32(value - origin), value >= origin);
}
