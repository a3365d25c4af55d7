// What a leaf keeps of the pair that it may be half of, behind the parents: the vertex that the pair leaves out, which is the right angle
// of the leaf, and the size of the pair. The same for the four leaves about that vertex.
// requires: pairs/about_leg.wgsl, shared/surface.wgsl, shared/frame.wgsl

const ROOTS_MAY_BE_PAIRS: bool = true;

fn keep_pair(slot: u32, leaf: Place, digit: u32) {
    var size = 3e38; // never a pair
    if digit != ROOT_DIGIT {
        let side = digit & 2u; // of the even half: 0 along the Y leg, 2 along the X leg
        size = larger_pair(place_child(place_parent(leaf, digit), side), side);
    } else if corner_count(leaf.face) == 4u && frame.morph_slack == 0.0 { // the vertices of roots do not morph
        size = larger_pair(root_place(leaf.face, 0u), ROOT_DIGIT);
    }
    parents[frame.pairs + slot] = vec4f(surface_point(leaf.face, FaceCoord(leaf.root, leaf.x, leaf.y)), size);
}
