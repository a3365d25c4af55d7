// The vertices of leaves as the draw computes them, into a buffer: for export and for checks.
// requires: shared/leaf.wgsl, shared/frame.wgsl, shared/grid.wgsl, shared/surface.wgsl

struct Emission {
    first: u32,     // of `slots`
    count: u32,
    vertices: u32,  // of the base grid
    base_grid: u32,
}

@group(0) @binding(0) var<uniform> emission: Emission;
@group(0) @binding(1) var<storage, read> leaves: array<Leaf>;
@group(0) @binding(2) var<storage, read> state: array<u32>;
@group(0) @binding(3) var<storage, read> slots: array<u32>;
@group(0) @binding(4) var<storage, read> grid: array<u32>;          // i | j << 16
@group(0) @binding(5) var<storage, read_write> emitted: array<vec4f>; // position and normal of each vertex
@group(0) @binding(6) var<uniform> frame: Frame;                   // where vertices morph

@compute @workgroup_size(64)
fn emit(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let index = (group.x + group.y * groups.x) * 64u + lane;
    if index >= emission.count * emission.vertices {
        return;
    }
    let slot = slots[emission.first + index / emission.vertices];
    let vertex = grid[index % emission.vertices];
    let place = leaf_place(leaves[slot]);
    let at = grid_coord(place, (state[slot] & PAIR) != 0u, vertex & 0xffffu, vertex >> 16u, emission.base_grid);
    let on = drawn_frame(place.face, at);
    emitted[2u * index] = vec4f(on.position, 1.0);
    emitted[2u * index + 1u] = vec4f(on.normal, 0.0);
}
