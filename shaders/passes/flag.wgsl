// Keeps the flags that say of a leaf whether it must be half of a pair, and whether it may be. About the vertex in the middle of a leg
// lie four nodes: two children of each of the nodes that share the leg. Where one of these is a leaf, the other one's children are
// *blocked* and drawn as a pair, since that leaf has no vertex there; where all four are leaves, they are *free*: both pairs may be
// drawn, or none.
//
// Only the leaves about three legs of a change can have changed: its own two, and the one that it shares with its parent. Runs when all
// changes have happened, so that every invocation that touches a flag writes the same value.
// requires: shared/neighbour.wgsl, shared/leaf.wgsl, shared/control.wgsl, shared/frame.wgsl, shared/table_find.wgsl

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> leaves: array<Leaf>;
@group(0) @binding(2) var<storage, read> table: array<u32>;
@group(0) @binding(3) var<storage, read_write> state: array<atomic<u32>>;
@group(0) @binding(4) var<storage, read_write> lists: array<u32>;
@group(0) @binding(5) var<storage, read_write> control: Control;

fn set_flags(slot: u32, flags: u32) {
    if slot != NONE {
        atomicAnd(&state[slot], ~((PAIR | FREE) ^ flags));
        atomicOr(&state[slot], flags);
    }
}

// The leaves about the middle of a leg: of the node that has it as its X leg, children 2 and 3, and of the other one, 0 and 1.
fn flag_about(with_x: Place, with_y: Place) {
    var slots: array<u32, 4>;
    var are_leaves = 0u;
    for (var digit = 0u; digit < 4u; digit++) {
        var node = with_y;
        if digit >= 2u {
            node = with_x;
        }
        slots[digit] = find_leaf(place_child(node, digit));
        are_leaves += select(0u, 1u, slots[digit] != NONE);
    }
    if are_leaves == 0u {
        return;
    }
    let are_blocked = find_leaf(with_x) != NONE || find_leaf(with_y) != NONE;
    let flags = select(select(0u, FREE, are_leaves == 4u), PAIR, are_blocked);
    for (var digit = 0u; digit < 4u; digit++) {
        set_flags(slots[digit], flags);
    }
}

const BESIDE: u32 = 2u;

// About leg X (0) or Y (1) of a node, or the one that it shares with its parent (BESIDE).
fn flag_leg(node: Place, leg: u32) {
    var shares = node;
    var is_x = leg == 0u;
    if leg == BESIDE {
        let digit = place_digit(node);
        shares = place_parent(node, digit);
        is_x = digit >= 2u;
    }
    var with_x = shares;
    var with_y = neighbour_x(shares);
    if !is_x {
        with_x = neighbour_y(shares);
        with_y = shares;
    }
    flag_about(with_x, with_y);
}

@compute @workgroup_size(64)
fn flag(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let index = (group.x + group.y * groups.x) * 64u + lane;
    if index >= atomicLoad(&control.changes) {
        return;
    }
    let word = 2u * frame.capacity + 4u * index;
    let was_split = lists[word + 1u] != NONE;
    var node = leaf_place(leaves[lists[word]]);
    if was_split {
        node = place_parent(node, 0u);
    }
    let first = select(0u, BESIDE, node.level == MAX_LEVEL);
    let end = select(BESIDE + 1u, BESIDE, node.level == 0u);
    for (var leg = first; leg < end; leg++) {
        flag_leg(node, leg);
    }
}

// The same for all leaves, when the leaves were set from outside.
@compute @workgroup_size(64)
fn flag_all(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let slot = (group.x + group.y * groups.x) * 64u + lane;
    if slot >= control.leaves {
        return;
    }
    let node = leaf_place(leaves[slot]);
    if node.level > 0u {
        flag_leg(node, BESIDE);
    }
}
