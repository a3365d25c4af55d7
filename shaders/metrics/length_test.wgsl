// The length test (Concheiro 3.2.2): how far the middle of an edge is from its ends.
// requires: shared/leaf_sample.wgsl

fn half_size(leaf: Place, is_pair: bool) -> f32 {
    var size = 0.0;
    var start = leaf_sample(leaf, is_pair, corner_quarters(2u));
    for (var i = 0u; i < 3u; i++) {
        let end = leaf_sample(leaf, is_pair, corner_quarters(i));
        size = max(size, 0.5 * length(end - start));
        start = end;
    }
    return size;
}
