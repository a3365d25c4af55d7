// From what all leaves published it is decided which diamonds split, which merge, and whom blocked leaves request to split
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
    let blocked = is_blocked(here);
    let h = neighbour_h(p);
    if h.face == NONE {
        if !blocked {
            record(atomicAdd(&control.changes, 1u), vec4u(slot, SPLIT, SPLIT, SPLIT));
        }
    } else if !blocked {
        let other = find_promised(h);
        if other != NONE && slot < other { // once a diamond
            let there = state_of(other);
            if wants(there) && !is_blocked(there) {
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

// The slots of the four children of a node if all are leaves that may go, and no child of the nodes across its legs is split or is
// about to be; x = NONE if not. `first`: the slot of child 0.
//
// A leaf that is blocked tells that the node across that leg is a leaf, so that nothing there needs a look. Where it is not, it is split, by
// (I2). Look-ups that are likely to object come first, and all are one loop: most leaves that speak for a satisfied parent stay
// refused for long, because finer leaves lie across a leg.
fn mergeable_children(q: Place, first: u32) -> vec4u {
    var slots = vec4u(first, NONE, NONE, NONE);
    let here = state_of(first);
    if (here & (MERGE | MATURE)) != (MERGE | MATURE) || wants(here) {
        return vec4u(NONE);
    }
    let across_x = neighbour_x(q);
    let across_y = neighbour_y(q);
    var end = 7u;
    for (var step = select(0u, 2u, is_blocked(here)); step < end; step++) {
        var node = across_y; // children 2 and 3
        var digit = step + 2u;
        if step >= 5u {
            node = across_x; // children 0 and 1
            digit = step - 5u;
        } else if step >= 2u {
            node = q; // children 2, 3 and 1
            digit = select(step, 1u, step == 4u);
        }
        let slot = find_leaf(place_child(node, digit));
        if slot == NONE {
            return vec4u(NONE);
        }
        let there = state_of(slot);
        if wants(there) {
            return vec4u(NONE);
        }
        if step >= 2u && step < 5u {
            if (there & MATURE) == 0u {
                return vec4u(NONE);
            }
            slots[digit] = slot;
            end = select(7u, 5u, digit == 2u && is_blocked(there) || end == 5u);
        }
    }
    return slots;
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
        record(atomicAdd(&control.changes, 1u), children);
        return;
    }
    let others = mergeable_children(h, other);
    if others.x != NONE {
        let index = atomicAdd(&control.changes, 2u);
        record(index, children);
        record(index + 1u, others);
    }
}

@compute @workgroup_size(64)
fn decide_splits(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let index = (group.x + group.y * groups.x) * 64u + lane;
    if index >= atomicLoad(&control.splitters) {
        return;
    }
    let slot = lists[frame.capacity + index];
    let here = state_of(slot);
    if wants(here) { // else it waits for admission
        decide_split(slot, here, leaf_place(leaves[slot]));
    }
}

@compute @workgroup_size(64)
fn decide_merges(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let index = (group.x + group.y * groups.x) * 64u + lane;
    if index < atomicLoad(&control.mergers) {
        let slot = lists[3u * frame.capacity + index];
        decide_merge(slot, leaf_place(leaves[slot]));
    }
}
