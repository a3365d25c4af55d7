// The patches of a Gaussian-product surface whose control mesh and covariances move. The weights never change: in dual space a control
// point is a weighted sum of the vertices about its face (Komar 2020). Twin: keyleaf-surface `gaussian`, which makes the same tables from a
// mesh at rest in f64.
//
// Sums of precisions in f32 lose as many digits as covariances are long and thin. So vertices come as axes and standard deviations, and are
// whitened by the first vertex of the ring, as products of differences of axes: that loses the root of it. Each patch is then whitened by
// the mean of its own control points, as on the CPU.
//
// A workgroup a face: its ring, its control points, the frames of its patches, the control points in these, and the mean normal. Bounds do
// not follow: they are to hold for all poses. Costs nine multiply-adds a weight.
// requires: shared/solve_ldlt.wgsl

struct PoseParams {
    faces: u32,
    normals: u32,  // entry of table A with the mean normal of face 0
    controls: u32, // control points a patch: 16 of a square, 15 of a triangle
}

@group(0) @binding(0) var<uniform> pose: PoseParams;
// Eight words a face, then rings, then, for faces with the same weights, whether each patch counts for the normal.
@group(0) @binding(1) var<storage, read> pose_words: array<u32>;
@group(0) @binding(2) var<storage, read> pose_rows: array<f32>;
// Four entries a vertex: mean relative to the origin, three axes, and with the first three the standard deviations along them.
@group(0) @binding(3) var<storage, read> cage: array<vec4f>;
@group(0) @binding(4) var<storage, read_write> surface_a: array<vec4f>;
// By face: nine floats a vertex of the ring, then twenty-four a patch: `kept_frame`, `KEPT_FIRST`, `KEPT_AREA`.
@group(0) @binding(6) var<storage, read_write> scratch: array<f32>;

const FACE_WORDS: u32 = 8u;
const VERTEX_ENTRIES: u32 = 4u;
const FRAME_ENTRIES: u32 = 3u;
const DUAL_FLOATS: u32 = 9u;
const PATCH_FLOATS: u32 = 24u;
const KEPT_FIRST: u32 = 10u; // the first control point of the patch, whitened by the ring
const KEPT_AREA: u32 = 19u;

struct PosedFace {
    first: u32,   // entry of table A with the first patch
    ring: u32,    // word with its first vertex
    width: u32,   // vertices
    rows: u32,    // float of the first row of weights
    patches: u32,
    counts: u32,  // word that says whether the first patch counts for the normal
    scratch: u32, // its first float
}

fn posed_face(face: u32) -> PosedFace {
    let at = FACE_WORDS * face;
    return PosedFace(pose_words[at], pose_words[at + 1u], pose_words[at + 2u], pose_words[at + 3u], pose_words[at + 4u],
        pose_words[at + 5u], pose_words[at + 6u]);
}

// A point of dual space.
struct Dual {
    precisions: Symmetric,
    information: vec3f,
}

fn sum(p: Dual, q: Dual, w: f32) -> Dual {
    return Dual(Symmetric(p.precisions.diagonal + w * q.precisions.diagonal, p.precisions.opposite + w * q.precisions.opposite),
        p.information + w * q.information);
}

fn nothing() -> Dual {
    return Dual(Symmetric(vec3f(0.0), vec3f(0.0)), vec3f(0.0));
}

fn kept(at: u32) -> Dual {
    return Dual(
        Symmetric(vec3f(scratch[at], scratch[at + 1u], scratch[at + 2u]), vec3f(scratch[at + 3u], scratch[at + 4u], scratch[at + 5u])),
        vec3f(scratch[at + 6u], scratch[at + 7u], scratch[at + 8u]));
}

fn keep_vector(at: u32, v: vec3f) {
    scratch[at] = v.x;
    scratch[at + 1u] = v.y;
    scratch[at + 2u] = v.z;
}

fn keep(at: u32, q: Dual) {
    keep_vector(at, q.precisions.diagonal);
    keep_vector(at + 3u, q.precisions.opposite);
    keep_vector(at + 6u, q.information);
}

// A vertex of the control mesh.
struct Gaussian {
    mean: vec3f,
    x: vec3f, // axes
    y: vec3f,
    z: vec3f,
    deviations: vec3f,
}

fn gaussian(vertex: u32) -> Gaussian {
    let at = VERTEX_ENTRIES * vertex;
    let deviations = vec3f(cage[at].w, cage[at + 1u].w, cage[at + 2u].w);
    return Gaussian(cage[at].xyz, cage[at + 1u].xyz, cage[at + 2u].xyz, cage[at + 3u].xyz, deviations);
}

// v by the axes of a Gaussian, in its standard deviations.
fn in_deviations(g: Gaussian, v: vec3f) -> vec3f {
    return vec3f(dot(g.x, v), dot(g.y, v), dot(g.z, v)) / g.deviations;
}

