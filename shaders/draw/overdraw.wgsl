// Channel `overdraw`: how often each pixel is drawn; every triangle adds the same, and none hides another.
// requires: draw/varying.wgsl

@fragment
fn fragment(v: Varying) -> @location(0) vec4f {
    return vec4f(0.16, 0.055, 0.018, 1.0);
}
