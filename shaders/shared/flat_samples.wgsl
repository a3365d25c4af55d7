// Samples of the flat test. The test defines `fn flat_size(edge: vec3f, arm: vec3f) -> f32` of an edge and the way from one of its ends
// to a point of the surface between them.
// requires: shared/leaf_sample.wgsl

// Departure: two samples an edge, at its quarters. One in the middle misses an edge that is bent like an S.
fn half_size(leaf: Place, is_pair: bool) -> f32 {
    var size = 0.0;
    var start = leaf_sample(leaf, is_pair, corner_quarters(2u));
    for (var i = 0u; i < 3u; i++) {
        let end = leaf_sample(leaf, is_pair, corner_quarters(i));
        for (var side = 1u; side < 4u; side += 2u) {
            let between = (side * corner_quarters(i) + (4u - side) * corner_quarters((i + 2u) % 3u)) / 4u;
            let inserted = leaf_sample(leaf, is_pair, between);
            size = max(size, max(flat_size(end - start, inserted - start), flat_size(start - end, inserted - end)));
        }
        start = end;
    }
    return size;
}
