// The level of each leaf as a tint.
// requires: shared/level_colour.wgsl, shared/tinted.wgsl

fn tint(colour: vec3f, v: Varying) -> vec3f {
    return tinted(colour, level_colour(v.leaf));
}
