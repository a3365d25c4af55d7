// Every leaf publishes what it wishes, and visible leaves are listed (Khoury 3.1.3, first half of the compute pass).
//
// Departure: the papers' pass copies every key from a read to a write list. Here a leaf keeps its slot, and what the surface said
// of it stays cached (`Measure`), so that a leaf that neither splits nor merges costs one distance, the frustum planes and two
// words written; nothing is evaluated, decoded or looked up. Decisions follow in `decide`, from what all have published.
//
// An invocation takes LEAVES_PER_INVOCATION leaves, so that barriers and the two global atomics serve 512 leaves at once.
// requires: shared/leaf.wgsl, shared/control.wgsl, shared/frame.wgsl

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> measures: array<Measure>;
@group(0) @binding(2) var<storage, read> parents: array<vec4f>; // centre and guard radius of the parent of an even child
@group(0) @binding(3) var<storage, read_write> state: array<u32>; // states, then requests
@group(0) @binding(4) var<storage, read_write> lists: array<u32>; // visible, candidates, changes, freed
@group(0) @binding(5) var<storage, read_write> control: Control;

const GROUP_SIZE: u32 = 64u;
const LEAVES_PER_INVOCATION: u32 = 8u;
const NEAR_WISHES: u32 = 32u; // of the histogram: see Control.near
const HISTOGRAM: u32 = 33u;
const ONE_STEP_LOWER: f32 = 0.8408964; // 2^(-1/4)

var<workgroup> emitted: atomic<u32>; // visible leaves, and candidates << 16, of the workgroup
var<workgroup> visible_base: u32;
var<workgroup> candidate_base: u32;
var<workgroup> histogram: array<atomic<u32>, 33>;

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
    let distance = select(max(sqrt(dot(there, there)), frame.near), 1.0, frame.orthographic == 1u);
    let inside = size * scale / distance;
    return quantise(select(inside, inside * frame.guard_factor, is_outside(GUARD, centre, guard)));
}

// Bit 0: visible, bit 1: candidate.
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
    if counts_near && wanted <= 1.0 && wanted > ONE_STEP_LOWER {
        atomicAdd(&histogram[NEAR_WISHES], 1u);
    }
    let mature = (before & FRESH) == 0u;
    var merges = false;
    if mature && publishes_merge(digit) {
        let parent = parents[slot];
        merges = wish(parent.xyz - frame.eye, measure.parent_size, parent.w, scale) <= 1.0;
    }
    state[slot] = state_from_wish(wanted) | (before & (PAIR | (7u << DIGIT_SHIFT)))
        | select(0u, MATURE, mature) | select(0u, MERGE, merges);

    var result = 0u;
    // The odd half of a pair is not drawn: the even one takes its place, and reaches as far as their parent.
    let is_pair = (before & PAIR) != 0u;
    let hidden = is_pair && (digit & 1u) == 1u;
    var seen = vec4f(centre, measure.radius);
    if is_pair {
        seen = vec4f(parents[slot].xyz - frame.eye, measure.parent_radius);
    }
    if !hidden && !is_outside(CULLING, seen.xyz, seen.w) {
        result = 1u;
    }
    if wanted > 1.0 {
        atomicAdd(&histogram[wish_bucket(wanted)], 1u);
        result |= 2u;
    } else if merges {
        result |= 2u;
    }
    return result;
}

@compute @workgroup_size(64)
fn update(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    if lane < HISTOGRAM {
        atomicStore(&histogram[lane], 0u);
    }
    if lane == 0u {
        atomicStore(&emitted, 0u);
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
            emits |= publish(slot, scale, has_requests, counts_near) << (2u * i);
        }
    }

    let visible = countOneBits(emits & 0x55555555u);
    let candidates = countOneBits(emits & 0xaaaaaaaau);
    let before = atomicAdd(&emitted, visible | (candidates << 16u));
    workgroupBarrier();
    if lane == 0u {
        let all = atomicLoad(&emitted);
        visible_base = atomicAdd(&control.visible, all & 0xffffu);
        candidate_base = atomicAdd(&control.candidates, all >> 16u);
    }
    if lane < BUCKETS {
        let count = atomicLoad(&histogram[lane]);
        if count != 0u {
            atomicAdd(&control.wishes[lane], count);
        }
    } else if lane == NEAR_WISHES {
        atomicAdd(&control.near, atomicLoad(&histogram[NEAR_WISHES]));
    }
    workgroupBarrier();

    var next_visible = visible_base + (before & 0xffffu);
    var next_candidate = frame.capacity + candidate_base + (before >> 16u);
    for (var i = 0u; i < LEAVES_PER_INVOCATION; i++) {
        let slot = first + i * GROUP_SIZE;
        if ((emits >> (2u * i)) & 1u) != 0u {
            lists[next_visible] = slot;
            next_visible += 1u;
        }
        if ((emits >> (2u * i)) & 2u) != 0u {
            lists[next_candidate] = slot;
            next_candidate += 1u;
        }
    }
}
