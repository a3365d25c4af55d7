// The linear approximation test (Concheiro 6.9): the largest distance, at six points, between the surface and the flat triangle that
// would be drawn.
// requires: shared/leaf_sample.wgsl

fn half_size(leaf: Place, is_pair: bool) -> f32 {
    let o = leaf_sample(leaf, is_pair, vec2u(0u, 0u));
    let r = leaf_sample(leaf, is_pair, vec2u(4u, 0u)) - o;
    let u = leaf_sample(leaf, is_pair, vec2u(0u, 4u)) - o;
    var samples = array<vec2u, 6>(vec2u(2u, 2u), vec2u(0u, 2u), vec2u(2u, 0u), vec2u(1u, 1u), vec2u(2u, 1u), vec2u(1u, 2u));
    var size = 0.0;
    for (var i = 0u; i < 6u; i++) {
        let at = 0.25 * vec2f(samples[i]);
        size = max(size, length(leaf_sample(leaf, is_pair, samples[i]) - o - at.x * r - at.y * u));
    }
    return size;
}
