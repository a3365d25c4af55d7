// A height map over a rectangle: one quad face. The file with `height_value` and `height_gradient` is the interpolation.
// Twin: keyleaf-surface `height_field`.
// requires: shared/surface.wgsl, shared/diamond.wgsl, shared/direction.wgsl, shared/map_position.wgsl, shared/height_bounds.wgsl

struct HeightFieldParams {
    map: MapPosition,
    cells: vec2u,  // samples - 1
    scale: f32,    // y = sample * scale + shift
    shift: f32,    // relative to the origin
}

@group(1) @binding(0) var<uniform> surface: HeightFieldParams;

// The integer part and the fraction (2^-32) of value * cells * 2^-32: exact, in 16-bit halves. cells < 2^13.
fn split_cell(value: u32, cells: u32) -> vec2u {
    let low = (value & 0xffffu) * cells;
    let high = (value >> 16u) * cells + (low >> 16u);
    return vec2u(high >> 16u, (high << 16u) | (low & 0xffffu));
}

struct HeightCell {
    cell: vec2u,
    f: vec2f,
}

fn height_cell(at: QuadCoord) -> HeightCell {
    let x = split_cell(at.u, surface.cells.x);
    let y = split_cell(at.v, surface.cells.y);
    let is_one = vec2<bool>(at.u_is_one, at.v_is_one);
    let f = vec2f(fraction_to_float(x.y), fraction_to_float(y.y));
    return HeightCell(select(vec2u(x.x, y.x), surface.cells - 1u, is_one), select(f, vec2f(1.0), is_one));
}

fn surface_point(face: u32, at: FaceCoord) -> vec3f {
    let q = quad_coord(at);
    let c = height_cell(q);
    let xz = map_xz(q, surface.map);
    return positive_zero(vec3f(xz.x, height_value(c.cell, c.f, surface.cells) * surface.scale + surface.shift, xz.y));
}

fn surface_frame(face: u32, at: FaceCoord) -> SurfaceFrame {
    let c = height_cell(quad_coord(at));
    let slope = height_gradient(c.cell, c.f, surface.cells) * vec2f(surface.cells) * surface.scale;
    return map_frame(surface_point(face, at), slope, surface.map);
}

fn surface_bound(leaf: Place) -> SurfaceBound {
    let at = diamond_centre(leaf);
    let q = quad_coord(at);
    // The diamond is a square about its centre whose diagonals, 2^-level long, are parallel to the axes of u and v.
    let half = unit(min(leaf.level, MAX_LEVEL - 1u));
    let middle = vec2u(q.u, q.v);
    let is_one = vec2<bool>(q.u_is_one, q.v_is_one);
    let low = select(select(middle - half, vec2u(0u), middle < vec2u(half)), vec2u(0u - half), is_one);
    let high = select(middle + (half - 1u), vec2u(NONE), is_one | (middle > vec2u(NONE - half)));
    let bounds = bounds_over_cells(vec2u(split_cell(low.x, surface.cells.x).x, split_cell(low.y, surface.cells.y).x),
        vec2u(split_cell(high.x, surface.cells.x).x, split_cell(high.y, surface.cells.y).x));

    let centre = surface_point(leaf.face, at);
    let margin = 1e-6 * max(largest_component(centre), max(abs(bounds.x), abs(bounds.y)));
    let steepness = sqrt(1.0 + bounds.z * bounds.z);
    let reach = map_reach(surface.map) * ball_scale(leaf.level);
    let height = centre.y - surface.shift;
    let vertical = min(max(bounds.y - height, height - bounds.x), bounds.z * reach);
    let size = map_reach(surface.map) * level_scale(leaf.level) * steepness;
    return SurfaceBound(centre, sqrt(reach * reach + vertical * vertical) * 1.000001 + margin, size,
        2.0 * reach * steepness + guard_margin(leaf.level, margin), size, HALF_LEVEL * size);
}
