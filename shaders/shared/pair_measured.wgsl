// What a leaf keeps of the pair that it may be half of, behind the parents: the vertex that the pair leaves out, which is the right angle
// of the leaf, and the size of the pair. The same for the four leaves about that vertex.
// requires: pairs/about_leg.wgsl, shared/surface.wgsl

fn keep_pair(slot: u32, leaf: Place, digit: u32) {
    if digit == ROOT_DIGIT {
        return;
    }
    let side = digit & 2u; // of the even half: 0 along the Y leg, 2 along the X leg
    let size = larger_pair(place_child(place_parent(leaf, digit), side), side);
    parents[frame.pairs + slot] = vec4f(surface_point(leaf.face, FaceCoord(leaf.root, leaf.x, leaf.y)), size);
}
