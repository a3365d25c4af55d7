// A pair as any triangle, by samples of the surface.
// requires: shared/leaf_sample.wgsl

fn pair_size(even: Place) -> f32 {
    if even.level + 2u > MAX_LEVEL { // no quarters of a leg are left: never a pair
        return 3e38;
    }
    return half_size(even, true);
}
