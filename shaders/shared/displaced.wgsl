// A mesh displaced along its interpolated smooth normal: P = B + h N, where B is the flat mesh and N the interpolated vertex normal at
// unit length. The surface defines the displacement h:
//   fn displacement(face: u32, at: FaceCoord, s: Stencil, base: vec3f) -> f32       the same for every address of a point
//   fn displacement_jet(jet: Jet, base: vec3f, du: vec3f, dv: vec3f) -> vec3f        h, dh/du, dh/dv from the face alone
//   fn displacement_bound(leaf: Place, root: RootBound) -> DisplacementBound
// Twin: keyleaf-surface `displaced`.
// requires: shared/surface.wgsl, shared/polygon.wgsl, shared/diamond.wgsl, shared/direction.wgsl

// Positions relative to the origin, of vertices and then of the centres of the faces; vertex normals and the means of the faces'
// corner normals, in the same order; then a unit normal a face.
@group(1) @binding(2) var<storage, read> surface_a: array<vec4f>;

// What a root says of its diamonds, times 2^-level.
struct RootBound {
    position: f32, // bounds half the hypotenuse, the median and half the speed of the flat mesh
    normal: f32,   // the same of the unit normal
    texel: f32,    // the same of the texture coordinate, in texels
    seam: f32,     // how far the displacement may jump at the mesh edge
}

struct DisplacementBound {
    largest: f32,       // of |h|, anywhere
    variation: f32,     // of h over the diamond, against its value at the centre
    steepest: f32,      // of |dh| over half of a drawn edge or median: for guard balls
    typical: f32,       // growth of the size by it, as the metric counts it
    jump: f32,          // at a seam of the texture that the diamond touches
}

// Where opposite normals nearly cancel, N is shorter than one instead of turning ever faster.
const SHORTEST_NORMAL: f32 = 0.0625;

fn normal_scale(n: vec3f) -> f32 {
    return 1.0 / max(length(n), SHORTEST_NORMAL);
}

fn point_sum(s: Stencil, first: u32) -> vec3f {
    let p = s.points + vec4u(first);
    return surface_a[p.x].xyz * s.weights.x + surface_a[p.y].xyz * s.weights.y
        + surface_a[p.z].xyz * s.weights.z + surface_a[p.w].xyz * s.weights.w;
}

fn surface_point(face: u32, at: FaceCoord) -> vec3f {
    let s = polygon_stencil(face, at);
    let base = point_sum(s, 0u);
    let n = point_sum(s, surface.vertices + surface.faces);
    return positive_zero(base + n * (normal_scale(n) * displacement(face, at, s, base)));
}

// A vector field of the point table and its derivatives.
struct FieldJet {
    value: vec3f,
    du: vec3f,
    dv: vec3f,
    duv: vec3f,
}

fn field_jet(jet: Jet, first: u32) -> FieldJet {
    let p = jet.points + vec4u(first);
    let p0 = surface_a[p.x].xyz;
    let p1 = surface_a[p.y].xyz;
    let p2 = surface_a[p.z].xyz;
    let p3 = surface_a[p.w].xyz;
    let value = p0 * jet.value.x + p1 * jet.value.y + p2 * jet.value.z + p3 * jet.value.w;
    return FieldJet(value, derivative(jet.du, p0, p1, p2, p3), derivative(jet.dv, p0, p1, p2, p3),
        derivative(jet.duv, p0, p1, p2, p3));
}

// The derivative of n / max(|n|, SHORTEST_NORMAL).
fn unit_derivative(n: vec3f, scale: f32, dn: vec3f) -> vec3f {
    let direction = n * scale;
    let along = select(0.0, dot(direction, dn), length(n) > SHORTEST_NORMAL);
    return scale * (dn - direction * along);
}

fn surface_frame(face: u32, at: FaceCoord) -> SurfaceFrame {
    let jet = polygon_jet(face, at);
    let points = surface.vertices + surface.faces;
    let base = field_jet(jet, 0u);
    let n = field_jet(jet, points);
    let h = displacement_jet(jet, base.value, base.du, base.dv);
    let scale = normal_scale(n.value);
    let direction = n.value * scale;
    let du = base.du + h.y * direction + h.x * unit_derivative(n.value, scale, n.du);
    let dv = base.dv + h.z * direction + h.x * unit_derivative(n.value, scale, n.dv);
    let fallback = surface_a[2u * points + face].xyz;
    return SurfaceFrame(surface_point(face, at), du, dv, frame_normal(du, dv, base.duv, fallback));
}

fn surface_bound(leaf: Place) -> SurfaceBound {
    let root = root_bound(half_edge(leaf.face, leaf.root));
    let h = displacement_bound(leaf, root);
    let smooth_speed = root.position + h.largest * root.normal;
    let ball = smooth_speed * ball_scale(leaf.level);
    let centre = surface_point(leaf.face, diamond_centre(leaf));
    let size = smooth_speed * level_scale(leaf.level) + h.typical;
    return SurfaceBound(centre, ball + h.variation + h.jump + surface.margin, size,
        2.0 * (ball + h.steepest) + h.jump + guard_margin(leaf.level, surface.margin), size,
        HALF_LEVEL * size);
}
