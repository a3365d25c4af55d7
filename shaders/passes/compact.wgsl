// Fills the slots that merges freed with the leaves from the end, so that slots 0..leaves are in use. As many live leaves lie behind
// the new end as free slots before it: `match` lists both, `move` moves the i-th of one into the i-th of the other.
// requires: shared/leaf.wgsl, shared/control.wgsl, shared/frame.wgsl, shared/table.wgsl

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read_write> leaves: array<Leaf>;
@group(0) @binding(2) var<storage, read_write> table: array<u32>;
@group(0) @binding(3) var<storage, read_write> state: array<u32>;
@group(0) @binding(4) var<storage, read_write> lists: array<u32>; // sources and targets take the place of the visible and candidate lists
@group(0) @binding(5) var<storage, read_write> control: Control;
@group(0) @binding(6) var<storage, read_write> measures: array<Measure>;
@group(0) @binding(7) var<storage, read_write> parents: array<vec4f>;

@compute @workgroup_size(64)
fn match_slots(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let index = (group.x + group.y * groups.x) * 64u + lane;
    if index >= atomicLoad(&control.freed) {
        return;
    }
    let end = control.leaves;
    let behind = end + index;
    if (leaves[behind].node_hi | leaves[behind].node_lo) != 0u {
        lists[atomicAdd(&control.sources, 1u)] = behind;
    }
    let free = lists[3u * frame.capacity + index];
    if free < end {
        lists[frame.capacity + atomicAdd(&control.targets, 1u)] = free;
    }
}

@compute @workgroup_size(64)
fn move_leaves(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let index = (group.x + group.y * groups.x) * 64u + lane;
    if index >= atomicLoad(&control.targets) {
        return;
    }
    let source = lists[index];
    let home = lists[frame.capacity + index];
    let leaf = leaves[source];
    leaves[home] = leaf;
    measures[home] = measures[source];
    parents[home] = parents[source];
    move_cone(source, home);
    move_pair(source, home);
    state[home] = state[source];
    state[frame.capacity + home] = state[frame.capacity + source];
    if leaf.entry != NONE {
        table[leaf.entry] = (table[leaf.entry] & ~SLOT_MASK) | (home + 1u);
    }
}
