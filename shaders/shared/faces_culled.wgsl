// Faces are culled by what `passes/cull_faces.wgsl` found.
// requires: shared/leaf.wgsl

@group(0) @binding(6) var<storage, read> leaves: array<Leaf>;
@group(0) @binding(7) var<storage, read> faces: array<u32>;

fn may_face_eye(slot: u32, ball: vec4f, side: f32) -> bool {
    let leaf = leaves[slot];
    return faces[leaf.face] > (leaf.orientation_level >> 8u) + frame.base_grid;
}
