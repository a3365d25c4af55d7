// Exponential haze of one colour, a little warmer towards the sun.
// requires: shared/shading.wgsl

fn atmosphere(colour: vec3f, position: vec3f) -> vec3f {
    let distance = length(position);
    let to_sun = max(dot(position, shading.sun_direction) / max(distance, 1e-20), 0.0);
    let haze = shading.fog_colour + 0.06 * pow(to_sun, 8.0) * shading.sun_colour;
    return mix(haze, colour, exp(-distance * shading.fog_density));
}
