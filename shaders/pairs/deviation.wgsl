// A pair by what bounds the halves of its parent; see `metrics/deviation.wgsl`.
// requires: pairs/about_leg.wgsl, shared/surface.wgsl, shared/frame.wgsl

fn pair_size(half: Place) -> f32 {
    let whole = pair_bound(half);
    let bound = surface_bound(whole.node);
    let by_speed = whole.times * FARTHEST * bound.size * f32(1u << frame.base_grid);
    return min(whole.times * whole.times * bound.pair_deviation, by_speed);
}
