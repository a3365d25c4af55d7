// The edges of the base grid at a vertex.

// Edge 0 to 5, in cells: along the legs and along a diagonal, there and back; zero where there is none.
fn grid_step(at: vec2u, edge: u32, k: u32) -> vec2i {
    let forward = select(select(diagonal_step(at, k), vec2i(0, 1), edge % 3u == 1u), vec2i(1, 0), edge % 3u == 0u);
    return select(forward, -forward, edge >= 3u);
}

fn is_on_grid(at: vec2i, n: i32) -> bool {
    return at.x >= 0 && at.y >= 0 && at.x + at.y <= n;
}
