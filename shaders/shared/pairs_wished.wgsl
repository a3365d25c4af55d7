// Pairs are drawn where they must, and where the metric is satisfied with half a level less on both sides of the leg.

fn is_drawn_as_pair(slot: u32, state: u32, t: Terms) -> bool {
    if (state & FREE) == 0u {
        return is_blocked(state);
    }
    // The four leaves about the vertex have the same of it, so that they agree.
    let pair = parents[frame.pairs + slot];
    return pair.w * t.scale <= distance_of(pair.xyz - t.eye, t);
}
