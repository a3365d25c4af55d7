// Where the vertices of the base grid of a drawn leaf lie. A pair is drawn as one triangle by its even half (Khoury 2.3.2): its right
// angle is at the middle M of the parent's hypotenuse, and in the even child's own axes M = O + A, with legs B - A and -A - B. Of two
// roots, what is beyond the spoke is in the root before the even one; their face has four corners, and M is one of them.
// requires: shared/place.wgsl

// Vertex (i, j), i + j <= 2^k, of the grid of 4^k triangles; `step` is the leaf's unit >> k.
fn grid_coord(leaf: Place, is_pair: bool, i: u32, j: u32, k: u32) -> FaceCoord {
    let u = unit(leaf.level);
    let step = u >> k;
    var a = i * step;
    var b = j * step;
    if is_pair {
        a = u - (i + j) * step;
        b = (i - j) * step;
        if leaf.level == 0u && i < j {
            return FaceCoord((leaf.root - 1u) & 3u, 0u - b, a);
        }
    }
    let at = offset(leaf, a, b);
    return FaceCoord(leaf.root, at.x, at.y);
}
