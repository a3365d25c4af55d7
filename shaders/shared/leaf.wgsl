// The arrays that a leaf owns, by slot. A leaf stays in its slot as long as it lives (but for the moves of `compact`), so that a
// leaf that stays is neither copied nor looked up. Rust: keyleaf `quadtree::layout`.
// requires: shared/place.wgsl

struct Leaf {
    // The key: a leading 1, then two bits a level, root first; face; root (low 16 bits).
    node_hi: u32,
    node_lo: u32,
    face: u32,
    root: u32,
    // The same, decoded once.
    x: u32,
    y: u32,
    orientation_level: u32, // orientation, level << 8
    entry: u32,             // of the leaf table
}

// What the surface and the metric said when the leaf was made: a frame needs nothing else to decide and to cull.
struct Measure {
    centre: vec3f,  // middle of the hypotenuse, relative to the origin
    radius: f32,    // for culling
    size: f32,      // numerator of the metric; 0 at the level limit
    guard: f32,     // radius for the guard band
    parent_size: f32,
    parent_radius: f32, // of an even child, for culling: a pair is drawn as half of the parent; of an even root, of its pair
}

// Word `slot` of the state: the published wish and the flags below.
//   bits 31..8: bits 30..7 of the f32 wish (metric over threshold, or a finer neighbour's), truncated to 16 bits of mantissa
const PAIR: u32 = 1u;     // drawn as half of a pair; it must be unless it is free
const FRESH: u32 = 2u;    // not yet published
const MATURE: u32 = 4u;   // was there when it published
const MERGE: u32 = 8u;    // the parent's metric is satisfied (published by child 0)
const DIGIT_SHIFT: u32 = 4u; // `kept_digit`, 0..5, in three bits
const FREE: u32 = 128u;   // the four nodes about the right angle are leaves: both pairs may be drawn, or none
const STATE_FLAGS: u32 = 0xffu;

// Whether C(n) is a leaf: then this one may not split, and must be half of a pair.
fn is_blocked(state: u32) -> bool {
    return (state & (PAIR | FREE)) == PAIR;
}

fn state_digit(state: u32) -> u32 {
    return (state >> DIGIT_SHIFT) & 7u;
}

fn state_wish(state: u32) -> f32 {
    return bitcast<f32>((state & ~STATE_FLAGS) >> 1u);
}

fn state_from_wish(wish: f32) -> u32 {
    return (bitcast<u32>(wish) << 1u) & ~STATE_FLAGS;
}

// The wish as it can be published: 16 bits of mantissa.
fn quantise(wish: f32) -> f32 {
    return bitcast<f32>(bitcast<u32>(wish) & 0x7fffff80u);
}

const BUCKETS: u32 = 32u;

// floor(log2 wish), for wish > 1, at most 31.
fn wish_bucket(wish: f32) -> u32 {
    return min((bitcast<u32>(wish) >> 23u) - 127u, BUCKETS - 1u);
}

fn leaf_place(leaf: Leaf) -> Place {
    return Place(leaf.face, leaf.root & 0xffffu, leaf.x, leaf.y, leaf.orientation_level & 3u, leaf.orientation_level >> 8u);
}

// A key with its decoded form; `entry` is set when it enters the table.
fn leaf_child(parent: Leaf, place: Place, digit: u32) -> Leaf {
    return Leaf((parent.node_hi << 2u) | (parent.node_lo >> 30u), (parent.node_lo << 2u) | digit, place.face, place.root,
        place.x, place.y, place.orientation | (place.level << 8u), NONE);
}

fn leaf_parent(child: Leaf, place: Place) -> Leaf {
    return Leaf(child.node_hi >> 2u, (child.node_lo >> 2u) | (child.node_hi << 30u), place.face, place.root,
        place.x, place.y, place.orientation | (place.level << 8u), NONE);
}
