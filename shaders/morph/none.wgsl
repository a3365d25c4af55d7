// Vertices lie on the surface from the frame in which a split adds them.
// requires: shared/surface.wgsl

fn drawn_frame(face: u32, at: FaceCoord) -> SurfaceFrame {
    return surface_frame(face, at);
}

// In the base grid, hypotenuses are parallel to the leaf's: lines of the lattice, and where this is whole.
fn diagonal_line(grid: vec2f) -> f32 {
    return grid.x + grid.y;
}

// The diagonal edge at a vertex of the base grid, in cells; none: zero.
fn diagonal_step(at: vec2u, k: u32) -> vec2i {
    return vec2i(1, -1);
}

fn vertex_part(face: u32, at: FaceCoord, position: vec3f) -> f32 {
    return 1.0;
}
