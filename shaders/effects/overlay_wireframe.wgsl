// The edges of the drawn triangles.
// requires: shared/wire.wgsl

fn overlay(colour: vec3f, v: Varying) -> vec3f {
    return mix(colour, shading.line_colour.rgb, wire(v.grid) * shading.line_colour.a);
}
