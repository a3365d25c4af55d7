// Points of a leaf for metrics that sample the surface. Such a metric defines `fn half_size(leaf: Place, is_pair: bool) -> f32` of one
// triangle, that of a leaf or of the pair of which it is the even half. Both halves of a diamond get the larger of theirs, since a diamond
// splits only if both want to.
// requires: shared/grid.wgsl, shared/neighbour.wgsl, shared/surface.wgsl

// The surface at (a, b) quarters of the legs: O (0, 0), R (4, 0), U (0, 4).
fn leaf_sample(leaf: Place, is_pair: bool, quarters: vec2u) -> vec3f {
    return surface_point(leaf.face, grid_coord(leaf, is_pair, quarters.x, quarters.y, 2u));
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
        size = max(size, half_size(node, false));
        node = neighbour_h(leaf);
    }
    return size;
}
