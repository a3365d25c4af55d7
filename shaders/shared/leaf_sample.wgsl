// Points of a leaf for metrics that sample the surface. Such a metric defines `fn half_size(leaf: Place) -> f32` of one triangle; both
// halves of a diamond get the larger of theirs, since a diamond splits only if both want to.
// requires: shared/place.wgsl, shared/neighbour.wgsl, shared/surface.wgsl

// The surface at (a, b) quarters of the legs of a leaf: O (0, 0), R (4, 0), U (0, 4).
fn leaf_sample(leaf: Place, quarters: vec2u) -> vec3f {
    let quarter = unit(leaf.level) >> 2u;
    let at = offset(leaf, quarter * quarters.x, quarter * quarters.y);
    return surface_point(leaf.face, FaceCoord(leaf.root, at.x, at.y));
}

// Corner 0, 1, 2 is O, R, U.
fn corner_quarters(corner: u32) -> vec2u {
    return vec2u(select(0u, 4u, corner == 1u), select(0u, 4u, corner == 2u));
}

fn metric_size(leaf: Place, bound: SurfaceBound) -> f32 {
    if leaf.level + 2u > MAX_LEVEL { // no quarters of a leg are left
        return 0.0;
    }
    var size = 0.0;
    var node = leaf;
    for (var half = 0u; half < 2u && node.face != NONE; half++) {
        size = max(size, half_size(node));
        node = neighbour_h(leaf);
    }
    return size;
}
