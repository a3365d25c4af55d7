// Channel `position`: world position relative to the eye, in floats; w = 1 where there is a surface.
// requires: draw/varying.wgsl

@fragment
fn fragment(v: Varying) -> @location(0) vec4f {
    return vec4f(v.position, 1.0);
}
