// The changes of `decide_alone`: a leaf splits, or merges into its parent's slot if it is child 0, or frees its own.
// requires: shared/neighbour.wgsl, shared/leaf.wgsl, shared/control.wgsl, shared/frame.wgsl

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read_write> leaves: array<Leaf>;
@group(0) @binding(2) var<storage, read_write> table: array<u32>;
@group(0) @binding(3) var<storage, read_write> state: array<u32>;
@group(0) @binding(4) var<storage, read_write> lists: array<u32>;
@group(0) @binding(5) var<storage, read_write> control: Control;

fn settle_in(slot: u32, leaf: Leaf, digit: u32) {
    leaves[slot] = leaf;
    state[slot] = FRESH | (digit << DIGIT_SHIFT);
}

fn split(slot: u32, word: u32) {
    let leaf = leaves[slot];
    let added = atomicAdd(&control.allocated, 3u);
    for (var digit = 0u; digit < 4u; digit++) {
        let home = select(added + digit - 1u, slot, digit == 0u);
        settle_in(home, leaf_child(leaf, place_child(leaf_place(leaf), digit), digit), digit);
        lists[word + digit] = home;
    }
    atomicAdd(&control.splits, 1u);
}

@compute @workgroup_size(64)
fn apply(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let index = (group.x + group.y * groups.x) * 64u + lane;
    if index >= atomicLoad(&control.changes) {
        return;
    }
    let word = 2u * frame.capacity + 4u * index;
    let slot = lists[word];
    if lists[word + 1u] == NONE {
        split(slot, word);
        return;
    }
    lists[word + 1u] = NONE; // a record of one new leaf from here on
    let leaf = leaves[slot];
    let place = leaf_place(leaf);
    if place_digit(place) == 0u {
        let parent = place_parent(place, 0u);
        settle_in(slot, leaf_parent(leaf, parent), kept_digit(parent));
        atomicAdd(&control.merges, 1u);
    } else {
        leaves[slot].node_hi = 0u;
        leaves[slot].node_lo = 0u;
        lists[3u * frame.capacity + atomicAdd(&control.freed, 1u)] = slot;
    }
}
