// Candidates decide from what all leaves published: which diamonds split, which merge, and whom blocked leaves request to split
// (ARCHITECTURE section 3; twin: keyleaf-key `forest::Forest::decide`). Nothing that another decision reads is written here.
//
// Departure from the papers, which compare with the level that a neighbour *wishes*: that cracks while the camera moves (measured).
// Here only leaves that are there count. One look-up a leaf that wants to split (its H-neighbour); whether it is blocked is a flag.
// requires: shared/neighbour.wgsl, shared/leaf.wgsl, shared/control.wgsl, shared/frame.wgsl, shared/table_find.wgsl

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> leaves: array<Leaf>;
@group(0) @binding(2) var<storage, read> table: array<u32>;
@group(0) @binding(3) var<storage, read_write> state: array<atomic<u32>>; // states (read), then requests
@group(0) @binding(4) var<storage, read_write> lists: array<u32>;
@group(0) @binding(5) var<storage, read_write> control: Control;

fn state_of(slot: u32) -> u32 {
    return atomicLoad(&state[slot]);
}

fn wants(state: u32) -> bool {
    let w = state_wish(state);
    return w > 1.0 && wish_bucket(w) >= control.lowest_bucket;
}

// A look-up that the invariants promise to succeed.
fn find_promised(p: Place) -> u32 {
    let slot = find_leaf(p);
    if slot == NONE {
        atomicAdd(&control.lost, 1u);
    }
    return slot;
}

fn request(p: Place, wish: f32) {
    if p.face == NONE {
        return;
    }
    let slot = find_promised(p);
    if slot != NONE {
        atomicMax(&state[frame.capacity + slot], bitcast<u32>(wish));
        atomicAdd(&control.requests, 1u);
    }
}

const SPLIT: u32 = NONE; // in place of a second slot

fn record(index: u32, slots: vec4u) {
    let word = 2u * frame.capacity + 4u * index;
    lists[word] = slots.x;
    lists[word + 1u] = slots.y;
    lists[word + 2u] = slots.z;
    lists[word + 3u] = slots.w;
}

fn decide_split(slot: u32, here: u32, p: Place) {
    let blocked = (here & PAIR) != 0u;
    let h = neighbour_h(p);
    if h.face == NONE {
        if !blocked {
            record(atomicAdd(&control.changes, 1u), vec4u(slot, SPLIT, SPLIT, SPLIT));
        }
    } else if !blocked {
        let other = find_promised(h);
        if other != NONE && slot < other { // once a diamond
            let there = state_of(other);
            if wants(there) && (there & PAIR) == 0u {
                let index = atomicAdd(&control.changes, 2u);
                record(index, vec4u(slot, SPLIT, SPLIT, SPLIT));
                record(index + 1u, vec4u(other, SPLIT, SPLIT, SPLIT));
            }
        }
    }
    if blocked {
        let coarser = across_outer_leg(p, place_digit(p));
        request(coarser, state_wish(here));
        request(neighbour_h(coarser), state_wish(here));
    }
}

fn allows_merge(state: u32) -> bool {
    return (state & MATURE) != 0u && !wants(state);
}

// The slots of the four children of a node if all are leaves that may go; x = NONE if not.
fn mergeable_children(q: Place, first: u32) -> vec4u {
    var slots = vec4u(first, NONE, NONE, NONE);
    if (state_of(first) & MERGE) == 0u || !allows_merge(state_of(first)) {
        return vec4u(NONE);
    }
    for (var digit = 1u; digit < 4u; digit++) {
        let slot = find_leaf(place_child(q, digit));
        if slot == NONE || !allows_merge(state_of(slot)) {
            return vec4u(NONE);
        }
        slots[digit] = slot;
    }
    return slots;
}

// No child of the neighbour m, along the leg that it shares with a node about to become a leaf, is split or is about to be.
fn leg_allows_merge(m: Place, digits: vec2u) -> bool {
    let a = find_leaf(place_child(m, digits.x));
    let b = find_leaf(place_child(m, digits.y));
    if a != NONE && b != NONE {
        return !wants(state_of(a)) && !wants(state_of(b));
    }
    if a == NONE && b == NONE {
        // Both are split, or m is a leaf, or m's parent is.
        if find_leaf(m) != NONE {
            return true;
        }
        return m.level > 0u && find_leaf(place_parent(m, place_digit(m))) != NONE;
    }
    return false;
}

fn legs_allow_merge(q: Place) -> bool {
    return leg_allows_merge(neighbour_x(q), vec2u(0u, 1u)) && leg_allows_merge(neighbour_y(q), vec2u(2u, 3u));
}

fn decide_merge(slot: u32, p: Place) {
    let q = place_parent(p, 0u);
    let h = neighbour_h(q);
    var other = NONE;
    if h.face != NONE {
        other = find_leaf(place_child(h, 0u));
        if other == NONE || slot > other { // once a diamond
            return;
        }
    }
    let children = mergeable_children(q, slot);
    if children.x == NONE {
        return;
    }
    if h.face == NONE {
        if legs_allow_merge(q) {
            record(atomicAdd(&control.changes, 1u), children);
        }
        return;
    }
    let others = mergeable_children(h, other);
    if others.x != NONE && legs_allow_merge(q) && legs_allow_merge(h) {
        let index = atomicAdd(&control.changes, 2u);
        record(index, children);
        record(index + 1u, others);
    }
}

@compute @workgroup_size(64)
fn decide(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let index = (group.x + group.y * groups.x) * 64u + lane;
    if index >= atomicLoad(&control.candidates) {
        return;
    }
    let slot = lists[frame.capacity + index];
    let here = state_of(slot);
    let p = leaf_place(leaves[slot]);
    if wants(here) {
        decide_split(slot, here, p);
    } else if (here & MERGE) != 0u {
        decide_merge(slot, p);
    }
}
