// Khoury 2.1: LoD = -log2(distance tan(fovy / 2) / (sqrt 2 factor)). Level < LoD asks for a split, so that the metric over threshold
// is 2^(LoD - level) and its size sqrt 2 * 2^-level, whatever the length of the edge.
// requires: shared/place.wgsl, shared/surface.wgsl

fn metric_size(leaf: Place, bound: SurfaceBound) -> f32 {
    return 1.4142135 * exp2(-f32(leaf.level));
}
