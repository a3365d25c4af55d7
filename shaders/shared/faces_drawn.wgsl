// No face is culled.

fn face_is_drawn(slot: u32) -> bool {
    return true;
}
