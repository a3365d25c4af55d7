// Every leaf publishes what it wishes, and visible leaves are listed (Khoury 3.1.3, first half of the compute pass).
//
// Departure: the papers' pass copies every key from a read to a write list. Here a leaf keeps its slot, and what the surface said
// of it stays cached (`Measure`), so that a leaf that neither splits nor merges costs one distance, the frustum planes and two
// words written; nothing is evaluated, decoded or looked up. Decisions follow in `decide.wgsl`, from what all have published.
//
// An invocation takes LEAVES_PER_INVOCATION leaves, so that barriers and the two global atomics serve 512 leaves at once.
// requires: shared/leaf.wgsl, shared/control.wgsl, shared/frame.wgsl

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> measures: array<Measure>;
@group(0) @binding(2) var<storage, read> parents: array<vec4f>; // centre and guard radius of the parent of an even child
@group(0) @binding(3) var<storage, read_write> state: array<u32>; // states, then requests
@group(0) @binding(4) var<storage, read_write> lists: array<u32>; // visible, splitters, changes, freed; mergers where freed were
@group(0) @binding(5) var<storage, read_write> control: Control;

const GROUP_SIZE: u32 = 64u;
const LEAVES_PER_INVOCATION: u32 = 8u;
const ONE_STEP_LOWER: f32 = 0.8408964; // 2^(-1/4)

// What a leaf emits, in four bits of a word for the eight leaves of an invocation.
const VISIBLE: u32 = 1u;
const SPLITTER: u32 = 2u;
const MERGER: u32 = 4u;
const NEAR: u32 = 8u; // see Control.near
const OF_EACH: u32 = 0x11111111u; // times one of these: the bits of all eight

var<workgroup> emitted: atomic<u32>; // leaves of the workgroup: visible, splitters << 10, mergers << 20
var<workgroup> near: atomic<u32>;
var<workgroup> bases: vec3u; // where the workgroup's part of each list begins
var<workgroup> histogram: array<atomic<u32>, 32>;

// What an update reads once for all leaves of an invocation.
struct Terms {
    eye: vec3f,
    scale: f32,        // metric over threshold of size 1 at distance 1, under pressure
    world_from_object: mat3x3f,
    near: f32,
    guard_factor: f32,
    without_distance: bool,
    slack: f32,        // how far drawn vertices may be from the surface, at distance 1
    side: f32,         // -1 for mirrored objects, 0 where the eye is nowhere
    has_requests: bool,
    counts_near: bool,
    culling: array<vec4f, 6>,
    guard: array<vec4f, 6>,
}

fn terms(has_requests: bool) -> Terms {
    var t: Terms;
    t.eye = frame.eye;
    t.scale = frame.wish_scale * exp2(f32(-control.pressure) / 16.0);
    let m = frame.world_from_object;
    t.world_from_object = mat3x3f(m[0].xyz, m[1].xyz, m[2].xyz);
    t.side = select(select(1.0, -1.0, determinant(t.world_from_object) < 0.0), 0.0, frame.clip_from_view[3].w == 1.0);
    t.near = frame.near;
    t.guard_factor = frame.guard_factor;
    t.without_distance = frame.without_distance == 1u;
    t.slack = frame.morph_slack / t.scale;
    t.has_requests = has_requests;
    t.counts_near = control.pressure > 0;
    for (var i = 0u; i < 6u; i++) {
        t.culling[i] = frame.planes[CULLING + i];
        t.guard[i] = frame.planes[GUARD + i];
    }
    return t;
}

// Is a ball outside one of six planes?
fn is_outside(planes: array<vec4f, 6>, centre: vec3f, radius: f32) -> bool {
    let at = vec4f(centre, 1.0);
    let sides = min(min(dot(planes[0], at), dot(planes[1], at)), min(dot(planes[2], at), dot(planes[3], at)));
    return min(sides, min(dot(planes[4], at), dot(planes[5], at))) < -radius;
}

// As metrics count it. `centre` is relative to the eye, in object space. Clamped at the near plane, so that a camera on the surface gets
// a finite wish.
fn distance_of(centre: vec3f, t: Terms) -> f32 {
    let there = t.world_from_object * centre;
    return select(max(sqrt(dot(there, there)), t.near), 1.0, t.without_distance);
}

// Metric over threshold; more than 1 asks for a split.
fn wish(centre: vec3f, distance: f32, size: f32, guard: f32, t: Terms) -> f32 {
    let inside = size * t.scale / distance;
    return quantise(select(inside, inside * t.guard_factor, is_outside(t.guard, centre, guard)));
}

