// Rational tensor-product patches: Bézier patches, and the knot-span quads (KSQuads) of NURBS surfaces, each a four-cornered face.
// Twin: keyleaf-surface `patches`. How a patch is evaluated is another file: it defines `fn patch_point(p: Patch, at: PatchCoord) -> vec3f`
// and `fn patch_tangents(p: Patch, at: PatchCoord) -> Tangents`.
//
// Departures from Concheiro's thesis, chapter 6: parameters are relative to the knot span and to its length, so that knots 1e-6 apart
// or far from zero lose no digits; positions are sums of differences to one control point, so that corners and poles are exact also
// with weights; derivatives come from differences of control points.
// requires: shared/place.wgsl, shared/surface.wgsl, shared/quad_coord.wgsl, shared/diamond.wgsl, shared/direction.wgsl, shared/local_deviation.wgsl

struct PatchParams {
    faces: u32,
    normals: u32,    // entry of table A with the mean normal of face 0
    half_edges: u32, // word of table B with the record of half-edge 0
    cells: u32,      // words of table B with the first bound of a cell and of an edge, see `local_deviation`
    edges: u32,
    depth: u32,      // levels of cells below a face
    margin: f32,     // rounding error of a position, from above
}

@group(1) @binding(0) var<uniform> surface: PatchParams;
// Control points relative to the origin, with their weights, surface after surface, u fastest; then a mean normal a face.
@group(1) @binding(2) var<storage, read> surface_a: array<vec4f>;
// Four words a face (see `patch_of`), seven words a half-edge, bounds of the deviation, then the knot spans.
@group(1) @binding(3) var<storage, read> surface_b: array<u32>;

// A half-edge's record: its owner, and whether the edge is one point; the half-edge that starts at the canonical corner of its start;
// then bounds of the root, see `surface_bound`.
const HALF_EDGE_WORDS: u32 = 7u;
const COLLAPSED: u32 = 0x80000000u;

struct Patch {
    base: u32, // entry of table A with control point (0, 0)
    stride: u32,
    degree: vec2u,
    spans: vec2u, // words of table B; of patches in power form the entry of table A with the first coefficient
}

fn patch_of(face: u32) -> Patch {
    let packed = surface_b[4u * face + 1u];
    return Patch(surface_b[4u * face], packed & 0xffffffu, vec2u((packed >> 24u) & 15u, packed >> 28u),
        vec2u(surface_b[4u * face + 2u], surface_b[4u * face + 3u]));
}

struct PatchSite {
    face: u32,
    at: FaceCoord,
}

// The address at which a point is evaluated, the same for every address of the point (ARCHITECTURE section 3, "same bits"): that of
// the owner of the mesh edge, or of the corner where several faces or a whole pole meet.
fn patch_site(face: u32, at: FaceCoord) -> PatchSite {
    if at.x + at.y != ONE {
        return PatchSite(face, at);
    }
    let half_edge = 4u * face + at.root;
    let owner = surface_b[surface.half_edges + HALF_EDGE_WORDS * half_edge];
    if at.x == ONE || at.y == ONE || (owner & COLLAPSED) != 0u {
        let start = 4u * face + select(at.root, (at.root + 1u) & 3u, at.y == ONE);
        let corner = surface_b[surface.half_edges + HALF_EDGE_WORDS * start + 1u];
        return PatchSite(corner >> 2u, FaceCoord(corner & 3u, ONE, 0u));
    }
    if owner == half_edge {
        return PatchSite(face, at);
    }
    return PatchSite(owner >> 2u, FaceCoord(owner & 3u, at.y, at.x));
}

// Parameters within the knot span, 0..1, and their complements, each rounded once.
struct PatchCoord {
    f: vec2f,
    g: vec2f,
}

fn patch_coord(at: FaceCoord) -> PatchCoord {
    let q = quad_coord(at);
    return PatchCoord(vec2f(parameter(q.u, q.u_is_one), parameter(q.v, q.v_is_one)),
        vec2f(complement(q.u, q.u_is_one), complement(q.v, q.v_is_one)));
}

// Derivatives by the parameters within the knot span.
struct Tangents {
    du: vec3f,
    dv: vec3f,
    duv: vec3f,
}

// A position as a control point next to it and the rest, which keeps its digits where it is small.
struct PatchPoint {
    reference: vec3f,
    offset: vec3f,
}

// Derivatives at a position S from sums over the control points P with weights w: `rest` of (w (P - S), w), and its derivatives but for
// the factors of the degrees. The first three of `rest` should be zero, but S is rounded; what is left of them times the derivative of
// the weight is taken off.
fn tangents_of_sums(p: Patch, rest: vec4f, du: vec4f, dv: vec4f, duv: vec3f) -> Tangents {
    let per_weight = select(0.0, 1.0 / rest.w, rest.w > 0.0);
    let off = rest.xyz * per_weight;
    let factor = vec2f(p.degree) * per_weight;
    return Tangents((du.xyz - du.w * off) * factor.x, (dv.xyz - dv.w * off) * factor.y,
        duv * (f32(p.degree.x * p.degree.y) * per_weight));
}

fn surface_point(face: u32, at: FaceCoord) -> vec3f {
    let site = patch_site(face, at);
    let p = patch_of(site.face);
    return positive_zero(patch_point(p, patch_coord(site.at)));
}

// A tangent below this part of the mixed derivative is zero but for rounding.
const VANISHING: f32 = 1e-6;

// The direction of du x dv. At an edge that is a point, du grows from zero as duv does, inwards along v, and that is its direction;
// dv likewise. Zero where there is none.
fn tangents_normal(t: Tangents, inward: vec2f) -> vec3f {
    let least = VANISHING * largest_component(t.duv);
    let vanishes = vec2<bool>(largest_component(t.du) <= least, largest_component(t.dv) <= least);
    let du = select(t.du, t.duv * inward.y, vanishes.x);
    let dv = select(t.dv, t.duv * inward.x, vanishes.y);
    return select(cross_direction(du, dv), vec3f(0.0), all(vanishes));
}

// How far inside a normal is taken where a patch has none: a part of the way to its centre.
const STEP_INSIDE: f32 = 0.0009765625;

fn surface_frame(face: u32, at: FaceCoord) -> SurfaceFrame {
    let p = patch_of(face);
    let mean = surface_a[surface.normals + face].xyz;
    var frame = SurfaceFrame(surface_point(face, at), vec3f(0.0), vec3f(0.0), mean);
    var c = patch_coord(at);
    for (var attempt = 0u; attempt < 2u; attempt++) {
        let t = patch_tangents(p, c);
        if attempt == 0u {
            frame.du = t.du;
            frame.dv = t.dv;
        }
        let normal = tangents_normal(t, vec2f(0.5) - c.f);
        if any(normal != vec3f(0.0)) {
            frame.normal = normal;
            break;
        }
        c.f += STEP_INSIDE * (vec2f(0.5) - c.f);
        c.g = vec2f(1.0) - c.f;
    }
    return frame;
}

fn surface_bound(leaf: Place) -> SurfaceBound {
    let record = surface.half_edges + HALF_EDGE_WORDS * (4u * leaf.face + leaf.root);
    let size = bitcast<f32>(surface_b[record + 2u]);
    let ball = bitcast<f32>(surface_b[record + 3u]) * ball_scale(leaf.level);
    let centre = diamond_centre(leaf);
    let deviation = local_deviation(leaf, centre);
    return SurfaceBound(surface_point(leaf.face, centre), ball + surface.margin, size * level_scale(leaf.level),
        2.0 * ball + guard_margin(leaf.level, surface.margin), deviation.x, deviation.y);
}
