// Leaves are marked with the wish that they published: metric over threshold.
// requires: draw/vertex.wgsl

fn leaf_mark(slot: u32, place: Place, is_pair: bool, i: u32, j: u32, here: vec3f) -> u32 {
    return pack2x16float(vec2f(0.0, min(state_wish(state[slot]), 60000.0)));
}
