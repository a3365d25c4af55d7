// A leaf's exact place in its root: ARCHITECTURE section 1 "leaf space", "root space". All integers, 31 fraction bits, so that nothing
// rounds at any level. `x`, `y` are the root-space coordinates of the leaf's O corner; its unit is ONE >> level.

const ONE: u32 = 0x80000000u;
const MAX_LEVEL: u32 = 31u;
const NONE: u32 = 0xffffffffu;

struct Place {
    face: u32,
    root: u32,
    x: u32,
    y: u32,
    orientation: u32,
    level: u32,
}

// A point of a face: weights of corner `root` (x) and of the next corner (y); the centre has the rest, ONE - x - y.
struct FaceCoord {
    root: u32,
    x: u32,
    y: u32,
}

// The image of (1, 0) under `orientation` quarter turns. The image of (0, 1) is axis(orientation + 1).
fn axis(orientation: u32) -> vec2i {
    let o = orientation & 3u;
    let sign = 1 - i32(o & 2u);
    return select(vec2i(sign, 0), vec2i(0, sign), (o & 1u) == 1u);
}

fn unit(level: u32) -> u32 {
    return ONE >> level;
}

// The point O + a A + b B of a leaf, a and b in root-space units (wrapping arithmetic: every result is in 0..=ONE).
fn offset(leaf: Place, a: u32, b: u32) -> vec2u {
    let x_axis = vec2u(axis(leaf.orientation));
    let y_axis = vec2u(axis(leaf.orientation + 1u));
    return vec2u(leaf.x, leaf.y) + x_axis * a + y_axis * b;
}

// Exact below 2^24, correctly rounded above: value * 2^-31.
fn fixed_to_float(value: u32) -> f32 {
    return f32(value) * 4.656612873077393e-10;
}
