// No tint: the lit surface as it is.

fn tint(colour: vec3f, v: Varying) -> vec3f {
    return colour;
}
