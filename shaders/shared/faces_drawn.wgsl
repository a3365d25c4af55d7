// No face and no leaf is culled for facing away.

fn may_face_eye(slot: u32, ball: vec4f, side: f32) -> bool {
    return true;
}
