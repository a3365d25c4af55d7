// Samples of a height map interpolated by bicubic Catmull-Rom splines, continued linearly beyond the rim. 16 loads.
// Twin: keyleaf-surface `interpolation`.
// requires: shared/catmull_rom.wgsl

// Row 0 is the last row from below.
@group(1) @binding(4) var heights: texture_2d<f32>;

// Weights for samples outside 0..=cells go to the two samples that the linear continuation is made of.
fn fold_weights(w: vec4f, cell: u32, cells: u32) -> vec4f {
    var folded = w;
    if cell == 0u {
        folded.y += 2.0 * folded.x;
        folded.z -= folded.x;
        folded.x = 0.0;
    }
    if cell + 1u == cells {
        folded.z += 2.0 * folded.w;
        folded.y -= folded.w;
        folded.w = 0.0;
    }
    return folded;
}

fn height_row(cell: vec2u, cells: vec2u, row: i32, reference: f32) -> vec4f {
    let j = cells.y - u32(clamp(i32(cell.y) + row, 0, i32(cells.y)));
    let left = max(cell.x, 1u) - 1u;
    let right = min(cell.x + 2u, cells.x);
    return vec4f(textureLoad(heights, vec2u(left, j), 0).x, textureLoad(heights, vec2u(cell.x, j), 0).x,
        textureLoad(heights, vec2u(cell.x + 1u, j), 0).x, textureLoad(heights, vec2u(right, j), 0).x) - reference;
}

// The height in a cell, 0 <= f <= 1. Samples enter as differences from the nearest, so that a plane stays one.
fn height_value(cell: vec2u, f: vec2f, cells: vec2u) -> f32 {
    let x = fold_weights(catmull_rom(f.x), cell.x, cells.x);
    let y = fold_weights(catmull_rom(f.y), cell.y, cells.y);
    let reference = textureLoad(heights, vec2u(cell.x, cells.y - cell.y), 0).x;
    return reference + (y.x * dot(x, height_row(cell, cells, -1, reference)) + y.y * dot(x, height_row(cell, cells, 0, reference))
        + y.z * dot(x, height_row(cell, cells, 1, reference)) + y.w * dot(x, height_row(cell, cells, 2, reference)));
}

// The derivatives of the height, a cell.
fn height_gradient(cell: vec2u, f: vec2f, cells: vec2u) -> vec2f {
    let x = fold_weights(catmull_rom(f.x), cell.x, cells.x);
    let y = fold_weights(catmull_rom(f.y), cell.y, cells.y);
    let dx = fold_weights(catmull_rom_slope(f.x), cell.x, cells.x);
    let dy = fold_weights(catmull_rom_slope(f.y), cell.y, cells.y);
    let reference = textureLoad(heights, vec2u(cell.x, cells.y - cell.y), 0).x;
    var sum = vec2f(0.0);
    for (var j = 0; j < 4; j++) {
        let row = height_row(cell, cells, j - 1, reference);
        sum += vec2f(y[j] * dot(dx, row), dy[j] * dot(x, row));
    }
    return sum;
}
