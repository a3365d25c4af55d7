// The decided changes happen: a split half keeps its slot for child 0 and takes three new ones; a merged one keeps child 0's slot
// for the parent and frees three. The table follows. One invocation a record, each touching slots that no other record names.
// requires: shared/neighbour.wgsl, shared/leaf.wgsl, shared/control.wgsl, shared/frame.wgsl, shared/table_change.wgsl

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read_write> leaves: array<Leaf>;
@group(0) @binding(2) var<storage, read_write> table: array<atomic<u32>>;
@group(0) @binding(3) var<storage, read_write> state: array<u32>;
@group(0) @binding(4) var<storage, read_write> lists: array<u32>;
@group(0) @binding(5) var<storage, read_write> control: Control;

fn settle_in(slot: u32, leaf: Leaf, place: Place, digit: u32) {
    var settled = leaf;
    settled.entry = insert_leaf(place, slot);
    leaves[slot] = settled;
    state[slot] = FRESH | (digit << DIGIT_SHIFT);
    state[frame.capacity + slot] = 0u;
}

fn split(slot: u32, word: u32) {
    let leaf = leaves[slot];
    let place = leaf_place(leaf);
    remove_leaf(leaf.entry);
    let added = atomicAdd(&control.allocated, 3u);
    for (var digit = 0u; digit < 4u; digit++) {
        let child = place_child(place, digit);
        let home = select(added + digit - 1u, slot, digit == 0u);
        settle_in(home, leaf_child(leaf, child, digit), child, digit);
        lists[word + digit] = home; // `flag` and `measure` go on from here
    }
    atomicAdd(&control.splits, 1u);
}

fn merge(slots: vec4u) {
    let leaf = leaves[slots.x];
    let place = place_parent(leaf_place(leaf), 0u);
    let freed = 3u * frame.capacity + atomicAdd(&control.freed, 3u);
    remove_leaf(leaf.entry);
    for (var i = 1u; i < 4u; i++) {
        remove_leaf(leaves[slots[i]].entry);
        leaves[slots[i]].node_lo = 0u; // no key is 0: the slot is free
        leaves[slots[i]].node_hi = 0u;
        lists[freed + i - 1u] = slots[i];
    }
    settle_in(slots.x, leaf_parent(leaf, place), place, kept_digit(place));
    atomicAdd(&control.merges, 1u);
}

@compute @workgroup_size(64)
fn apply(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let index = (group.x + group.y * groups.x) * 64u + lane;
    if index >= atomicLoad(&control.changes) {
        return;
    }
    let word = 2u * frame.capacity + 4u * index;
    let slots = vec4u(lists[word], lists[word + 1u], lists[word + 2u], lists[word + 3u]);
    if slots.y == NONE {
        split(slots.x, word);
    } else {
        merge(slots);
        lists[word + 1u] = NONE; // a record of one new leaf from here on
    }
}
