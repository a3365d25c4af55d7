// A pair by its parent, where sizes are lengths.
// requires: shared/place.wgsl, shared/neighbour.wgsl, shared/surface.wgsl

fn pair_size(even: Place) -> f32 {
    let parent = place_parent(even, place_digit(even));
    return HALF_LEVEL * metric_size(parent, surface_bound(parent));
}
