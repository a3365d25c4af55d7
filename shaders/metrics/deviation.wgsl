// How far the surface is from flat triangles of the leaf's level, by bounds of its second derivatives: a length in object units that
// falls to a quarter from level to level. Nested.
// requires: shared/place.wgsl, shared/surface.wgsl

fn metric_size(leaf: Place, bound: SurfaceBound) -> f32 {
    return bound.deviation;
}
