// PN triangles (Vlachos et al. 2001): cubic positions from corners and normals alone. Twin: keyleaf-surface `quadratic`.
// requires: shared/triangle_patch.wgsl

// Control points: corners 0, 1, 2; two an edge, the one near its start first; the centre.
fn edge_offset(face: u32, edge: u32, t: f32, w: f32) -> vec3f {
    let start = control_point(face, edge);
    let end = control_point(face, following(edge));
    let near = control_point(face, 3u + 2u * edge);
    let far = control_point(face, 4u + 2u * edge);
    return (w * w * w * start + t * t * t * end) + 3.0 * w * t * (w * near + t * far);
}

// The quadratic patch that is left when one argument of the polar form is b: corners, then edges.
struct Reduced {
    corners: array<vec3f, 3>,
    edges: array<vec3f, 3>,
}

fn reduced(face: u32, b: vec3f) -> Reduced {
    let p1 = control_point(face, 1u);
    let p2 = control_point(face, 2u);
    let e01 = control_point(face, 3u);
    let e10 = control_point(face, 4u);
    let e12 = control_point(face, 5u);
    let e21 = control_point(face, 6u);
    let e20 = control_point(face, 7u);
    let e02 = control_point(face, 8u);
    let centre = control_point(face, 9u);
    return Reduced(
        array<vec3f, 3>(b.y * e01 + b.z * e02, b.y * p1 + b.z * e12 + b.x * e10, b.z * p2 + b.x * e20 + b.y * e21),
        array<vec3f, 3>(b.x * e01 + b.y * e10 + b.z * centre, b.y * e12 + b.z * e21 + b.x * centre,
            b.z * e20 + b.x * e02 + b.y * centre),
    );
}

fn face_offset(face: u32, b: vec3f) -> vec3f {
    let q = reduced(face, b);
    return (b.x * b.x * q.corners[0] + b.y * b.y * q.corners[1] + b.z * b.z * q.corners[2])
        + 2.0 * (b.x * b.y * q.edges[0] + b.y * b.z * q.edges[1] + b.z * b.x * q.edges[2]);
}

fn face_tangents(face: u32, b: vec3f) -> Tangents {
    let q = reduced(face, b);
    return Tangents(
        3.0 * (b.x * (q.edges[0] - q.corners[0]) + b.y * (q.corners[1] - q.edges[0]) + b.z * (q.edges[1] - q.edges[2])),
        3.0 * (b.x * (q.edges[2] - q.corners[0]) + b.y * (q.edges[1] - q.edges[0]) + b.z * (q.corners[2] - q.edges[2])),
        6.0 * (q.edges[1] - q.edges[0] - q.edges[2] + q.corners[0]),
    );
}
