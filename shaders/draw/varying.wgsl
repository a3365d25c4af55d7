// What passes from vertex to fragment for a surface without attributes of its own.
// requires: draw/vertex.wgsl

struct Varying {
    @builtin(position) clip: vec4f,
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) grid: vec2f,
    @location(3) @interpolate(flat, either) leaf: u32,
}

@vertex
fn vertex(@builtin(instance_index) instance: u32, @location(0) grid: u32) -> Varying {
    let v = leaf_vertex(instance, grid);
    return Varying(v.clip, v.position, v.normal, v.grid, v.leaf);
}
