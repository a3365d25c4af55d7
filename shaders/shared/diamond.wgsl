// What bounds ask of a leaf's diamond: the leaf and the node across its hypotenuse (ARCHITECTURE section 1). In root space it is an
// axis-parallel square of side 2^-level, or, on a mesh edge, two halves of one in two roots. Twin: keyleaf-surface `diamond`.
// requires: shared/place.wgsl

// The middle of the hypotenuse, which both halves share. At level 31 it falls between the integers; there, the middle of the
// parent's hypotenuse stands in: it is an end of this hypotenuse, and the end whose coordinates are odd.
fn diamond_centre(leaf: Place) -> FaceCoord {
    let half = unit(leaf.level) >> 1u;
    let middle = offset(leaf, half, half);
    let right = offset(leaf, 1u, 0u);
    let up = offset(leaf, 0u, 1u);
    let at = select(middle, select(up, right, (right.x & 1u) == 1u), half == 0u);
    return FaceCoord(leaf.root, at.x, at.y);
}

// 2^-level: sizes are this times a length of the root.
fn level_scale(level: u32) -> f32 {
    return fixed_to_float(unit(level));
}

// The same for what surrounds diamond_centre, which at level 31 is the parent's.
fn ball_scale(level: u32) -> f32 {
    return fixed_to_float(unit(min(level, MAX_LEVEL - 1u)));
}

// Whether a corner of the diamond lies on the mesh edge of its root.
fn diamond_touches_edge(leaf: Place) -> bool {
    let u = unit(leaf.level);
    let right = offset(leaf, u, 0u);
    let up = offset(leaf, 0u, u);
    let right_sum = right.x + right.y;
    let up_sum = up.x + up.y;
    // Of a whole square the fourth corner is R + U - O.
    return max(right_sum, up_sum) == ONE || max(leaf.x + leaf.y, right_sum + up_sum - leaf.x - leaf.y) == ONE;
}

// Whether the hypotenuse lies on the mesh edge, so that the other half of the diamond is in another face.
fn diamond_crosses_edge(leaf: Place) -> bool {
    return leaf.orientation == 0u && leaf.x + leaf.y + unit(leaf.level) == ONE;
}

// How many times the rounding error of a centre a guard radius must leave room for, so that a ball holds those of its children.
fn guard_margin(level: u32, margin: f32) -> f32 {
    return 2.0 * margin * f32(33u - level);
}