// Whitened by another Gaussian, and less what that one is itself: precision 1 and mean 0.
fn whitened(g: Gaussian, by: Gaussian) -> Dual {
    let x = by.deviations.x * in_deviations(g, by.x);
    let y = by.deviations.y * in_deviations(g, by.y);
    let z = by.deviations.z * in_deviations(g, by.z);
    let mean = in_deviations(g, g.mean - by.mean);
    return Dual(Symmetric(vec3f(dot(x, x), dot(y, y), dot(z, z)) - 1.0, vec3f(dot(y, z), dot(x, z), dot(x, y))),
        vec3f(dot(x, mean), dot(y, mean), dot(z, mean)));
}

// The first control point of a patch less what the first vertex of the ring is; of others the difference to the first of the patch.
fn control_point(face: PosedFace, entry: u32) -> Dual {
    let row = face.rows + face.width * entry;
    var point = nothing();
    for (var k = 1u; k < face.width; k++) {
        point = sum(point, kept(face.scratch + DUAL_FLOATS * k), pose_rows[row + k]);
    }
    return point;
}

// Where things are in table A.
fn patch_entries() -> u32 {
    return FRAME_ENTRIES + 2u * pose.controls + (pose.controls + 3u) / 4u;
}

fn read_control(first: u32, k: u32) -> Dual {
    let at = first + FRAME_ENTRIES + 2u * k;
    let a = surface_a[at];
    let b = surface_a[at + 1u];
    let c = surface_a[first + FRAME_ENTRIES + 2u * pose.controls + (k >> 2u)][k & 3u];
    return Dual(Symmetric(vec3f(a.x, a.w, b.y), vec3f(b.x, a.z, a.y)), vec3f(b.zw, c));
}

fn write_control(first: u32, k: u32, q: Dual) {
    let at = first + FRAME_ENTRIES + 2u * k;
    let d = q.precisions.diagonal;
    let o = q.precisions.opposite;
    surface_a[at] = vec4f(d.x, o.z, o.y, d.y);
    surface_a[at + 1u] = vec4f(o.x, d.z, q.information.xy);
    surface_a[first + FRAME_ENTRIES + 2u * pose.controls + (k >> 2u)][k & 3u] = q.information.z;
}

// From the coordinates of the ring to those of a patch.
struct PatchFrame {
    x: vec3f, // axes
    y: vec3f,
    z: vec3f,
    centre: vec3f,
    unit: f32, // the length of the longest axis in object space
}

fn kept_at(face: PosedFace, patch_number: u32) -> u32 {
    return face.scratch + DUAL_FLOATS * face.width + PATCH_FLOATS * patch_number;
}

fn kept_frame(at: u32) -> PatchFrame {
    return PatchFrame(vec3f(scratch[at], 0.0, 0.0), vec3f(scratch[at + 1u], scratch[at + 2u], 0.0),
        vec3f(scratch[at + 3u], scratch[at + 4u], scratch[at + 5u]), vec3f(scratch[at + 6u], scratch[at + 7u], scratch[at + 8u]),
        scratch[at + 9u]);
}

// The columns of the inverse transpose of the Cholesky factor.
fn whitening(p: Symmetric) -> PatchFrame {
    let a = sqrt(p.diagonal.x);
    let b = p.opposite.zy / a;
    let c = sqrt(p.diagonal.y - b.x * b.x);
    let d = (p.opposite.x - b.x * b.y) / c;
    let e = sqrt(p.diagonal.z - b.y * b.y - d * d);
    let y = vec3f(-b.x / a, 1.0, 0.0) / c;
    let z = vec3f((b.x * d / c - b.y) / a, -d / c, 1.0) / e;
    return PatchFrame(vec3f(1.0 / a, 0.0, 0.0), y, z, vec3f(0.0), 1.0);
}

fn is_finite_vector(v: vec3f) -> bool {
    return all(abs(v) < vec3f(LARGEST)); // not of not-a-numbers
}

// Finds the frame of a patch, and writes it in object space.
fn keep_frame(face: PosedFace, patch_number: u32) {
    let first_entry = face.first + patch_entries() * patch_number;
    let at = kept_at(face, patch_number);
    var first = read_control(first_entry, 0u);
    first.precisions.diagonal += 1.0;
    keep(at + KEPT_FIRST, first);
    var mean = first;
    for (var k = 1u; k < pose.controls; k++) {
        mean = sum(mean, read_control(first_entry, k), 1.0 / f32(pose.controls));
    }
    var own = whitening(mean.precisions);
    let f = factors(mean.precisions);
    own.centre = solve(f, mean.information);
    let is_definite = f.is_definite && is_finite_vector(own.x) && is_finite_vector(own.y) && is_finite_vector(own.z);
    if !is_definite { // in the coordinates of the ring
        own = PatchFrame(vec3f(1.0, 0.0, 0.0), vec3f(0.0, 1.0, 0.0), vec3f(0.0, 0.0, 1.0), vec3f(0.0), 1.0);
    }
    let ring = gaussian(pose_words[face.ring]);
    let x = in_object_space(ring, own.x);
    let y = in_object_space(ring, own.y);
    let z = in_object_space(ring, own.z);
    own.unit = sqrt(max(dot(x, x), max(dot(y, y), dot(z, z))));
    scratch[at] = own.x.x;
    scratch[at + 1u] = own.y.x;
    scratch[at + 2u] = own.y.y;
    keep_vector(at + 3u, own.z);
    keep_vector(at + 6u, own.centre);
    scratch[at + 9u] = own.unit;
    let centre = ring.mean + in_object_space(ring, own.centre);
    surface_a[first_entry] = vec4f(x / own.unit, centre.x);
    surface_a[first_entry + 1u] = vec4f(y / own.unit, centre.y);
    surface_a[first_entry + 2u] = vec4f(z / own.unit, centre.z);
}

