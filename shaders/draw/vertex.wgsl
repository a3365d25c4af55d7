// The vertex shader of every drawn leaf: instance → visible leaf → vertex of the base grid → surface. The leaf carries its decoded
// place, so that nothing is decoded here. A file of `morph` defines where the vertex is drawn.
// requires: shared/leaf.wgsl, shared/frame.wgsl, shared/grid.wgsl, shared/surface.wgsl

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> leaves: array<Leaf>;
@group(0) @binding(2) var<storage, read> state: array<u32>;
@group(0) @binding(3) var<storage, read> visible: array<u32>;

struct Vertex {
    clip: vec4f,
    position: vec3f, // world axes, relative to the eye
    normal: vec3f,   // world, unit
    grid: vec2f,     // base grid, in cells, for lines along its edges
    leaf: u32,       // level, and 0x100 for a pair; the upper half is what `leaf_mark` says, as f16
    face: u32,
    at: FaceCoord,
}

fn leaf_vertex(instance: u32, grid: u32) -> Vertex {
    let slot = visible[instance];
    let place = leaf_place(leaves[slot]);
    let is_pair = (state[slot] & PAIR) != 0u;
    let i = grid & 0xffffu;
    let j = grid >> 16u;
    let at = grid_coord(place, is_pair, i, j, frame.base_grid);
    let on = drawn_frame(place.face, at);
    let from_eye = vec4f(on.position - frame.eye, 0.0);
    let seen = frame.view_from_object * from_eye;
    return Vertex(
        frame.clip_from_view * vec4f(seen.xyz, 1.0),
        (frame.world_from_object * from_eye).xyz,
        normalize((frame.normal_from_object * vec4f(on.normal, 0.0)).xyz),
        vec2f(f32(i + select(0u, 1u, frame.base_grid == 0u)), f32(j)), // a single triangle fills a square whose sum is odd
        place.level | select(0u, 0x100u, is_pair) | leaf_mark(slot, place, is_pair, i, j, on.position),
        place.face,
        at,
    );
}
