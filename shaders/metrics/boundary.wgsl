// The boundary region test (Concheiro 6.10) over the metric `edge`: triangles at open boundaries are smaller, so that surfaces which
// are not joined leave no visible gap. Departure: joined boundaries do not crack, whatever their levels, and need no test of "friends".
// requires: shared/surface.wgsl, shared/diamond.wgsl, shared/neighbour.wgsl, shared/frame.wgsl

fn metric_size(leaf: Place, bound: SurfaceBound) -> f32 {
    let is_open = neighbour_h(Place(leaf.face, leaf.root, 0u, 0u, 0u, 0u)).face == NONE;
    return bound.size * select(1.0, frame.metric_parameter, is_open && diamond_touches_edge(leaf));
}
