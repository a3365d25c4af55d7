// Pairs are drawn only where the neighbour across the leg has no vertex in its middle.

// PAIR and FREE of a leaf.
fn pair_flags(slot: u32, state: u32, t: Terms) -> u32 {
    return state & (PAIR | FREE);
}
