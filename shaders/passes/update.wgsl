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

// Is a ball outside one of six planes? `first`: CULLING or GUARD.
fn is_outside(first: u32, centre: vec3f, radius: f32) -> bool {
    var nearest = dot(frame.planes[first].xyz, centre) + frame.planes[first].w;
    for (var i = 1u; i < 6u; i++) {
        let plane = frame.planes[first + i];
        nearest = min(nearest, dot(plane.xyz, centre) + plane.w);
    }
    return nearest < -radius;
}

// Metric over threshold; more than 1 asks for a split. `centre` is relative to the eye, in object space. Clamped at the near plane,
// so that a camera on the surface gets a finite wish.
fn wish(centre: vec3f, size: f32, guard: f32, scale: f32) -> f32 {
    let there = (frame.world_from_object * vec4f(centre, 0.0)).xyz;
    let distance = select(max(sqrt(dot(there, there)), frame.near), 1.0, frame.without_distance == 1u);
    let inside = size * scale / distance;
    return quantise(select(inside, inside * frame.guard_factor, is_outside(GUARD, centre, guard)));
}

fn publish(slot: u32, scale: f32, has_requests: bool, counts_near: bool) -> u32 {
    let measure = measures[slot];
    let before = state[slot];
    let digit = state_digit(before);
    let centre = measure.centre - frame.eye;
    var wanted = wish(centre, measure.size, measure.guard, scale);
    if has_requests {
        wanted = max(wanted, bitcast<f32>(state[frame.capacity + slot]));
        state[frame.capacity + slot] = 0u;
    }
    let mature = (before & FRESH) == 0u;
    var merges = false;
    if mature && publishes_merge(digit) {
        let parent = parents[slot];
        merges = wish(parent.xyz - frame.eye, measure.parent_size, parent.w, scale) <= 1.0;
    }
    state[slot] = state_from_wish(wanted) | (before & (PAIR | (7u << DIGIT_SHIFT)))
        | select(0u, MATURE, mature) | select(0u, MERGE, merges);

    // The odd half of a pair is not drawn: the even one takes its place, and reaches as far as their parent.
    let is_pair = (before & PAIR) != 0u;
    let hidden = is_pair && (digit & 1u) == 1u;
    var seen = vec4f(centre, measure.radius);
    if is_pair {
        seen = vec4f(parents[slot].xyz - frame.eye, measure.parent_radius);
    }
    if wanted > 1.0 {
        atomicAdd(&histogram[wish_bucket(wanted)], 1u);
    }
    return select(0u, VISIBLE, !hidden && !is_outside(CULLING, seen.xyz, seen.w))
        | select(0u, SPLITTER, wanted > 1.0)
        | select(0u, MERGER, merges)
        | select(0u, NEAR, counts_near && wanted <= 1.0 && wanted > ONE_STEP_LOWER);
}

// At most 512 of each.
fn unpacked(counts: u32) -> vec3u {
    return vec3u(counts & 0x3ffu, (counts >> 10u) & 0x3ffu, counts >> 20u);
}

@compute @workgroup_size(64)
fn update(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    if lane < BUCKETS {
        atomicStore(&histogram[lane], 0u);
    }
    if lane == 0u {
        atomicStore(&emitted, 0u);
        atomicStore(&near, 0u);
    }
    workgroupBarrier();

    let first = (group.x + group.y * groups.x) * (GROUP_SIZE * LEAVES_PER_INVOCATION) + lane;
    let leaves = control.leaves;
    let scale = frame.wish_scale * exp2(f32(-control.pressure) / 16.0);
    let has_requests = atomicLoad(&control.requests) != 0u;
    let counts_near = control.pressure > 0;
    var emits = 0u;
    for (var i = 0u; i < LEAVES_PER_INVOCATION; i++) {
        let slot = first + i * GROUP_SIZE;
        if slot < leaves {
            emits |= publish(slot, scale, has_requests, counts_near) << (4u * i);
        }
    }

    let counts = vec3u(countOneBits(emits & (OF_EACH * VISIBLE)), countOneBits(emits & (OF_EACH * SPLITTER)),
        countOneBits(emits & (OF_EACH * MERGER)));
    let before = unpacked(atomicAdd(&emitted, counts.x | (counts.y << 10u) | (counts.z << 20u)));
    if counts_near {
        atomicAdd(&near, countOneBits(emits & (OF_EACH * NEAR)));
    }
    workgroupBarrier();
    if lane == 0u {
        let all = unpacked(atomicLoad(&emitted));
        bases = vec3u(atomicAdd(&control.visible, all.x), frame.capacity + atomicAdd(&control.splitters, all.y),
            3u * frame.capacity + atomicAdd(&control.mergers, all.z));
        if counts_near {
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
        let slot = first + i * GROUP_SIZE;
        let emit = emits >> (4u * i);
        if (emit & VISIBLE) != 0u {
            lists[next.x] = slot;
            next.x += 1u;
        }
        if (emit & SPLITTER) != 0u {
            lists[next.y] = slot;
            next.y += 1u;
        }
        if (emit & MERGER) != 0u {
            lists[next.z] = slot;
            next.z += 1u;
        }
    }
}
