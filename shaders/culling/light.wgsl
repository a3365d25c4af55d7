// Light quad culling (Concheiro 6.11, LQC): a face is culled when the square of its four corners faces away. Approximate: a face that
// bulges towards the eye is lost while its corners face away.
// requires: shared/patch.wgsl

fn culled_from(face: u32) -> u32 {
    return 0u;
}

fn face_is_back(face: u32, eye: vec3f, side: f32) -> bool {
    var corners: array<vec3f, 4>;
    for (var i = 0u; i < 4u; i++) {
        corners[i] = surface_point(face, FaceCoord(i, ONE, 0u));
    }
    let normal = cross(corners[2] - corners[0], corners[3] - corners[1]);
    let middle = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
    return side * dot(normal, middle - eye) > 0.0;
}
