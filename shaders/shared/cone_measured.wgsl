// A cone about the normals of all triangles that a leaf is drawn as, for culling those that face away (Concheiro 6.4.1, dice culling;
// there each dice is tested in each frame). It is kept behind the parents: axis, and the cosine of its angle; 0 where there is none.
// requires: shared/place.wgsl, shared/grid.wgsl, shared/surface.wgsl, shared/direction.wgsl

fn grid_point(leaf: Place, is_pair: bool, i: u32, j: u32) -> vec3f {
    return surface_point(leaf.face, grid_coord(leaf, is_pair, i, j, frame.base_grid));
}

// The least cosine between the axis and the normal of a triangle; one without area says nothing.
fn least_cosine(least: f32, axis: vec3f, a: vec3f, b: vec3f, c: vec3f) -> f32 {
    let normal = cross_direction(b - a, c - a);
    return select(min(least, dot(normal, axis)), least, all(normal == vec3f(0.0)));
}

fn grid_cosine(leaf: Place, is_pair: bool, axis: vec3f) -> f32 {
    let side = 1u << frame.base_grid;
    var least = 1.0;
    for (var j = 0u; j < side; j++) {
        var low = grid_point(leaf, is_pair, 0u, j);
        var high = grid_point(leaf, is_pair, 0u, j + 1u);
        for (var i = 0u; i + j < side; i++) {
            let next_low = grid_point(leaf, is_pair, i + 1u, j);
            least = least_cosine(least, axis, low, next_low, high);
            if i + j + 1u < side {
                let next_high = grid_point(leaf, is_pair, i + 1u, j + 1u);
                least = least_cosine(least, axis, next_low, next_high, high);
                high = next_high;
            }
            low = next_low;
        }
    }
    return least;
}

fn keep_cone(slot: u32, leaf: Place, digit: u32) {
    let side = 1u << frame.base_grid;
    let corner = grid_point(leaf, false, 0u, 0u);
    let axis = cross_direction(grid_point(leaf, false, side, 0u) - corner, grid_point(leaf, false, 0u, side) - corner);
    var cosine = grid_cosine(leaf, false, axis);
    if digit != ROOT_DIGIT && (digit & 1u) == 0u {
        cosine = min(cosine, grid_cosine(leaf, true, axis));
    }
    parents[frame.capacity + slot] = select(vec4f(0.0), vec4f(axis, cosine), cosine > 0.0);
}
