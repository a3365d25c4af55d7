// Channel `normal`: the world normal, n / 2 + 1 / 2.
// requires: draw/varying.wgsl

@fragment
fn fragment(v: Varying) -> @location(0) vec4f {
    return vec4f(normalize(v.normal) * 0.5 + 0.5, 1.0);
}
