// One small Bézier patch of positions and one of normals a triangle (QAS, PN triangles). Twin: keyleaf-surface `quadratic`. The degree of
// the positions is another file: it defines the polynomials below marked *.
//
// * fn edge_offset(face: u32, edge: u32, t: f32, w: f32) -> vec3f: inside an edge of the face, relative to corner 0, t of the way;
// * fn face_offset(face: u32, b: vec3f) -> vec3f: inside the face;
// * fn face_tangents(face: u32, b: vec3f) -> Tangents.
// requires: shared/place.wgsl, shared/surface.wgsl, shared/diamond.wgsl, shared/direction.wgsl

struct TrianglePatchParams {
    faces: u32,
    entries: u32, // of table A a face
    margin: f32,  // rounding error of a position, from above
}

@group(1) @binding(0) var<uniform> surface: TrianglePatchParams;
// A face: corner 0 relative to the origin; the other control points relative to it; corners and edges of the normal patch; mean normal.
@group(1) @binding(2) var<storage, read> surface_a: array<vec4f>;
// Four words a half-edge: its owner, the owner of the corner at its start, and two bounds of its root.
@group(1) @binding(3) var<storage, read> surface_b: array<u32>;

const HALF_EDGE_WORDS: u32 = 4u;

// Derivatives from corner 0 to corner 1, and to corner 2.
struct Tangents {
    du: vec3f,
    dv: vec3f,
    duv: vec3f,
}

fn control_point(face: u32, k: u32) -> vec3f {
    return select(surface_a[surface.entries * face + k].xyz, vec3f(0.0), k == 0u);
}

fn base_point(face: u32) -> vec3f {
    return surface_a[surface.entries * face].xyz;
}

fn following(root: u32) -> u32 {
    return select(root + 1u, 0u, root == 2u);
}

// Barycentric coordinates: both addresses of a point on a spoke have the same.
fn barycentric(at: FaceCoord) -> vec3f {
    let own = vec3<bool>(at.root == 0u, at.root == 1u, at.root == 2u);
    return vec3f(f32(ONE - at.x - at.y) * (4.656612873077393e-10 / 3.0))
        + select(vec3f(0.0), vec3f(fixed_to_float(at.x)), own) + select(vec3f(0.0), vec3f(fixed_to_float(at.y)), own.zxy);
}

// What lies on a mesh edge is made of the owner's control points of that edge alone (ARCHITECTURE section 3, "same bits").
fn surface_point(face: u32, at: FaceCoord) -> vec3f {
    if at.x + at.y != ONE {
        return positive_zero(base_point(face) + face_offset(face, barycentric(at)));
    }
    let own = 3u * face + at.root;
    if at.x == ONE || at.y == ONE {
        let start = select(own, 3u * face + following(at.root), at.y == ONE);
        let corner = surface_b[HALF_EDGE_WORDS * start + 1u];
        let owner = corner / 3u;
        return positive_zero(base_point(owner) + control_point(owner, corner - 3u * owner));
    }
    let half_edge = surface_b[HALF_EDGE_WORDS * own];
    let is_own = half_edge == own;
    let owner = half_edge / 3u;
    let t = fixed_to_float(select(at.x, at.y, is_own));
    let w = fixed_to_float(select(at.y, at.x, is_own));
    return positive_zero(base_point(owner) + edge_offset(owner, half_edge - 3u * owner, t, w));
}

// A quadratic patch of three corners, then three edges; normals are not of unit length.
fn normal_patch(first: u32, b: vec3f) -> vec3f {
    let corners = b.x * b.x * surface_a[first].xyz + b.y * b.y * surface_a[first + 1u].xyz + b.z * b.z * surface_a[first + 2u].xyz;
    let edges = b.x * b.y * surface_a[first + 3u].xyz + b.y * b.z * surface_a[first + 4u].xyz + b.z * b.x * surface_a[first + 5u].xyz;
    return corners + 2.0 * edges;
}

// A normal patch whose value is shorter than this says nothing: opposite normals cancel.
const SHORTEST_NORMAL: f32 = 1e-3;

fn surface_frame(face: u32, at: FaceCoord) -> SurfaceFrame {
    let b = barycentric(at);
    let t = face_tangents(face, b);
    let last = surface.entries * (face + 1u) - 1u;
    let smooth_normal = normal_patch(last - 6u, b);
    var normal = frame_normal(t.du, t.dv, t.duv, surface_a[last].xyz);
    if length(smooth_normal) > SHORTEST_NORMAL {
        normal = normalize(smooth_normal);
    }
    return SurfaceFrame(surface_point(face, at), t.du, t.dv, normal);
}

fn surface_bound(leaf: Place) -> SurfaceBound {
    let record = HALF_EDGE_WORDS * (3u * leaf.face + leaf.root);
    let size = bitcast<f32>(surface_b[record + 2u]);
    let ball = size * ball_scale(leaf.level);
    let deviation = bitcast<f32>(surface_b[record + 3u]);
    let scale = level_scale(leaf.level);
    return SurfaceBound(surface_point(leaf.face, diamond_centre(leaf)), ball + surface.margin, size * scale,
        2.0 * ball + guard_margin(leaf.level, surface.margin), deviation * scale * scale,
        0.25 * deviation * scale * scale);
}
