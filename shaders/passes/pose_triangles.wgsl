// Control points, normals and bounds of small patches, one of positions and one of normals a triangle, whose control mesh moves (QAS, PN
// triangles). Twin: keyleaf-surface `quadratic`, which makes the same tables from a mesh at rest.
//
// `pose_vertices`, the triangles about a vertex an invocation: the normal there. `pose_triangles`: control points and mean normal of a
// face, and what bounds its roots. `pose_edges`: the normals inside an edge, and the larger bounds for both of its roots.
// The composer adds the kind of patch: `fan_normal`, `keep_triangle`, `keep_edge_normals`. QAS sum points in a pass before (pose_points).
//
// Both faces of an edge have control points of it, which may differ in the last bit: `surface_point` reads those of the owner alone.
// requires: shared/direction.wgsl

struct TrianglePoseParams {
    faces: u32,
    fans: u32,
    edges: u32,
    points: u32,
    entries: u32,     // of table A a face
    edge_points: u32, // number of the point of edge 0
    edge_words: u32,  // word with edge 0
    fan_words: u32,
    point_words: u32,
}

@group(0) @binding(0) var<uniform> pose: TrianglePoseParams;
// Three words a half-edge, one an edge, six a fan, four a point; then what they list.
@group(0) @binding(1) var<storage, read> pose_words: array<u32>;
@group(0) @binding(2) var<storage, read> pose_rows: array<f32>;
// Vertices of the control mesh relative to the origin.
@group(0) @binding(3) var<storage, read> cage: array<vec4f>;
// As `surface_a` and `surface_b` of shared/triangle_patch.wgsl.
@group(0) @binding(4) var<storage, read_write> surface_a: array<vec4f>;
@group(0) @binding(5) var<storage, read_write> surface_b: array<u32>;
// What the points are, relative to their vertices.
@group(0) @binding(6) var<storage, read_write> scratch: array<vec4f>;

const BOUND_WORDS: u32 = 4u; // of table B a half-edge
const NONE: u32 = 0xffffffffu;
const CENTRE: vec3f = vec3f(1.0 / 3.0);

fn invocation(group: vec3u, groups: vec3u, lane: u32) -> u32 {
    return (group.x + group.y * groups.x) * 64u + lane;
}

// No list is longer than the words: what bounds the loop of an idle lane.
fn listed(count: u32) -> u32 {
    return min(count, arrayLength(&pose_words));
}

fn start_vertex(half_edge: u32) -> u32 {
    return pose_words[3u * half_edge];
}

fn edge_of(half_edge: u32) -> u32 {
    return pose_words[3u * half_edge + 1u];
}

// The half-edge on the other side, or NONE.
fn other_side(half_edge: u32) -> u32 {
    return pose_words[3u * half_edge + 2u];
}

fn edge_owner(edge: u32) -> u32 {
    return pose_words[pose.edge_words + edge];
}

fn next_in_face(half_edge: u32) -> u32 {
    return select(half_edge + 1u, half_edge - 2u, half_edge % 3u == 2u);
}

fn vertex_position(vertex: u32) -> vec3f {
    return cage[vertex].xyz;
}

// Entry of table A with the normal at the start of a half-edge.
fn corner_normal_at(half_edge: u32) -> u32 {
    return pose.entries * (half_edge / 3u + 1u) - 7u + half_edge % 3u;
}

fn corner_normal(half_edge: u32) -> vec3f {
    return surface_a[corner_normal_at(half_edge)].xyz;
}

// With the control point of normals between its ends.
fn edge_normal_at(half_edge: u32) -> u32 {
    return corner_normal_at(half_edge) + 3u;
}

// Triangles about a vertex that are connected through edges.
struct Fan {
    vertex: u32,
    ring: u32,       // word with the first vertex at the other end of an edge
    ring_count: u32,
    sectors: u32,    // triangles: as many as that if they close
    spokes: u32,     // word with the first half-edge that takes the normal
    spoke_count: u32,
}

fn posed_fan(number: u32) -> Fan {
    let at = pose.fan_words + 6u * number;
    return Fan(pose_words[at], pose_words[at + 1u], pose_words[at + 2u], pose_words[at + 3u], pose_words[at + 4u], pose_words[at + 5u]);
}

// The arctangent of 0 to 1 within 1e-7 (Abramowitz & Stegun 4.4.49): WGSL's own may be off by 4096 units in the last place.
fn arctangent(x: f32) -> f32 {
    let s = x * x;
    var sum = 0.0028662257 * s - 0.0161657367;
    sum = sum * s + 0.0429096138;
    sum = sum * s - 0.0752896400;
    sum = sum * s + 0.1065626393;
    sum = sum * s - 0.1420889944;
    sum = sum * s + 0.1999355085;
    sum = sum * s - 0.3333314528;
    return x + x * s * sum;
}

