// Channel `level`: the level of each leaf as a colour; pairs are darker.
// requires: draw/varying.wgsl, shared/level_colour.wgsl

@fragment
fn fragment(v: Varying) -> @location(0) vec4f {
    return vec4f(level_colour(v.leaf), 1.0);
}
