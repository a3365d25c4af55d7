// The limit surface of Loop subdivision. Twin: keyleaf-surface `subdivision`.
// requires: shared/quartic.wgsl

fn surface_point(face: u32, at: FaceCoord) -> vec3f {
    let site = site_of(face, at);
    return positive_zero(quartic_jet(triangle_cell(site.face, site.at, QUARTIC_ENTRIES)).position);
}

// The tangent plane is that of the face itself: at a crease each side has its own.
fn surface_frame(face: u32, at: FaceCoord) -> SurfaceFrame {
    let cell = triangle_cell(face, at, QUARTIC_ENTRIES);
    let jet = quartic_jet(cell);
    return SurfaceFrame(surface_point(face, at), cell.scale * jet.du, cell.scale * jet.dv,
        frame_normal(jet.du, jet.dv, quartic_twist(cell), mean_normal(face)));
}
