// How near each leaf is to its next change, by the published wish (metric over threshold): blue may merge, red splits.
// requires: shared/scale_colour.wgsl, shared/tinted.wgsl

fn tint(colour: vec3f, v: Varying) -> vec3f {
    let wish = unpack2x16float(v.leaf).y;
    return tinted(colour, scale_colour((log2(max(wish, 1e-3)) + 2.0) / 3.0));
}
