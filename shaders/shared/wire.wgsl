// Lines along the edges of the drawn triangles, of constant width in pixels, from the coordinates in the base grid.
// requires: shared/shading.wgsl

// 1 on a line, 0 away from it.
fn wire(grid: vec2f) -> f32 {
    let coordinates = vec3f(grid, diagonal_line(grid));
    let width = vec3f(fwidth(grid), max(fwidth(grid.x + grid.y), fwidth(grid.x - grid.y)));
    let away = abs(fract(coordinates + 0.5) - 0.5) / max(width, vec3f(1e-9));
    let nearest = min(away.x, min(away.y, away.z));
    // Where triangles are smaller than the lines, lines would be all there is.
    let fade = saturate(0.5 / max(width.x, max(width.y, width.z)) - 0.5);
    return (1.0 - smoothstep(shading.line_width * 0.5 - 0.5, shading.line_width * 0.5 + 0.5, nearest)) * fade;
}
