// The surface at given points: for `eval`, and for comparison with the f64 twins.
// requires: shared/place.wgsl, shared/surface.wgsl

struct Request {
    face: u32,
    root: u32,
    x: u32,
    y: u32,
}

@group(0) @binding(0) var<uniform> count: vec4u;
@group(0) @binding(1) var<storage, read> requests: array<Request>;
@group(0) @binding(2) var<storage, read_write> frames: array<vec4f>; // position, du, dv, normal of each

@compute @workgroup_size(64)
fn evaluate(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let index = (group.x + group.y * groups.x) * 64u + lane;
    if index >= count.x {
        return;
    }
    let r = requests[index];
    let on = surface_frame(r.face, FaceCoord(r.root, r.x, r.y));
    frames[4u * index] = vec4f(on.position, 0.0);
    frames[4u * index + 1u] = vec4f(on.du, 0.0);
    frames[4u * index + 2u] = vec4f(on.dv, 0.0);
    frames[4u * index + 3u] = vec4f(on.normal, 0.0);
}
