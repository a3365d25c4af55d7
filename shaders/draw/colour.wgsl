// The picture: material, light, overlay, atmosphere, tone. All but the light are files of their own, chosen by the scene.
// requires: shared/shading.wgsl, shared/tone.wgsl

@fragment
fn fragment(v: Varying, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    let normal = normalize(select(-v.normal, v.normal, front));
    let lit = light(material(v, normal), normal, normalize(-v.position));
    return vec4f(tone(atmosphere(overlay(lit, v), v.position)), 1.0);
}

// Lambert under a sun and a sky that is brighter above than below, with a soft highlight that keeps plain surfaces readable.
fn light(albedo: vec3f, normal: vec3f, to_eye: vec3f) -> vec3f {
    let facing = dot(normal, shading.sun_direction);
    let sky = shading.ambient * (0.65 + 0.35 * normal.y);
    let half_way = normalize(shading.sun_direction + to_eye);
    let highlight = 0.03 * pow(max(dot(normal, half_way), 0.0), 32.0) * step(0.0, facing);
    return albedo * (shading.sun_colour * max(facing, 0.0) + sky) + highlight * shading.sun_colour;
}
