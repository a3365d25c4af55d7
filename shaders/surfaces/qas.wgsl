// Quadratic approximation of subdivision surfaces (Boubekeur & Schlick 2007). Twin: keyleaf-surface `quadratic`.
//
// Departures: the printed listing repeats two arguments; edges are evaluated alike from both sides, and positions relative to corner 0.
// requires: shared/triangle_patch.wgsl

// Control points: corners 0, 1, 2, then edges 0, 1, 2, edge r between corners r and r + 1.
fn edge_offset(face: u32, edge: u32, t: f32, w: f32) -> vec3f {
    let start = control_point(face, edge);
    let end = control_point(face, following(edge));
    return (w * w * start + t * t * end) + 2.0 * w * t * control_point(face, 3u + edge);
}

fn face_offset(face: u32, b: vec3f) -> vec3f {
    return (b.y * b.y * control_point(face, 1u) + b.z * b.z * control_point(face, 2u))
        + 2.0 * (b.x * b.y * control_point(face, 3u) + b.y * b.z * control_point(face, 4u) + b.z * b.x * control_point(face, 5u));
}

fn face_tangents(face: u32, b: vec3f) -> Tangents {
    let p1 = control_point(face, 1u);
    let p2 = control_point(face, 2u);
    let e0 = control_point(face, 3u);
    let e1 = control_point(face, 4u);
    let e2 = control_point(face, 5u);
    return Tangents(2.0 * (b.x * e0 + b.y * (p1 - e0) + b.z * (e1 - e2)), 2.0 * (b.x * e2 + b.y * (e1 - e0) + b.z * (p2 - e2)),
        2.0 * (e1 - e0 - e2));
}
