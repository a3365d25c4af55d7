// How far the drawn triangles are from the surface, in pixels: from 1/16 (blue) over 1 (yellow) to 4 (red), by the logarithm.
// requires: shared/scale_colour.wgsl, shared/tinted.wgsl

fn tint(colour: vec3f, v: Varying) -> vec3f {
    let pixels = unpack2x16float(v.leaf).y;
    return tinted(colour, scale_colour((log2(max(pixels, 1e-3)) + 4.0) / 6.0));
}
