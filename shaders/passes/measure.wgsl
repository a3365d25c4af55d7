// What the surface and the metric say of new leaves, and of the parents that they may merge into. Cached, so that a surface may be
// costly: `update` never evaluates it.
//
// A leaf and, for child 0, its parent go through the same call in turn: the same node must get the same bits in both roles, or a
// merge could be undone by the next pass.
// The composer adds files that keep normal cones of leaves and what is known of pairs, or do not, and that say whether roots may be pairs.
// requires: shared/neighbour.wgsl, shared/leaf.wgsl, shared/control.wgsl, shared/frame.wgsl, shared/surface.wgsl

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> leaves: array<Leaf>;
@group(0) @binding(2) var<storage, read_write> measures: array<Measure>;
@group(0) @binding(3) var<storage, read_write> parents: array<vec4f>;
@group(0) @binding(4) var<storage, read> lists: array<u32>;
@group(0) @binding(5) var<storage, read_write> control: Control;

// Whether a leaf is the even half of a pair of roots, if they are drawn as one.
fn leads_pair_of_roots(leaf: Place) -> bool {
    return ROOTS_MAY_BE_PAIRS && leaf.level == 0u && (leaf.root & 1u) == 0u && corner_count(leaf.face) == 4u;
}

fn measure_leaf(slot: u32) {
    let place = leaf_place(leaves[slot]);
    let digit = place_digit(place);
    var measure: Measure;
    var node = place;
    // Who publishes merge needs its parent, and so does an even child: as half of a pair it is drawn in its parent's ball, not its own.
    // A pair of roots has no parent, but a ball about those of both.
    let is_of_roots = leads_pair_of_roots(place);
    let last = select(0u, 1u, is_of_roots || digit != ROOT_DIGIT && (publishes_merge(digit) || (digit & 1u) == 0u));
    for (var i = 0u; i <= last; i++) {
        if i == 1u && is_of_roots {
            node = root_place(place.face, (place.root - 1u) & 3u);
        } else if i == 1u {
            node = place_parent(place, digit);
        }
        let bound = surface_bound(node);
        let size = select(metric_size(node, bound), 0.0, node.level >= frame.max_level);
        if i == 0u {
            measure.centre = bound.centre;
            measure.radius = bound.radius;
            measure.size = size;
            measure.guard = bound.guard;
        } else {
            var ball = vec4f(bound.centre, bound.radius);
            if is_of_roots {
                let between = bound.centre - measure.centre;
                ball = vec4f(measure.centre + 0.5 * between, 0.5 * length(between) + max(measure.radius, bound.radius));
            }
            measure.parent_size = size;
            measure.parent_radius = ball.w;
            parents[slot] = vec4f(ball.xyz, bound.guard);
        }
    }
    measures[slot] = measure;
    keep_cone(slot, place, digit);
    keep_pair(slot, place, digit);
}

// Four invocations a record of `apply`.
@compute @workgroup_size(64)
fn measure(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let index = (group.x + group.y * groups.x) * 64u + lane;
    if index >= 4u * atomicLoad(&control.changes) {
        return;
    }
    let slot = lists[2u * frame.capacity + index];
    let was_split = lists[2u * frame.capacity + (index & ~3u) + 1u] != NONE;
    if was_split || (index & 3u) == 0u {
        measure_leaf(slot);
    }
}

// All leaves: at the start, and when the origin, the metric or the surface has changed.
@compute @workgroup_size(64)
fn measure_all(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let slot = (group.x + group.y * groups.x) * 64u + lane;
    if slot < control.leaves {
        measure_leaf(slot);
    }
}
