// The size of the larger of the two pairs on both sides of a leg. A file beside this one defines `pair_size`.
// requires: shared/place.wgsl, shared/neighbour.wgsl

// `even` is the even half of one: child 0 or 2 (its digit) of a node that has the leg.
fn larger_pair(even: Place, digit: u32) -> f32 {
    var pair = even;
    var size = 0.0;
    for (var i = 0u; i < 2u; i++) {
        size = max(size, pair_size(pair));
        pair = place_child(across_outer_leg(even, digit), 2u - digit);
    }
    return size;
}
