// How far the vertices have come from the edges that they divide (blue) to the surface (red).
// requires: shared/scale_colour.wgsl, shared/tinted.wgsl

fn tint(colour: vec3f, v: Varying) -> vec3f {
    return tinted(colour, scale_colour(unpack2x16float(v.leaf).y));
}
