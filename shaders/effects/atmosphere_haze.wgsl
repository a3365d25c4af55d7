// Exponential haze in the colour of the sky behind.
// requires: shared/shading.wgsl, shared/sky_colour.wgsl

fn atmosphere(colour: vec3f, position: vec3f) -> vec3f {
    let distance = length(position);
    let direction = position / max(distance, 1e-20);
    let behind = sky_colour(normalize(vec3f(direction.x, max(direction.y, 0.02), direction.z)));
    return mix(behind, colour, exp(-distance * shading.fog_density));
}
