// The local area average (Concheiro 6.8): how large the face is on the screen, divided evenly among the leaves of a level. Nested.
//
// Departure: the distance of corners is 0 for a closed face. Here each of the two curves of a root counts with its length over four
// pieces, and both sides of a mesh edge with the larger one.
// requires: shared/place.wgsl, shared/neighbour.wgsl, shared/surface.wgsl, shared/diamond.wgsl

// Twice the way from the middle of the mesh edge to the centre, and the way along the mesh edge.
fn root_extent(root: Place) -> f32 {
    let quarter = ONE / 4u;
    var along = 0.0;
    var inwards = 0.0;
    var edge = surface_point(root.face, FaceCoord(root.root, ONE, 0u));
    var middle = surface_point(root.face, FaceCoord(root.root, 2u * quarter, 2u * quarter));
    for (var i = 1u; i <= 4u; i++) {
        let next_edge = surface_point(root.face, FaceCoord(root.root, ONE - i * quarter, i * quarter));
        let part = 2u * quarter - i * (quarter / 2u);
        let next_middle = surface_point(root.face, FaceCoord(root.root, part, part));
        along += length(next_edge - edge);
        inwards += length(next_middle - middle);
        edge = next_edge;
        middle = next_middle;
    }
    return max(along, 2.0 * inwards);
}

fn metric_size(leaf: Place, bound: SurfaceBound) -> f32 {
    var root = Place(leaf.face, leaf.root, 0u, 0u, 0u, 0u);
    var size = 0.0;
    for (var half = 0u; half < 2u && root.face != NONE; half++) {
        size = max(size, root_extent(root));
        root = neighbour_h(root);
    }
    return size * level_scale(leaf.level);
}
