// Keeps the pair flags: a leaf is half of a pair, and blocked, while C(n) is a leaf. Only leaves made in this pass, and the at most
// four finer ones across the legs of each change, can have changed. Runs when all changes have happened, so that every invocation
// that touches a flag writes the same value.
// requires: shared/neighbour.wgsl, shared/leaf.wgsl, shared/control.wgsl, shared/frame.wgsl, shared/table_find.wgsl

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> leaves: array<Leaf>;
@group(0) @binding(2) var<storage, read> table: array<u32>;
@group(0) @binding(3) var<storage, read_write> state: array<atomic<u32>>;
@group(0) @binding(4) var<storage, read_write> lists: array<u32>;
@group(0) @binding(5) var<storage, read_write> control: Control;

fn set_pair(slot: u32, is_pair: bool) {
    if slot == NONE {
        return;
    }
    if is_pair {
        atomicOr(&state[slot], PAIR);
    } else {
        atomicAnd(&state[slot], ~PAIR);
    }
}

// The children of m along the leg that it shares with the node that changed: pairs if that node is a leaf now.
fn flag_finer(m: Place, digits: vec2u, is_leaf: bool) {
    set_pair(find_leaf(place_child(m, digits.x)), is_leaf);
    set_pair(find_leaf(place_child(m, digits.y)), is_leaf);
}

@compute @workgroup_size(64)
fn flag(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let index = (group.x + group.y * groups.x) * 64u + lane;
    if index >= atomicLoad(&control.changes) {
        return;
    }
    let word = 2u * frame.capacity + 4u * index;
    let first = lists[word];
    let was_split = lists[word + 1u] != NONE;
    let made = leaf_place(leaves[first]);
    var node = made;
    if was_split {
        node = place_parent(made, 0u);
    } else if made.level > 0u {
        set_pair(first, find_leaf(across_outer_leg(made, place_digit(made))) != NONE);
    }
    let x = neighbour_x(node);
    let y = neighbour_y(node);
    let x_is_leaf = find_leaf(x) != NONE;
    let y_is_leaf = find_leaf(y) != NONE;
    if was_split {
        set_pair(first, y_is_leaf);
        set_pair(lists[word + 1u], y_is_leaf);
        set_pair(lists[word + 2u], x_is_leaf);
        set_pair(lists[word + 3u], x_is_leaf);
    }
    if !x_is_leaf && node.level < MAX_LEVEL {
        flag_finer(x, vec2u(0u, 1u), !was_split);
    }
    if !y_is_leaf && node.level < MAX_LEVEL {
        flag_finer(y, vec2u(2u, 3u), !was_split);
    }
}

// The same for all leaves, when the leaves were set from outside.
@compute @workgroup_size(64)
fn flag_all(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let slot = (group.x + group.y * groups.x) * 64u + lane;
    if slot >= control.leaves {
        return;
    }
    let place = leaf_place(leaves[slot]);
    set_pair(slot, place.level > 0u && find_leaf(across_outer_leg(place, place_digit(place))) != NONE);
}
