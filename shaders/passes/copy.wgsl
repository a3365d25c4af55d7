// Turns counts into arguments (Khoury 3.1.3, copy pass), three times a frame, with one invocation: after the decisions, after `apply`,
// and after `update`, where it also admits wishes and keeps the pressure (ARCHITECTURE section 4; twin: keyleaf-key `pressure`).
// Only this pass writes the indirect arguments.
// requires: shared/leaf.wgsl, shared/control.wgsl, shared/frame.wgsl

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read_write> control: Control;
@group(0) @binding(2) var<storage, read_write> arguments: array<u32>;

// Where each dispatch finds its three words. Rust: keyleaf `quadtree::layout`.
const FOR_SPLITS: u32 = 0u;
const FOR_MERGES: u32 = 4u;
const FOR_CHANGES: u32 = 8u;
const FOR_MEASURE: u32 = 12u;
const FOR_COMPACT: u32 = 16u;
const FOR_CLEAR: u32 = 20u;
const FOR_ENTER: u32 = 24u;
const FOR_UPDATE: u32 = 28u;
const FOR_UPDATE_REQUESTED: u32 = 32u; // in its place where there are requests
const FOR_LEAVES: u32 = 36u; // an invocation a leaf
const FOR_DRAW: u32 = 40u;   // index count, instance count, first index, base vertex, first instance

const GROUP_SIZE: u32 = 64u;
const UPDATE_LEAVES: u32 = 512u; // that a workgroup of `update` takes
const MAX_GROUPS: u32 = 65535u;  // a dimension, by WebGPU's limits

// Patience before the pressure changes: passes without a change, or, while the camera moves, passes since its last step.
const IDLE_PASSES: u32 = 3u;
const PASSES_IN_MOTION: u32 = 16u;
const NO_FAILURE: i32 = -1;
// A step of 2^(1/4), in sixteenths of an octave.
const PRESSURE_STEP: i32 = 4;

fn groups_for(items: u32, group: u32, at: u32) {
    let groups = (items + group - 1u) / group;
    let rows = (groups + MAX_GROUPS - 1u) / MAX_GROUPS;
    arguments[at] = select((groups + rows - 1u) / max(rows, 1u), 0u, groups == 0u);
    arguments[at + 1u] = max(rows, 1u);
    arguments[at + 2u] = 1u;
}

@compute @workgroup_size(1)
fn copy_changes() {
    let changes = atomicLoad(&control.changes);
    groups_for(changes, GROUP_SIZE, FOR_CHANGES);
    groups_for(4u * changes, GROUP_SIZE, FOR_MEASURE);
    atomicStore(&control.allocated, control.leaves);
    atomicStore(&control.splits, 0u);
    atomicStore(&control.merges, 0u);
    atomicStore(&control.freed, 0u);
    atomicStore(&control.sources, 0u);
    atomicStore(&control.targets, 0u);
}

@compute @workgroup_size(1)
fn copy_leaves() {
    let freed = atomicLoad(&control.freed);
    let leaves = atomicLoad(&control.allocated) - freed;
    control.leaves = leaves;
    groups_for(freed, GROUP_SIZE, FOR_COMPACT);
    let has_requests = atomicLoad(&control.requests) != 0u;
    groups_for(select(leaves, 0u, has_requests), UPDATE_LEAVES, FOR_UPDATE);
    groups_for(select(0u, leaves, has_requests), UPDATE_LEAVES, FOR_UPDATE_REQUESTED);
    groups_for(leaves, GROUP_SIZE, FOR_LEAVES);
    // Live entries and tombstones above 70 %: start afresh. (Written so that it does not overflow.)
    let entries = frame.table_mask + 1u;
    let full = atomicLoad(&control.entries_used) > entries / 10u * 7u;
    groups_for(select(0u, entries, full), 4u * GROUP_SIZE, FOR_CLEAR);
    groups_for(select(0u, leaves, full), GROUP_SIZE, FOR_ENTER);
    if full {
        atomicStore(&control.entries_used, 0u);
        control.rebuilds += 1u;
    }
    control.last_splits = atomicLoad(&control.splits);
    control.last_merges = atomicLoad(&control.merges);
    atomicStore(&control.changes, 0u);
    // Counted by the update that follows. The requests that `decide` raised stay until it has folded them in.
    atomicStore(&control.visible, 0u);
    atomicStore(&control.splitters, 0u);
    atomicStore(&control.mergers, 0u);
    atomicStore(&control.near, 0u);
    for (var b = 0u; b < BUCKETS; b++) {
        atomicStore(&control.wishes[b], 0u);
    }
}

