// The distance test (Concheiro 3.2.2): how far the vertices that a split would insert, the middles of the edges, are from the triangle.
// requires: shared/leaf_sample.wgsl

fn half_size(leaf: Place, is_pair: bool) -> f32 {
    var size = 0.0;
    var start = leaf_sample(leaf, is_pair, corner_quarters(2u));
    for (var i = 0u; i < 3u; i++) {
        let end = leaf_sample(leaf, is_pair, corner_quarters(i));
        let inserted = leaf_sample(leaf, is_pair, (corner_quarters(i) + corner_quarters((i + 2u) % 3u)) / 2u);
        size = max(size, length(inserted - start - 0.5 * (end - start)));
        start = end;
    }
    return size;
}
