// Samples of a height map interpolated linearly along both axes: continuous, with creases between cells. 4 loads.
// Twin: keyleaf-surface `interpolation`.

// Row 0 is the last row from below.
@group(1) @binding(4) var heights: texture_2d<f32>;

// Heights at the corners of a cell: the lower left one, then the differences (lower right, upper left, twist).
fn cell_differences(cell: vec2u, cells: vec2u) -> vec4f {
    let j = cells.y - cell.y;
    let h00 = textureLoad(heights, vec2u(cell.x, j), 0).x;
    let h10 = textureLoad(heights, vec2u(cell.x + 1u, j), 0).x - h00;
    let h01 = textureLoad(heights, vec2u(cell.x, j - 1u), 0).x - h00;
    let h11 = textureLoad(heights, vec2u(cell.x + 1u, j - 1u), 0).x - h00;
    return vec4f(h00, h10, h01, h11 - h10 - h01);
}

// The height in a cell, 0 <= f <= 1.
fn height_value(cell: vec2u, f: vec2f, cells: vec2u) -> f32 {
    let h = cell_differences(cell, cells);
    return h.x + (f.x * h.y + f.y * (h.z + f.x * h.w));
}

// The derivatives of the height, a cell.
fn height_gradient(cell: vec2u, f: vec2f, cells: vec2u) -> vec2f {
    let h = cell_differences(cell, cells);
    return vec2f(h.y + f.y * h.w, h.z + f.x * h.w);
}