// Whole buckets from the top, as long as three more slots a wish fit: both halves of a diamond get the same answer.
fn admit() {
    var free = frame.capacity - control.leaves;
    var lowest = BUCKETS;
    var unmet = 0u;
    var starved = 0u;
    var fits = true;
    for (var i = 0u; i < BUCKETS; i++) {
        let bucket = BUCKETS - 1u - i;
        let count = atomicLoad(&control.wishes[bucket]);
        unmet += count;
        fits = fits && count <= free / 3u;
        if fits && count > 0u {
            free -= 3u * count;
            lowest = bucket;
        }
        if !fits {
            starved += count;
        }
    }
    control.lowest_bucket = lowest;
    control.unmet = unmet;
    control.starved = starved;
}

// Raises the threshold while wishes do not fit, and lowers it while those of the next lower step do. A step that failed is not tried
// again for the same view, so that the pressure ends where it would from a fresh start.
fn observe_starvation() {
    let changed = control.last_splits + control.last_merges != 0u;
    control.idle = select(control.idle + 1u, 0u, changed);
    control.since_step += 1u;
    if control.view_serial != frame.view_serial {
        control.view_serial = frame.view_serial;
        control.failed = NO_FAILURE;
        control.idle = 0u;
    }
    let is_calm = control.idle >= IDLE_PASSES;
    if !is_calm && control.since_step < PASSES_IN_MOTION {
        return;
    }
    if control.starved > 0u {
        control.failed = select(NO_FAILURE, control.pressure, is_calm);
        press(control.pressure + PRESSURE_STEP);
    } else if frame.target_leaves == 0u && control.pressure > 0 {
        let lower = max(control.pressure - PRESSURE_STEP, 0);
        let room = (frame.capacity - control.leaves) / 3u;
        let near = atomicLoad(&control.near);
        // In motion there is no time to try: only what fits twice over.
        if select(near <= room / 2u, near <= room && control.failed != lower, is_calm) {
            press(lower);
        }
    }
}

fn press(pressure: i32) {
    control.pressure = pressure;
    control.idle = 0u;
    control.since_step = 0u;
}

// Steers the same threshold, in steps of a sixteenth of an octave (about 9 % of the leaves), while the count is off by more.
fn observe_target() {
    if frame.target_leaves == 0u || control.passes % 2u != 0u {
        return;
    }
    let ratio = f32(control.leaves) / f32(frame.target_leaves);
    if ratio > 1.05 {
        control.pressure += 1;
    } else if ratio < 0.95 && control.starved == 0u {
        control.pressure = max(control.pressure - 1, MIN_PRESSURE);
    }
}

// 2^-8 times the threshold: finer than any target needs.
const MIN_PRESSURE: i32 = -128;

@compute @workgroup_size(1)
fn copy_counts() {
    let visible = atomicLoad(&control.visible);
    let across = 1u << frame.base_grid;
    arguments[FOR_DRAW] = 3u * across * across;
    arguments[FOR_DRAW + 1u] = visible;
    arguments[FOR_DRAW + 2u] = 0u;
    arguments[FOR_DRAW + 3u] = 0u;
    arguments[FOR_DRAW + 4u] = 0u;
    atomicStore(&control.requests, 0u);
    admit();
    // While nothing is admitted, nobody splits: a full buffer costs no more than one with room.
    groups_for(select(atomicLoad(&control.splitters), 0u, control.lowest_bucket == BUCKETS), GROUP_SIZE, FOR_SPLITS);
    groups_for(atomicLoad(&control.mergers), GROUP_SIZE, FOR_MERGES);
    observe_starvation();
    observe_target();
    control.passes += 1u;
}
