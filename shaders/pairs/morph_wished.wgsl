// Of the vertices that only pairs leave out: drawn where the leaves on both sides of the leg do without pairs.
// requires: pairs/about_leg.wgsl

// `leaf` has its right angle in the square of the vertex, and the vertex is on a leg of the triangle of the next coarser grid.
fn size_between_pairs(leaf: Place, at: FaceCoord, size: f32) -> f32 {
    let way = vec2u(at.x - leaf.x, at.y - leaf.y);
    let along_x = way * vec2u(axis(leaf.orientation));
    let along_y = way * vec2u(axis(leaf.orientation + 1u));
    var a = along_x.x + along_x.y;
    var b = along_y.x + along_y.y;
    let u = unit(leaf.level);
    var node = leaf;
    if a > u - b { // in the other half of the square
        let origin = offset(leaf, u, u);
        node = Place(leaf.face, leaf.root, origin.x, origin.y, (leaf.orientation + 2u) & 3u, leaf.level);
        a = u - a;
        b = u - b;
    }
    let digit = select(0u, 2u, a > b);
    return min(size, larger_pair(place_child(node, digit), digit));
}
