// The size of the larger of the two pairs on both sides of a leg, or of those of the roots of a face with four corners. A file beside this
// one defines `pair_size`: what a half says of its pair, of which both halves together have the size.
// requires: shared/place.wgsl, shared/neighbour.wgsl

// `even` is the even half of one: child 0 or 2 (its digit) of a node that has the leg, or root 0.
fn larger_pair(even: Place, digit: u32) -> f32 {
    var half = even;
    var size = 0.0;
    // All of a pair is in the parent of its even half; over a pair of roots there is no parent.
    for (var i = 0u; i < select(2u, 4u, digit == ROOT_DIGIT); i++) {
        size = max(size, pair_size(half));
        if digit == ROOT_DIGIT {
            half.root += 1u;
        } else {
            half = place_child(across_outer_leg(even, digit), 2u - digit);
        }
    }
    return size;
}

// What bounds a pair: the parent of its halves. Over roots there is none; it is to be twice as large as they are.
struct PairBound {
    node: Place,
    times: f32,
}

fn pair_bound(half: Place) -> PairBound {
    if half.level == 0u {
        return PairBound(half, 2.0);
    }
    return PairBound(place_parent(half, place_digit(half)), 1.0);
}
