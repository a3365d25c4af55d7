// The edges of the base grid at a vertex.

// Edge 0 to 5 of a vertex of the grid, in cells: along the legs and along the hypotenuse, there and back.
fn grid_step(edge: u32) -> vec2i {
    let forward = select(select(vec2i(1, -1), vec2i(0, 1), edge % 3u == 1u), vec2i(1, 0), edge % 3u == 0u);
    return select(forward, -forward, edge >= 3u);
}

fn is_on_grid(at: vec2i, n: i32) -> bool {
    return at.x >= 0 && at.y >= 0 && at.x + at.y <= n;
}
