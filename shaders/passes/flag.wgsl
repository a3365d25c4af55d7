// Keeps the flags that say of a leaf whether it must be half of a pair, and whether it may be. About the vertex in the middle of a leg
// lie four nodes: two children of each of the nodes that share the leg. Where one of these is a leaf, the other one's children are
// *blocked* and drawn as a pair, since that leaf has no vertex there; where all four are leaves, they are *free*: both pairs may be
// drawn, or none. About the centre of a face with four corners lie its roots, of which the same holds.
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

// About a leg of a node that changed: `own` are its children along that leg, or NONE if it is a leaf now; `digits` say which children of
// the node across lie along it.
fn flag_leg(own: vec2u, across: Place, digits: vec2u) {
    var others = vec2u(NONE);
    var flags = PAIR;
    if find_leaf(across) == NONE {
        others = vec2u(find_leaf(place_child(across, digits.x)), find_leaf(place_child(across, digits.y)));
        if all(own != vec2u(NONE)) {
            flags = select(0u, FREE, all(others != vec2u(NONE)));
        }
    }
    set_flags(own.x, flags);
    set_flags(own.y, flags);
    set_flags(others.x, flags);
    set_flags(others.y, flags);
}

// About the leg that a node shares with its parent; `slot` is NONE if the node is split.
fn flag_beside(node: Place, slot: u32) {
    let digit = place_digit(node);
    let across = across_outer_leg(node, digit);
    if slot != NONE && find_leaf(across) != NONE {
        set_flags(slot, PAIR);
        return;
    }
    let side = digit & 2u;
    let sibling = find_leaf(place_child(place_parent(node, digit), digit ^ 1u));
    let others = vec2u(find_leaf(place_child(across, 2u - side)), find_leaf(place_child(across, 3u - side)));
    let are_leaves = slot != NONE && sibling != NONE && all(others != vec2u(NONE));
    let flags = select(0u, FREE, are_leaves);
    set_flags(slot, flags);
    set_flags(sibling, flags);
    set_flags(others.x, flags);
    set_flags(others.y, flags);
}

// About the centre of a face: one of its roots has changed, or any may have.
fn flag_roots(face: u32) {
    if corner_count(face) != 4u {
        return;
    }
    var slots: vec4u;
    for (var root = 0u; root < 4u; root++) {
        slots[root] = find_leaf(root_place(face, root));
    }
    let flags = select(0u, FREE, all(slots != vec4u(NONE)));
    for (var root = 0u; root < 4u; root++) {
        set_flags(slots[root], flags);
    }
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
    var slot = lists[word];
    var children = vec4u(NONE);
    if was_split {
        node = place_parent(node, 0u);
        children = vec4u(slot, lists[word + 1u], lists[word + 2u], lists[word + 3u]);
        slot = NONE;
    }
    flag_leg(children.zw, neighbour_x(node), vec2u(0u, 1u));
    flag_leg(children.xy, neighbour_y(node), vec2u(2u, 3u));
    if node.level > 0u {
        flag_beside(node, slot);
    } else {
        flag_roots(node.face);
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
        flag_beside(node, slot);
    } else {
        flag_roots(node.face);
    }
}
