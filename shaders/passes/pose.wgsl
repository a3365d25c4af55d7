// Control points, mean normals and bounds of a subdivision surface whose control mesh moves. The weights never change: a control point
// is a weighted sum of the vertices about its face. Twin: keyleaf-surface `subdivision`, which makes the same tables from a mesh at rest.
//
// A workgroup a face: its control points, then the derivatives of its patches from those, then what bounds its roots. A second dispatch
// gives both roots of a mesh edge the larger of their bounds. Costs a multiply-add a weight, so 16 to 40 a control point.
// The composer adds the kind of patch: `POSED_ENTRIES`, `patch_slopes`, `patch_area`, `root_bound`.

struct PoseParams {
    faces: u32,
    half_edges: u32,
    normals: u32, // entry of table A with the mean normal of face 0
}

@group(0) @binding(0) var<uniform> pose: PoseParams;
// Eight words a face, one a half-edge (the half-edge on the other side), then rings and what faces with the same weights share.
@group(0) @binding(1) var<storage, read> pose_words: array<u32>;
@group(0) @binding(2) var<storage, read> pose_rows: array<f32>;
// Vertices of the control mesh relative to the origin.
@group(0) @binding(3) var<storage, read> cage: array<vec4f>;
@group(0) @binding(4) var<storage, read_write> surface_a: array<vec4f>;
@group(0) @binding(5) var<storage, read_write> surface_b: array<u32>;
// Eight floats a patch: the slopes; then two a half-edge: the bounds of the root, taken alone.
@group(0) @binding(6) var<storage, read_write> scratch: array<f32>;

const FACE_WORDS: u32 = 8u;
const HALF_EDGE_WORDS: u32 = 8u;
const NONE: u32 = 0xffffffffu;
// A patch whose parameters are those of the root exchanged.
const TURNED: u32 = 0x80000000u;
// What rounding may take from a bound, and more.
const ROUNDED_UP: f32 = 1.00001;

struct PosedFace {
    first: u32,     // entry of table A with control point 0
    ring: u32,      // word with its first vertex
    width: u32,     // vertices
    rows: u32,      // float of the first row of weights
    patches: u32,
    kind: u32,      // word with the record that faces with the same weights share
    half_edge: u32, // its first
    corners: u32,
}

fn posed_face(face: u32) -> PosedFace {
    let at = FACE_WORDS * face;
    return PosedFace(pose_words[at], pose_words[at + 1u], pose_words[at + 2u], pose_words[at + 3u], pose_words[at + 4u],
        pose_words[at + 5u], pose_words[at + 6u], pose_words[at + 7u]);
}

// Bounds of the lengths of derivatives over a patch.
struct Slopes {
    first: vec2f,
    second: vec3f, // uu, uv, vv
}

fn control_point(face: PosedFace, entry: u32) -> vec3f {
    // Relative to the first vertex of the ring, which keeps the digits of what is far from zero. Rows of differences sum to zero.
    let first = cage[pose_words[face.ring]].xyz;
    let row = face.rows + face.width * entry;
    var sum = vec3f(0.0);
    for (var k = 1u; k < face.width; k++) {
        sum += pose_rows[row + k] * (cage[pose_words[face.ring + k]].xyz - first);
    }
    return sum + select(vec3f(0.0), first, entry % POSED_ENTRIES == 0u);
}

// Control point k of a patch relative to its first.
fn difference(first: u32, k: u32) -> vec3f {
    return select(surface_a[first + k].xyz, vec3f(0.0), k == 0u);
}

// The scratch of a patch.
fn slopes_at(face: PosedFace, patch_number: u32) -> u32 {
    return 8u * (face.first / POSED_ENTRIES + patch_number);
}

fn keep_slopes(face: PosedFace, patch_number: u32) {
    let slopes = patch_slopes(face.first + POSED_ENTRIES * patch_number);
    let scale = bitcast<f32>(pose_words[face.kind + patch_number]);
    let at = slopes_at(face, patch_number);
    let first = scale * slopes.first;
    let second = scale * scale * slopes.second;
    scratch[at] = first.x;
    scratch[at + 1u] = first.y;
    scratch[at + 2u] = second.x;
    scratch[at + 3u] = second.y;
    scratch[at + 4u] = second.z;
}

