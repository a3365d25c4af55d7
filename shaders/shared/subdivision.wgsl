// Subdivision surfaces: every face is one or more domains, each a quadtree of patches (Niessner et al. 2012; Brainerd et al. 2016).
// Twin: keyleaf-surface `subdivision`. What a domain is and how a patch is evaluated are other files.
// requires: shared/place.wgsl, shared/surface.wgsl, shared/topology.wgsl, shared/diamond.wgsl, shared/direction.wgsl

struct SubdivisionParams {
    faces: u32,
    normals: u32, // entry of table A with the mean normal of face 0
    nodes: u32,   // word of table B with the first node
    margin: f32,  // rounding error of a position and what terminal patches are off, from above
}

@group(1) @binding(0) var<uniform> surface: SubdivisionParams;
// Control points patch after patch: the first relative to the origin, the others to it. Then a mean normal a face.
@group(1) @binding(2) var<storage, read> surface_a: array<vec4f>;
// Eight words a half-edge, then the nodes of the trees.
@group(1) @binding(3) var<storage, read> surface_b: array<u32>;

// A half-edge's record: its owner; the half-edge that starts at the canonical corner of its start; bounds of the root, see
// `surface_bound`; the root node and the first entry of the domain of its number; its face.
const HALF_EDGE_WORDS: u32 = 8u;
// A node that is a patch: bit 31, and its number within the domain. Else the word of the first of four children.
const PATCH: u32 = 0x80000000u;
// Trees are no deeper: 16 steps of isolation, or 10 of sharpness and those after them.
const MAX_DEPTH: u32 = 26u;

// Whether a node has children. 0 is no node: what a driver gives to idle lanes must not go on for ever.
fn has_children(node: u32) -> bool {
    return node != 0u && node < PATCH;
}

fn half_edge_record(half_edge: u32) -> u32 {
    return HALF_EDGE_WORDS * half_edge;
}

struct Site {
    face: u32,
    at: FaceCoord,
}

// The same point by a half-edge and the coordinates of its root.
fn site_at(half_edge: u32, x: u32, y: u32) -> Site {
    let face = surface_b[half_edge_record(half_edge) + 7u];
    return Site(face, FaceCoord(half_edge - first_half_edge(face), x, y));
}

// The address at which the position of a point is evaluated, the same for every address of the point (ARCHITECTURE section 3, "same
// bits"): that of the owner of the mesh edge, or of the corner where faces meet; of a centre, that of root 0.
fn site_of(face: u32, at: FaceCoord) -> Site {
    if (at.x | at.y) == 0u {
        return Site(face, FaceCoord(0u, 0u, 0u));
    }
    if at.x + at.y != ONE {
        return Site(face, at);
    }
    let own = half_edge(face, at.root);
    if at.x == ONE || at.y == ONE {
        let end = select(own + 1u, first_half_edge(face), at.root + 1u == corner_count(face));
        let start = select(own, end, at.y == ONE);
        return site_at(surface_b[half_edge_record(start) + 1u], ONE, 0u);
    }
    let owner = surface_b[half_edge_record(own)];
    if owner == own {
        return Site(face, at);
    }
    return site_at(owner, at.y, at.x);
}

fn mean_normal(face: u32) -> vec3f {
    return surface_a[surface.normals + face].xyz;
}

fn surface_bound(leaf: Place) -> SurfaceBound {
    let record = half_edge_record(half_edge(leaf.face, leaf.root));
    let size = bitcast<f32>(surface_b[record + 2u]);
    let ball = bitcast<f32>(surface_b[record + 3u]) * ball_scale(leaf.level);
    let deviation = bitcast<f32>(surface_b[record + 4u]);
    let scale = level_scale(leaf.level);
    return SurfaceBound(surface_point(leaf.face, diamond_centre(leaf)), ball + surface.margin, size * scale,
        2.0 * ball + guard_margin(leaf.level, surface.margin), deviation * scale * scale,
        0.25 * deviation * scale * scale);
}
