// Triangles are marked with how far their vertices have come from the edges that they divide to the surface, 0 to 1: the least of a vertex
// and those around it.
// requires: draw/vertex.wgsl, shared/grid_edges.wgsl

fn leaf_mark(slot: u32, place: Place, is_pair: bool, i: u32, j: u32, here: vec3f) -> u32 {
    let k = frame.base_grid;
    let at = vec2i(vec2u(i, j));
    var least = vertex_part(place.face, grid_coord(place, is_pair, i, j, k), here);
    for (var edge = 0u; edge < 6u; edge++) {
        let there = at + grid_step(vec2u(i, j), edge, k);
        if is_on_grid(there, 1i << k) {
            let beside = grid_coord(place, is_pair, u32(there.x), u32(there.y), k);
            least = min(least, vertex_part(place.face, beside, surface_point(place.face, beside)));
        }
    }
    return pack2x16float(vec2f(0.0, least));
}
