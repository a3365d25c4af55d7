// The picture: material, light, overlay, atmosphere, tone. Each of the first four is a file of its own, chosen by the scene.
// requires: shared/shading.wgsl, shared/tone.wgsl, shared/sky_colour.wgsl

@fragment
fn fragment(v: Varying, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    let normal = normalize(select(-v.normal, v.normal, front));
    let lit = light(material(v, normal), normal, normalize(-v.position));
    return vec4f(tone(atmosphere(overlay(lit, v), v.position)), 1.0);
}

// Lambert under a sun and a sky, with a soft highlight that keeps plain surfaces readable.
fn light(albedo: vec3f, normal: vec3f, to_eye: vec3f) -> vec3f {
    let sun = max(dot(normal, shading.sun_direction), 0.0) * shading.sun_intensity * shading.sun_colour;
    let up = normal.y * 0.5 + 0.5;
    let sky = mix(shading.ground, mix(shading.horizon, shading.zenith, up), up) * shading.ambient;
    let half_way = normalize(shading.sun_direction + to_eye);
    let highlight = pow(max(dot(normal, half_way), 0.0), 32.0) * 0.04 * shading.sun_intensity;
    return albedo * (sun + sky) + highlight * shading.sun_colour * step(0.0, dot(normal, shading.sun_direction));
}
