// Channel `error`: how far the drawn triangles are from the surface, in pixels.
// requires: draw/varying.wgsl, draw/mark_error.wgsl

@fragment
fn fragment(v: Varying) -> @location(0) vec4f {
    return vec4f(unpack2x16float(v.leaf).y, 0.0, 0.0, 1.0);
}