fn in_object_space(ring: Gaussian, v: vec3f) -> vec3f {
    let w = ring.deviations * v;
    return w.x * ring.x + w.y * ring.y + w.z * ring.z;
}

// A point of dual space, or a difference of two, in the coordinates of a patch.
fn in_frame(frame: PatchFrame, q: Dual) -> Dual {
    let x = times(q.precisions, frame.x);
    let y = times(q.precisions, frame.y);
    let z = times(q.precisions, frame.z);
    let information = q.information - times(q.precisions, frame.centre);
    return Dual(
        Symmetric(vec3f(dot(frame.x, x), dot(frame.y, y), dot(frame.z, z)), vec3f(dot(frame.y, z), dot(frame.x, z), dot(frame.x, y))),
        frame.unit * vec3f(dot(frame.x, information), dot(frame.y, information), dot(frame.z, information)));
}

fn settle_control(face: PosedFace, entry: u32) {
    let patch_number = entry / pose.controls;
    let k = entry % pose.controls;
    let first_entry = face.first + patch_entries() * patch_number;
    let at = kept_at(face, patch_number);
    let frame = kept_frame(at);
    // The same for all of the patch, so that their differences are exact to their own digits.
    var q = in_frame(frame, kept(at + KEPT_FIRST));
    if k != 0u {
        q = sum(q, in_frame(frame, read_control(first_entry, k)), 1.0);
    }
    write_control(first_entry, k, q);
}

// The mean of a control point about the middle of its patch, object space.
fn offset(first_entry: u32, k: u32) -> vec3f {
    let q = read_control(first_entry, k);
    let f = factors(q.precisions);
    if !f.is_definite {
        return vec3f(0.0);
    }
    let mean = solve(f, q.information);
    return mean.x * surface_a[first_entry].xyz + mean.y * surface_a[first_entry + 1u].xyz + mean.z * surface_a[first_entry + 2u].xyz;
}

// The area vector of a patch, from its corners.
fn keep_area(face: PosedFace, patch_number: u32) {
    let first_entry = face.first + patch_entries() * patch_number;
    let is_square = pose.controls == 16u;
    let start = offset(first_entry, 0u);
    let right = offset(first_entry, select(4u, 3u, is_square)) - start;
    let last = offset(first_entry, select(14u, 12u, is_square)) - start;
    var area = cross(right, last);
    if is_square {
        let opposite = offset(first_entry, 15u) - start;
        area = cross(right, opposite) + cross(opposite, last);
    }
    keep_vector(kept_at(face, patch_number) + KEPT_AREA, select(vec3f(0.0), area, pose_words[face.counts + patch_number] == 1u));
}

// The direction of the sum of the area vectors; of the longest where they cancel.
fn keep_normal(face_number: u32, face: PosedFace) {
    var whole = vec3f(0.0);
    var lengths = 0.0;
    var longest = vec3f(0.0);
    for (var number = 0u; number < face.patches; number++) {
        let at = kept_at(face, number) + KEPT_AREA;
        let area = vec3f(scratch[at], scratch[at + 1u], scratch[at + 2u]);
        whole += area;
        lengths += length(area);
        longest = select(longest, area, dot(area, area) > dot(longest, longest));
    }
    let direction = select(longest, whole, length(whole) > 1e-6 * lengths);
    let greatest = max(abs(direction.x), max(abs(direction.y), abs(direction.z)));
    let scaled = direction / max(greatest, 1e-30);
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
    let ring = gaussian(pose_words[face.ring]);
    for (var k = lane; k < face.width; k += 64u) {
        keep(face.scratch + DUAL_FLOATS * k, whitened(gaussian(pose_words[face.ring + k]), ring));
    }
    storageBarrier();
    let entries = pose.controls * face.patches;
    for (var entry = lane; entry < entries; entry += 64u) {
        let first_entry = face.first + patch_entries() * (entry / pose.controls);
        write_control(first_entry, entry % pose.controls, control_point(face, entry));
    }
    storageBarrier();
    for (var patch_number = lane; patch_number < face.patches; patch_number += 64u) {
        keep_frame(face, patch_number);
    }
    storageBarrier();
    for (var entry = lane; entry < entries; entry += 64u) {
        settle_control(face, entry);
    }
    storageBarrier();
    for (var patch_number = lane; patch_number < face.patches; patch_number += 64u) {
        keep_area(face, patch_number);
    }
    storageBarrier();
    if lane == 0u {
        keep_normal(number, face);
    }
}
