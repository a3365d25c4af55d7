// The update without the neighbour test, as a measure of what the test costs: every leaf follows its own metric, the four children of
// a node merge because they compute the same metric of it, and the surface cracks (Khoury 3.1.3 without 2.3.2).
// requires: shared/leaf.wgsl, shared/control.wgsl, shared/frame.wgsl

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> leaves: array<Leaf>;
@group(0) @binding(2) var<storage, read> table: array<u32>;
@group(0) @binding(3) var<storage, read_write> state: array<u32>;
@group(0) @binding(4) var<storage, read_write> lists: array<u32>;
@group(0) @binding(5) var<storage, read_write> control: Control;

fn record(slot: u32, second: u32) {
    let word = 2u * frame.capacity + 4u * atomicAdd(&control.changes, 1u);
    lists[word] = slot;
    lists[word + 1u] = second;
}

fn wants(state: u32) -> bool {
    let wish = state_wish(state);
    return wish > 1.0 && wish_bucket(wish) >= control.lowest_bucket;
}

@compute @workgroup_size(64)
fn decide_splits(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let index = (group.x + group.y * groups.x) * 64u + lane;
    if index >= atomicLoad(&control.splitters) {
        return;
    }
    let slot = lists[frame.capacity + index];
    if wants(state[slot]) {
        record(slot, NONE);
    }
}

@compute @workgroup_size(64)
fn decide_merges(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let index = (group.x + group.y * groups.x) * 64u + lane;
    if index >= atomicLoad(&control.mergers) {
        return;
    }
    let slot = lists[3u * frame.capacity + index];
    if !wants(state[slot]) {
        record(slot, 0u);
    }
}
