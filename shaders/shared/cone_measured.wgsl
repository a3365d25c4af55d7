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

// The least cosine of the triangles of a leaf, and of the pair that it may be half of: strip after strip, each vertex evaluated in one
// place, for shaders that compile in a moment.
fn grid_cosine(leaf: Place, axis: vec3f, may_be_pair: bool) -> f32 {
    let side = 1u << frame.base_grid;
    var least = 1.0;
    for (var way = 0u; way < select(1u, 2u, may_be_pair); way++) {
        for (var j = 0u; j < side; j++) {
            var before: vec3f;
            var last: vec3f;
            for (var k = 0u; k <= 2u * (side - j); k++) {
                let point = grid_point(leaf, way == 1u, k >> 1u, j + (k & 1u));
                if k >= 2u {
                    let is_turned = (k & 1u) == 0u;
                    least = least_cosine(least, axis, before, select(last, point, is_turned), select(point, last, is_turned));
                }
                before = last;
                last = point;
            }
        }
    }
    return least;
}

fn keep_cone(slot: u32, leaf: Place, digit: u32) {
    let side = 1u << frame.base_grid;
    var corners: array<vec3f, 3>;
    for (var i = 0u; i < 3u; i++) {
        corners[i] = grid_point(leaf, false, select(0u, side, i == 1u), select(0u, side, i == 2u));
    }
    let axis = cross_direction(corners[1] - corners[0], corners[2] - corners[0]);
    let may_be_pair = select((digit & 1u) == 0u, leads_pair_of_roots(leaf), digit == ROOT_DIGIT);
    let cosine = grid_cosine(leaf, axis, may_be_pair);
    parents[frame.capacity + slot] = select(vec4f(0.0), vec4f(axis, cosine), cosine > 0.0);
}
