// The level of each leaf as a tint, and the edges of the drawn triangles.
// requires: shared/level_colour.wgsl, shared/wire.wgsl

fn overlay(colour: vec3f, v: Varying) -> vec3f {
    let grey = dot(colour, vec3f(0.2126, 0.7152, 0.0722));
    let tinted = level_colour(v.leaf) * mix(grey, 0.3, 0.25) * 1.4;
    return mix(tinted, shading.line_colour.rgb, wire(v.grid) * shading.line_colour.a);
}
