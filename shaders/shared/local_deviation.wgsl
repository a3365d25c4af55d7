// How far flat triangles are from a surface of four-cornered faces, by place: bounds for each cell of a face and one for each interval of
// a mesh edge. Twin: keyleaf-surface `patches/local_deviation`. The surface's parameters have the words of table B at which the bounds
// of cells and edges start, and how many levels of cells there are below a face: `cells`, `edges`, `depth`.
// requires: shared/place.wgsl, shared/quad_coord.wgsl, shared/diamond.wgsl

// The cell of a level beside a parameter in 2^-32: before it, or after it.
fn cell_before(value: u32, is_one: bool, level: u32) -> u32 {
    return select(((value - 1u) >> 1u) >> (31u - level), 0u, value == 0u && !is_one);
}

fn cell_after(value: u32, is_one: bool, level: u32) -> u32 {
    return select((value >> 1u) >> (31u - level), (1u << level) - 1u, is_one);
}

// The bounds of hypotenuses along u or v (axis 0, 1) in a cell, and of diagonal ones.
fn cell_bounds(face: u32, level: u32, i: u32, j: u32, axis: u32) -> vec2f {
    let cells_of_face = ((4u << (2u * surface.depth)) - 1u) / 3u;
    let first = face * cells_of_face + ((1u << (2u * level)) - 1u) / 3u;
    let at = surface.cells + 3u * (first + i + (j << level));
    return vec2f(bitcast<f32>(surface_b[at + axis]), bitcast<f32>(surface_b[at + 2u]));
}

// Of the triangles of the leaf's level, and of the halves of its own.
fn local_deviation(leaf: Place, centre: FaceCoord) -> vec2f {
    let level = min(leaf.level, surface.depth);
    let q = quad_coord(centre);
    let axis = (leaf.root + leaf.orientation) & 1u;
    let before = cell_bounds(leaf.face, level, cell_before(q.u, q.u_is_one, level), cell_before(q.v, q.v_is_one, level), axis);
    let after = cell_bounds(leaf.face, level, cell_after(q.u, q.u_is_one, level), cell_after(q.v, q.v_is_one, level), axis);
    var bound = max(before, after);
    if diamond_crosses_edge(leaf) {
        let first = (4u * leaf.face + leaf.root) * ((2u << surface.depth) - 1u) + (1u << level) - 1u;
        bound.x = bitcast<f32>(surface_b[surface.edges + first + (centre.y >> (31u - level))]);
    }
    let scale = level_scale(leaf.level);
    return bound * scale * scale;
}
