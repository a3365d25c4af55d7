// A material under the sun and the sky. The material is another file.
// requires: shared/shading.wgsl

fn shade(v: Varying, normal: vec3f, to_eye: vec3f) -> vec3f {
    return light(material(v, normal), normal, to_eye);
}

// Lambert under a sun and a sky that is brighter above than below, with a soft highlight that keeps plain surfaces readable.
fn light(albedo: vec3f, normal: vec3f, to_eye: vec3f) -> vec3f {
    let facing = dot(normal, shading.sun_direction);
    let sky = shading.ambient * (0.65 + 0.35 * normal.y);
    let half_way = normalize(shading.sun_direction + to_eye);
    let highlight = 0.03 * pow(max(dot(normal, half_way), 0.0), 32.0) * step(0.0, facing);
    return albedo * (shading.sun_colour * max(facing, 0.0) + sky) + highlight * shading.sun_colour;
}
