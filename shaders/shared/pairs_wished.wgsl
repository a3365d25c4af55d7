// Pairs are drawn where they must, and where the metric is satisfied with half a level less on both sides of the leg.

// PAIR and FREE of a leaf.
fn pair_flags(slot: u32, state: u32, t: Terms) -> u32 {
    if (state & FREE) == 0u {
        return state & PAIR;
    }
    // The four leaves about the vertex have the same of it, so that they agree.
    let pair = parents[frame.pairs + slot];
    return FREE | select(0u, PAIR, pair.w * t.scale <= distance_of(pair.xyz - t.eye, t));
}