fn publish(slot: u32, t: Terms) -> u32 {
    let measure = measures[slot];
    let before = state[slot];
    let digit = state_digit(before);
    let centre = measure.centre - t.eye;
    var parent = vec4f(0.0);
    if (digit & 1u) == 0u {
        parent = parents[slot] - vec4f(t.eye, 0.0);
    }
    let distance = distance_of(centre, t);
    var wanted = wish(centre, distance, measure.size, measure.guard, t);
    if t.has_requests {
        wanted = max(wanted, bitcast<f32>(state[frame.capacity + slot]));
        state[frame.capacity + slot] = 0u;
    }
    let mature = (before & FRESH) == 0u;
    let merges = mature && publishes_merge(digit)
        && wish(parent.xyz, distance_of(parent.xyz, t), measure.parent_size, parent.w, t) <= 1.0;
    let flags = pair_flags(slot, before, t);
    state[slot] = state_from_wish(wanted) | (before & (7u << DIGIT_SHIFT)) | flags
        | select(0u, MATURE, mature) | select(0u, MERGE, merges);

    // The odd half of a pair is not drawn: the even one takes its place, and reaches as far as their parent.
    let is_pair = (flags & PAIR) != 0u;
    let hidden = is_pair && (digit & 1u) == 1u;
    var seen = select(vec4f(centre, measure.radius), vec4f(parent.xyz, measure.parent_radius), is_pair);
    seen.w += t.slack * distance;
    return select(0u, VISIBLE, !hidden && !is_outside(t.culling, seen.xyz, seen.w) && may_face_eye(slot, seen, t.side))
        | select(0u, SPLITTER, wanted > 1.0)
        | select(0u, MERGER, merges)
        | select(0u, NEAR, t.counts_near && wanted <= 1.0 && wanted > ONE_STEP_LOWER);
}

// At most 512 of each.
fn unpacked(counts: u32) -> vec3u {
    return vec3u(counts & 0x3ffu, (counts >> 10u) & 0x3ffu, counts >> 20u);
}

fn update_leaves(group: u32, lane: u32, has_requests: bool) {
    if lane < BUCKETS {
        atomicStore(&histogram[lane], 0u);
    }
    if lane == 0u {
        atomicStore(&emitted, 0u);
        atomicStore(&near, 0u);
    }
    workgroupBarrier();

    let first = group * (GROUP_SIZE * LEAVES_PER_INVOCATION) + lane;
    let leaves = control.leaves;
    let t = terms(has_requests);
    var emits = 0u;
    for (var i = 0u; i < LEAVES_PER_INVOCATION; i++) {
        let slot = first + i * GROUP_SIZE;
        if slot < leaves {
            emits |= publish(slot, t) << (4u * i);
        }
    }
    // Few leaves want to change: loops over those.
    for (var rest = emits & (OF_EACH * SPLITTER); rest != 0u; rest &= rest - 1u) {
        let slot = first + (countTrailingZeros(rest) / 4u) * GROUP_SIZE;
        atomicAdd(&histogram[wish_bucket(state_wish(state[slot]))], 1u);
    }

    let counts = vec3u(countOneBits(emits & (OF_EACH * VISIBLE)), countOneBits(emits & (OF_EACH * SPLITTER)),
        countOneBits(emits & (OF_EACH * MERGER)));
    let before = unpacked(atomicAdd(&emitted, counts.x | (counts.y << 10u) | (counts.z << 20u)));
    if t.counts_near {
        atomicAdd(&near, countOneBits(emits & (OF_EACH * NEAR)));
    }
    workgroupBarrier();
    if lane == 0u {
        let all = unpacked(atomicLoad(&emitted));
        bases = vec3u(atomicAdd(&control.visible, all.x), frame.capacity + atomicAdd(&control.splitters, all.y),
            3u * frame.capacity + atomicAdd(&control.mergers, all.z));
        if t.counts_near {
            atomicAdd(&control.near, atomicLoad(&near));
        }
    }
    if lane < BUCKETS {
        let count = atomicLoad(&histogram[lane]);
        if count != 0u {
            atomicAdd(&control.wishes[lane], count);
        }
    }
    workgroupBarrier();

    var next = bases + before;
    for (var i = 0u; i < LEAVES_PER_INVOCATION; i++) {
        if ((emits >> (4u * i)) & VISIBLE) != 0u {
            lists[next.x] = first + i * GROUP_SIZE;
            next.x += 1u;
        }
    }
    for (var rest = emits & (OF_EACH * (SPLITTER | MERGER)); rest != 0u; rest &= rest - 1u) {
        let bit = countTrailingZeros(rest);
        let is_splitter = (bit & 3u) == 1u;
        lists[select(next.z, next.y, is_splitter)] = first + (bit / 4u) * GROUP_SIZE;
        next += select(vec3u(0u, 0u, 1u), vec3u(0u, 1u, 0u), is_splitter);
    }
}

@compute @workgroup_size(64)
fn update(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    update_leaves(group.x + group.y * groups.x, lane, false);
}

// The same where finer leaves have raised requests.
@compute @workgroup_size(64)
fn update_requested(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    update_leaves(group.x + group.y * groups.x, lane, true);
}
