// A pair by its parent, where sizes are lengths.
// requires: pairs/about_leg.wgsl, shared/surface.wgsl

fn pair_size(half: Place) -> f32 {
    let whole = pair_bound(half);
    return whole.times * HALF_LEVEL * metric_size(whole.node, surface_bound(whole.node));
}
