// Screen-space metric: the projected radius of a ball about the hypotenuse that holds for both halves of a diamond (Khoury 2.3.1 with
// the nested radius of ARCHITECTURE section 3). The size is a length in object units; pixels a radian over the target make the scale.
// requires: shared/place.wgsl, shared/surface.wgsl

fn metric_size(leaf: Place, bound: SurfaceBound) -> f32 {
    return bound.size;
}
