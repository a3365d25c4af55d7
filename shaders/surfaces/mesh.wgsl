// A flat mesh: bilinear quads, flat triangles, other polygons as fans about their centre. Twin: keyleaf-surface `mesh`.
// requires: shared/surface.wgsl, shared/polygon.wgsl, shared/diamond.wgsl, shared/direction.wgsl

struct MeshParams {
    vertices: u32,
    faces: u32,
    margin: f32, // rounding error of a position, from above
}

@group(1) @binding(0) var<uniform> surface: MeshParams;
// Positions relative to the origin: of vertices, then of the centres of the faces; then a unit normal a face.
@group(1) @binding(2) var<storage, read> surface_a: array<vec4f>;
// Three words a half-edge: its start vertex; the bits of rho, which bounds half the hypotenuse, the median and half the speed of its
// root; and of the distance of the quad from flat triangles of level 0.
@group(1) @binding(3) var<storage, read> surface_b: array<u32>;

fn corner_vertex(half_edge: u32) -> u32 {
    return surface_b[3u * half_edge];
}

fn centre_point(face: u32) -> u32 {
    return surface.vertices + face;
}

fn surface_point(face: u32, at: FaceCoord) -> vec3f {
    let s = polygon_stencil(face, at);
    return positive_zero(surface_a[s.points.x].xyz * s.weights.x + surface_a[s.points.y].xyz * s.weights.y
        + surface_a[s.points.z].xyz * s.weights.z + surface_a[s.points.w].xyz * s.weights.w);
}

fn surface_frame(face: u32, at: FaceCoord) -> SurfaceFrame {
    let jet = polygon_jet(face, at);
    let p0 = surface_a[jet.points.x].xyz;
    let p1 = surface_a[jet.points.y].xyz;
    let p2 = surface_a[jet.points.z].xyz;
    let p3 = surface_a[jet.points.w].xyz;
    let du = derivative(jet.du, p0, p1, p2, p3);
    let dv = derivative(jet.dv, p0, p1, p2, p3);
    let face_normal = surface_a[surface.vertices + surface.faces + face].xyz;
    var normal = face_normal;
    if corner_count(face) != 3u {
        normal = frame_normal(du, dv, derivative(jet.duv, p0, p1, p2, p3), face_normal);
    }
    return SurfaceFrame(surface_point(face, at), du, dv, normal);
}

fn surface_bound(leaf: Place) -> SurfaceBound {
    let record = 3u * half_edge(leaf.face, leaf.root);
    let rho = bitcast<f32>(surface_b[record + 1u]);
    let twist = bitcast<f32>(surface_b[record + 2u]);
    let ball = rho * ball_scale(leaf.level);
    let scale = level_scale(leaf.level);
    return SurfaceBound(surface_point(leaf.face, diamond_centre(leaf)), ball + surface.margin, rho * scale,
        2.0 * ball + guard_margin(leaf.level, surface.margin), twist * scale * scale, twist * scale * scale);
}
