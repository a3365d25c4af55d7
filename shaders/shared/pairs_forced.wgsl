// Pairs are drawn only where the neighbour across the leg has no vertex in its middle.

fn is_drawn_as_pair(slot: u32, state: u32, t: Terms) -> bool {
    return is_blocked(state);
}
