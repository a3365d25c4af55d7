// The level of each leaf as a tint.
// requires: shared/level_colour.wgsl

fn overlay(colour: vec3f, v: Varying) -> vec3f {
    let grey = dot(colour, vec3f(0.2126, 0.7152, 0.0722));
    return level_colour(v.leaf) * mix(grey, 0.3, 0.25) * 1.4;
}