// The largest of the patches that a root touches.
fn root_slopes(face: PosedFace, root: u32) -> Slopes {
    let list = face.kind + face.patches + 2u * root;
    let first = face.kind + pose_words[list];
    var largest = Slopes(vec2f(0.0), vec3f(0.0));
    for (var k = 0u; k < pose_words[list + 1u]; k++) {
        let touched = pose_words[first + k];
        let at = slopes_at(face, touched & ~TURNED);
        let speeds = vec2f(scratch[at], scratch[at + 1u]);
        let bends = vec3f(scratch[at + 2u], scratch[at + 3u], scratch[at + 4u]);
        let is_turned = (touched & TURNED) != 0u;
        largest.first = max(largest.first, select(speeds, speeds.yx, is_turned));
        largest.second = max(largest.second, select(bends, bends.zyx, is_turned));
    }
    return largest;
}

fn own_bound_at(half_edge: u32) -> u32 {
    return arrayLength(&scratch) - 2u * (pose.half_edges - half_edge);
}

fn largest_component(v: vec3f) -> f32 {
    return max(abs(v.x), max(abs(v.y), abs(v.z)));
}

// The direction of the sum of the patches' area vectors; of the longest where they cancel.
fn keep_normal(face_number: u32, face: PosedFace) {
    var sum = vec3f(0.0);
    var lengths = 0.0;
    var longest = vec3f(0.0);
    for (var number = 0u; number < face.patches; number++) {
        let area = patch_area(face.first + POSED_ENTRIES * number);
        sum += area;
        lengths += length(area);
        longest = select(longest, area, dot(area, area) > dot(longest, longest));
    }
    let direction = select(longest, sum, length(sum) > 1e-6 * lengths);
    let scaled = direction / max(largest_component(direction), 1e-30);
    let normal = select(vec3f(0.0, 1.0, 0.0), normalize(scaled), any(scaled != vec3f(0.0)));
    surface_a[pose.normals + face_number] = vec4f(normal, 0.0);
}

@compute @workgroup_size(64)
fn pose_faces(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let number = group.x + group.y * groups.x;
    if number >= pose.faces {
        return;
    }
    let face = posed_face(number);
    for (var entry = lane; entry < POSED_ENTRIES * face.patches; entry += 64u) {
        surface_a[face.first + entry] = vec4f(control_point(face, entry), 0.0);
    }
    storageBarrier();
    for (var patch_number = lane; patch_number < face.patches; patch_number += 64u) {
        keep_slopes(face, patch_number);
    }
    storageBarrier();
    for (var root = lane; root < face.corners; root += 64u) {
        let bound = ROUNDED_UP * root_bound(root_slopes(face, root), root, face.corners);
        let at = own_bound_at(face.half_edge + root);
        scratch[at] = bound.x;
        scratch[at + 1u] = bound.y;
    }
    if lane == 0u {
        keep_normal(number, face);
    }
}

// Size, ball and deviation, see `surface_bound`: the larger of both roots of a mesh edge.
@compute @workgroup_size(64)
fn pose_edges(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let half_edge = (group.x + group.y * groups.x) * 64u + lane;
    if half_edge >= pose.half_edges {
        return;
    }
    let other = pose_words[FACE_WORDS * pose.faces + half_edge];
    let own_at = own_bound_at(half_edge);
    let other_at = own_bound_at(select(other, half_edge, other == NONE));
    let size = max(scratch[own_at], scratch[other_at]);
    let deviation = max(scratch[own_at + 1u], scratch[other_at + 1u]);
    let record = HALF_EDGE_WORDS * half_edge;
    surface_b[record + 2u] = bitcast<u32>(size);
    surface_b[record + 3u] = bitcast<u32>(size);
    surface_b[record + 4u] = bitcast<u32>(deviation);
}
