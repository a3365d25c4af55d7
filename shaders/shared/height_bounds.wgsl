// A pyramid over the cells of a height map: (least height, greatest height, greatest slope, unused) of the interpolated surface,
// overshoot included. Level 0 holds blocks of 4 x 4 cells; a level halves the counts, rounding down, and the last block of a row
// or column takes in what is left over. Twin: keyleaf-surface `height_bounds`.

@group(1) @binding(5) var height_bounds: texture_2d<f32>;

const BLOCK_SHIFT: vec2u = vec2u(2u);

// Over all cells from `low` to `high`, from at most 2 x 2 blocks. A range within another has bounds within the other's.
fn bounds_over_cells(low: vec2u, high: vec2u) -> vec3f {
    let first = low >> BLOCK_SHIFT;
    let last = high >> BLOCK_SHIFT;
    let count = max(last.x - first.x, last.y - first.y);
    let needed = select(32u - countLeadingZeros(count - 1u), 0u, count <= 1u);
    let level = min(needed, textureNumLevels(height_bounds) - 1u);
    // Not textureDimensions(height_bounds, level): llvmpipe answers for the level of another invocation.
    let end = max(textureDimensions(height_bounds) >> vec2u(level), vec2u(1u)) - vec2u(1u);
    let a = min(first >> vec2u(level), end);
    let b = min(last >> vec2u(level), end);
    let p = textureLoad(height_bounds, a, level);
    let q = textureLoad(height_bounds, vec2u(b.x, a.y), level);
    let r = textureLoad(height_bounds, vec2u(a.x, b.y), level);
    let s = textureLoad(height_bounds, b, level);
    return vec3f(min(min(p.x, q.x), min(r.x, s.x)), max(max(p.y, q.y), max(r.y, s.y)), max(max(p.z, q.z), max(r.z, s.z)));
}

// Over the whole map.
fn bounds_of_map() -> vec3f {
    return textureLoad(height_bounds, vec2u(0u), textureNumLevels(height_bounds) - 1u).xyz;
}
