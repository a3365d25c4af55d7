// Parents, children and neighbours of a place, in integers and without loops (ARCHITECTURE section 2; twin: keyleaf-key `place`, `neighbour`).
// The papers walk the digits of the key (Khoury algorithm 5); in exact coordinates every neighbour is one step, and only a step
// out of the root needs the mesh.
// requires: shared/place.wgsl, shared/topology.wgsl

const ROOT_DIGIT: u32 = 4u;

fn place_child(p: Place, digit: u32) -> Place {
    let half = unit(p.level) >> 1u;
    let along_x = digit >= 2u;
    let origin = offset(p, select(0u, half, along_x), select(half, 0u, along_x));
    let turn = (0x1cu >> (2u * digit)) & 3u; // digits 0..3 turn by 0, 3, 1, 0 quarters
    return Place(p.face, p.root, origin.x, origin.y, (p.orientation + turn) & 3u, p.level + 1u);
}

// The last digit of a place, 0..3, or ROOT_DIGIT. In units of the leaf, x + y is odd below the root; the step from the parent's
// origin runs along the odd coordinate, and only one of its two ends is an origin of the parent's level.
fn place_digit(p: Place) -> u32 {
    if p.level == 0u {
        return ROOT_DIGIT;
    }
    let at = vec2u(p.x, p.y) >> vec2u(MAX_LEVEL - p.level);
    let step = select(vec2u(0u, 1u), vec2u(1u, 0u), (at.x & 1u) == 1u);
    let before = (at - step) >> vec2u(1u);
    let sum = before.x + before.y;
    // The parent's origin has an odd sum too, but for the root's, which is (0, 0).
    let forward = select((sum & 1u) == 1u, sum == 0u, p.level == 1u);
    let direction = select(-vec2i(step), vec2i(step), forward);
    let x_axis = axis(p.orientation);
    if all(direction == x_axis) {
        return 3u;
    }
    if all(direction == -x_axis) {
        return 1u;
    }
    return select(2u, 0u, all(direction == axis(p.orientation + 1u)));
}

fn place_parent(p: Place, digit: u32) -> Place {
    let u = unit(p.level);
    let along_x = (digit & 1u) == 1u; // digits 1 and 3 lie along the leaf's own X axis, 0 and 2 along its Y axis
    let back = select(0u - u, u, digit == 1u || digit == 2u);
    let origin = offset(p, select(0u, back, along_x), select(back, 0u, along_x));
    let turn = (0x34u >> (2u * digit)) & 3u; // undo 0, 3, 1, 0 quarters
    return Place(p.face, p.root, origin.x, origin.y, (p.orientation + turn) & 3u, p.level - 1u);
}

fn next_root(face: u32, root: u32) -> u32 {
    return select(root + 1u, 0u, root + 1u == corner_count(face));
}

fn previous_root(face: u32, root: u32) -> u32 {
    return select(root, corner_count(face), root == 0u) - 1u;
}

fn root_place(face: u32, root: u32) -> Place {
    return Place(face, root, 0u, 0u, 0u, 0u);
}

// What the state of a leaf keeps of its digit: its last bit tells the odd half of a pair, also of roots.
fn kept_digit(p: Place) -> u32 {
    return select(place_digit(p), ROOT_DIGIT | (p.root & 1u), p.level == 0u);
}

// Across the leg O-R, which is the neighbour's leg O-U.
fn neighbour_x(p: Place) -> Place {
    if p.orientation == 0u && p.y == 0u {
        return Place(p.face, previous_root(p.face, p.root), 0u, p.x, 0u, p.level);
    }
    if p.orientation == 3u && p.x == 0u {
        return Place(p.face, next_root(p.face, p.root), p.y, 0u, 1u, p.level);
    }
    return Place(p.face, p.root, p.x, p.y, (p.orientation + 3u) & 3u, p.level);
}

// Across the leg O-U, which is the neighbour's leg O-R.
fn neighbour_y(p: Place) -> Place {
    if p.orientation == 0u && p.x == 0u {
        return Place(p.face, next_root(p.face, p.root), p.y, 0u, 0u, p.level);
    }
    if p.orientation == 1u && p.y == 0u {
        return Place(p.face, previous_root(p.face, p.root), 0u, p.x, 3u, p.level);
    }
    return Place(p.face, p.root, p.x, p.y, (p.orientation + 1u) & 3u, p.level);
}

// Across the hypotenuse: the other half of the diamond. Its face is NONE on a boundary of the mesh.
fn neighbour_h(p: Place) -> Place {
    let u = unit(p.level);
    if p.orientation == 0u && p.x + p.y + u == ONE {
        let other = twin(half_edge(p.face, p.root));
        return Place(other.x, other.y, p.y, p.x, 0u, p.level);
    }
    let origin = offset(p, u, u);
    return Place(p.face, p.root, origin.x, origin.y, (p.orientation + 2u) & 3u, p.level);
}

// The node of the parent's level across the leg that a node shares with its parent: C(n) of ARCHITECTURE section 3. If it is a leaf,
// the node is half of a pair, and may not split. Not for roots.
fn across_outer_leg(p: Place, digit: u32) -> Place {
    let parent = place_parent(p, digit);
    if digit >= 2u {
        return neighbour_x(parent);
    }
    return neighbour_y(parent);
}
