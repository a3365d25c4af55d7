// Vertices lie on the surface from the frame in which a split adds them.
// requires: shared/surface.wgsl

fn drawn_frame(face: u32, at: FaceCoord) -> SurfaceFrame {
    return surface_frame(face, at);
}

fn vertex_part(face: u32, at: FaceCoord, position: vec3f) -> f32 {
    return 1.0;
}
