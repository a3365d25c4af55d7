// Back-patch culling that loses nothing (Concheiro 6.12, corrected: over all pairs of differences): a face is culled when no normal in
// the cone about all that it can have faces the eye, from any control point. The surface lies in the hull of those, and n . (P - eye) is
// linear in P. The cone is made on the CPU: keyleaf-surface `patches::normal_cone`.
// requires: shared/patch.wgsl

// The cone holds the normals of triangles of this level and finer ones.
fn culled_from(face: u32) -> u32 {
    return surface_b[surface.half_edges + HALF_EDGE_WORDS * (4u * face + 1u) + 6u];
}

fn face_is_back(face: u32, eye: vec3f, side: f32) -> bool {
    let record = surface.half_edges + HALF_EDGE_WORDS * 4u * face;
    let axis = side * bitcast<vec3f>(vec3u(surface_b[record + 4u], surface_b[record + 5u], surface_b[record + 6u]));
    let next = record + HALF_EDGE_WORDS;
    let cosine = bitcast<f32>(surface_b[next + 4u]);
    let sine = bitcast<f32>(surface_b[next + 5u]);
    let p = patch_of(face);
    for (var l = 0u; l <= p.degree.y; l++) {
        for (var k = 0u; k <= p.degree.x; k++) {
            let arm = surface_a[p.base + k + l * p.stride].xyz - eye;
            // The least n . arm over the cone, less what rounding may add to it.
            let least = cosine * dot(axis, arm) - sine * length(cross(axis, arm));
            if least <= 1e-5 * length(arm) + surface.margin {
                return false;
            }
        }
    }
    return true;
}
