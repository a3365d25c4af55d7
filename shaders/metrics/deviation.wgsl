// How far the surface is from the flat triangles of a leaf: a length in object units, as if of one triangle of the leaf's level. By bounds
// of its second derivatives it falls to a quarter from level to level; where these are large, as beside extraordinary vertices, by the
// speed of the surface, with which a point is so near to the corners, weighted as in the triangle. Nested.
// requires: shared/place.wgsl, shared/surface.wgsl, shared/frame.wgsl

// Times the size: the mean distance of a triangle's corners from a point, by the weights of the point. The largest is that at 3/8, 3/8, 1/4.
const FARTHEST: f32 = 1.125;

fn metric_size(leaf: Place, bound: SurfaceBound) -> f32 {
    // A grid divides deviations by 4^k, but this one by 2^k.
    return min(bound.deviation, FARTHEST * bound.size * f32(1u << frame.base_grid));
}
