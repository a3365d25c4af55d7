// A pair as any triangle, by samples of the surface.
// requires: shared/leaf_sample.wgsl

fn pair_size(half: Place) -> f32 {
    if half.level + 2u > MAX_LEVEL { // no quarters of a leg are left: never a pair
        return 3e38;
    }
    if half.level == 0u && (half.root & 1u) == 1u { // drawn by the other half
        return 0.0;
    }
    return half_size(half, true);
}
