// Nothing over the lit surface.

fn overlay(colour: vec3f, v: Varying) -> vec3f {
    return colour;
}
