// The limit surface of Catmull-Clark subdivision. Twin: keyleaf-surface `subdivision`.
// requires: shared/bicubic.wgsl

fn surface_point(face: u32, at: FaceCoord) -> vec3f {
    let site = site_of(face, at);
    return positive_zero(bicubic_point(square_cell(site.face, site.at, BICUBIC_ENTRIES)));
}

// The tangent plane is that of the face itself: at a crease each side has its own.
fn surface_frame(face: u32, at: FaceCoord) -> SurfaceFrame {
    let cell = square_cell(face, at, BICUBIC_ENTRIES);
    let t = bicubic_tangents(cell);
    let rates = cell.scale * domain_rates(face, at);
    return SurfaceFrame(surface_point(face, at), rates.x * t.du + rates.z * t.dv, rates.y * t.du + rates.w * t.dv,
        frame_normal(t.du, t.dv, t.duv, mean_normal(face)));
}