// Between vectors that are not zero, exact for small angles and for those close to a straight one.
fn angle_between(a: vec3f, b: vec3f) -> f32 {
    let u = normalize(scaled_vector(a));
    let v = normalize(scaled_vector(b));
    let sine = length(u - v);
    let cosine = length(u + v);
    let angle = 2.0 * arctangent(min(sine, cosine) / max(sine, cosine));
    return select(angle, 3.14159265359 - angle, sine > cosine);
}

// The unit normal of a triangle with the edges a and b, weighted by the angle between them.
fn weighted_normal(a: vec3f, b: vec3f) -> vec3f {
    let normal = cross_direction(a, b);
    return select(vec3f(0.0), normal * angle_between(a, b), any(normal != vec3f(0.0)));
}

fn unit_or_up(v: vec3f) -> vec3f {
    let scaled = scaled_vector(v);
    return select(vec3f(0.0, 1.0, 0.0), normalize(scaled), any(scaled != vec3f(0.0)));
}

// Of the triangles of the control mesh.
fn mean_normal_of_fan(fan: Fan) -> vec3f {
    let own = vertex_position(fan.vertex);
    var sum = vec3f(0.0);
    for (var k = 0u; k < listed(fan.sectors); k++) {
        let following = select(k + 1u, 0u, k + 1u == fan.ring_count);
        let a = vertex_position(pose_words[fan.ring + k]) - own;
        let b = vertex_position(pose_words[fan.ring + following]) - own;
        sum += weighted_normal(a, b);
    }
    return unit_or_up(sum);
}

// A quadratic patch relative to the first corner of its face, or what is left of a cubic one when an argument of its polar form is set.
struct Net {
    corners: array<vec3f, 3>,
    edges: array<vec3f, 3>,
}

// The polar form: of two points, or of directions.
fn polar(net: Net, a: vec3f, b: vec3f) -> vec3f {
    return (a.x * b.x * net.corners[0] + a.y * b.y * net.corners[1] + a.z * b.z * net.corners[2])
        + ((a.x * b.y + a.y * b.x) * net.edges[0] + (a.y * b.z + a.z * b.y) * net.edges[1] + (a.z * b.x + a.x * b.z) * net.edges[2]);
}

// Barycentric coordinates of the first root as those of another.
fn of_root(b: vec3f, root: u32) -> vec3f {
    return select(select(b, b.zxy, root == 1u), b.yzx, root == 2u);
}

// What rounding may take from a bound: of itself, and of the coordinates.
const ROUNDED_UP: f32 = 1.00001;
const ROUNDING: f32 = 16.0 / 16777216.0;

// Size and deviation of a root, see `surface_bound`. `largest` is the largest coordinate of the face.
fn keep_bounds(half_edge: u32, size: f32, deviation: f32, largest: f32) {
    let at = BOUND_WORDS * half_edge + 2u;
    surface_b[at] = bitcast<u32>(ROUNDED_UP * size + ROUNDING * largest);
    surface_b[at + 1u] = bitcast<u32>(ROUNDED_UP * deviation + ROUNDING * largest);
}

// Of the corners of a face; without area, of the normals there.
fn keep_mean_normal(face: u32, along: vec3f, across: vec3f) {
    let first = corner_normal_at(3u * face);
    let flat_normal = cross_direction(along, across);
    let sum = surface_a[first].xyz + surface_a[first + 1u].xyz + surface_a[first + 2u].xyz;
    let normal = select(unit_or_up(sum), flat_normal, any(flat_normal != vec3f(0.0)));
    surface_a[pose.entries * (face + 1u) - 1u] = vec4f(normal, 0.0);
}

@compute @workgroup_size(64)
fn pose_vertices(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let number = invocation(group, groups, lane);
    if number >= pose.fans {
        return;
    }
    let fan = posed_fan(number);
    let normal = vec4f(fan_normal(fan), 0.0);
    for (var k = 0u; k < listed(fan.spoke_count); k++) {
        surface_a[corner_normal_at(pose_words[fan.spokes + k])] = normal;
    }
}

@compute @workgroup_size(64)
fn pose_triangles(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let face = invocation(group, groups, lane);
    if face >= pose.faces {
        return;
    }
    keep_triangle(face);
}

@compute @workgroup_size(64)
fn pose_edges(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let edge = invocation(group, groups, lane);
    if edge >= pose.edges {
        return;
    }
    let own = edge_owner(edge);
    let other = other_side(own);
    keep_edge_normals(edge, own, other);
    if other == NONE {
        return;
    }
    let own_at = BOUND_WORDS * own + 2u;
    let other_at = BOUND_WORDS * other + 2u;
    // Not negative, so that their bits are in their order.
    let size = max(surface_b[own_at], surface_b[other_at]);
    let deviation = max(surface_b[own_at + 1u], surface_b[other_at + 1u]);
    surface_b[own_at] = size;
    surface_b[other_at] = size;
    surface_b[own_at + 1u] = deviation;
    surface_b[other_at + 1u] = deviation;
}
