// A pair by what bounds the halves of its parent; see `metrics/deviation.wgsl`.
// requires: shared/place.wgsl, shared/neighbour.wgsl, shared/surface.wgsl, shared/frame.wgsl

fn pair_size(even: Place) -> f32 {
    let bound = surface_bound(place_parent(even, place_digit(even)));
    return min(bound.pair_deviation, FARTHEST * bound.size * f32(1u << frame.base_grid));
}
