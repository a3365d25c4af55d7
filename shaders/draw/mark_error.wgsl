// Triangles are marked with how far they are from the surface, in pixels: the surface in the middle of the drawn edges at a vertex,
// from the middle of their ends. Six evaluations a vertex.
// requires: draw/vertex.wgsl, shared/shading.wgsl, shared/grid_edges.wgsl

fn leaf_mark(slot: u32, place: Place, is_pair: bool, i: u32, j: u32, here: vec3f) -> u32 {
    let k = frame.base_grid;
    if place.level + k >= MAX_LEVEL {
        return 0u;
    }
    let at = vec2i(vec2u(i, j));
    let n = 1i << k;
    var worst = 0.0;
    for (var edge = 0u; edge < 3u; edge++) {
        var step = grid_step(vec2u(i, j), edge, k);
        if !is_on_grid(at + step, n) {
            step = -step;
        }
        if !is_on_grid(at + step, n) || all(step == vec2i(0)) {
            continue;
        }
        let there = vec2u(at + step);
        let between = vec2u(2 * at + step);
        let end = drawn_frame(place.face, grid_coord(place, is_pair, there.x, there.y, k)).position;
        let middle = surface_point(place.face, grid_coord(place, is_pair, between.x, between.y, k + 1u));
        let away = middle - mix(here, end, 0.5);
        worst = max(worst, length((frame.world_from_object * vec4f(away, 0.0)).xyz));
    }
    let seen = frame.view_from_object * vec4f(here - frame.eye, 0.0);
    let clip = frame.clip_from_view * vec4f(seen.xyz, 1.0);
    let pixels = worst * shading.pixels_per_unit / max(clip.w, frame.near);
    return pack2x16float(vec2f(0.0, min(pixels, 60000.0)));
}
