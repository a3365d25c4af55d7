// Clear air.

fn atmosphere(colour: vec3f, position: vec3f) -> vec3f {
    return colour;
}
