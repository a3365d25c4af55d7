// No pair leaves out a vertex that both sides of the leg have.

fn size_between_pairs(leaf: Place, at: FaceCoord, size: f32) -> f32 {
    return size;
}
