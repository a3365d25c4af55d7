// What passes from vertex to fragment for a mesh with normals, colours or texture coordinates at its corners. Attributes go linearly
// over the fan of a face; those of its centre are the mean of the corners'.
// requires: draw/vertex.wgsl, shared/topology.wgsl

struct Attribute {
    normal: vec3f, // object space; zero: the surface's own
    colour: u32,   // four bytes, linear
    uv: vec2f,
    unused: vec2f,
}

@group(2) @binding(1) var<storage, read> attributes: array<Attribute>; // of half-edges, then of the centres of faces

struct Varying {
    @builtin(position) clip: vec4f,
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) grid: vec2f,
    @location(3) @interpolate(flat, either) leaf: u32,
    @location(4) uv: vec2f,
    @location(5) colour: vec4f,
}

@vertex
fn vertex(@builtin(instance_index) instance: u32, @location(0) grid: u32) -> Varying {
    let v = leaf_vertex(instance, grid);
    let root = half_edge(v.face, v.at.root);
    let next = select(root + 1u, first_half_edge(v.face), v.at.root + 1u == corner_count(v.face));
    let here = attributes[root];
    let there = attributes[next];
    let centre = attributes[topology[1] + v.face];
    let x = fixed_to_float(v.at.x);
    let y = fixed_to_float(v.at.y);
    let z = fixed_to_float(ONE - v.at.x - v.at.y);
    let corner = centre.normal * z + here.normal * x + there.normal * y;
    var normal = v.normal;
    if dot(corner, corner) > 0.0 {
        normal = normalize((frame.normal_from_object * vec4f(corner, 0.0)).xyz);
    }
    let colour = unpack4x8unorm(centre.colour) * z + unpack4x8unorm(here.colour) * x + unpack4x8unorm(there.colour) * y;
    return Varying(v.clip, v.position, normal, v.grid, v.leaf, centre.uv * z + here.uv * x + there.uv * y, colour);
}
