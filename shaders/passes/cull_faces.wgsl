// Which faces may be seen: backward-facing ones are not drawn (Concheiro 6.4.2, back-patch culling). The way of culling defines
// `fn face_is_back(face: u32, eye: vec3f, side: f32) -> bool`; side is -1 for mirrored objects; and `fn culled_from(face: u32) -> u32`, the
// level from which its triangles are left out.
// requires: shared/topology.wgsl, shared/frame.wgsl

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read_write> faces: array<u32>; // the level from which triangles are left out

const NEVER: u32 = 0xffffffffu;

@compute @workgroup_size(64)
fn cull_faces(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let face = (group.x + group.y * groups.x) * 64u + lane;
    if face >= face_count() {
        return;
    }
    let m = frame.world_from_object;
    let side = select(1.0, -1.0, determinant(mat3x3f(m[0].xyz, m[1].xyz, m[2].xyz)) < 0.0);
    // The eye of an orthographic view is nowhere: all faces stay.
    let is_back = frame.clip_from_view[3].w != 1.0 && face_is_back(face, frame.eye, side);
    faces[face] = select(NEVER, culled_from(face), is_back);
}
