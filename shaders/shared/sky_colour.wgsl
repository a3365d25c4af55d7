// A clear sky: zenith to horizon by height, brighter around the sun. For the background, and for the haze of distance.
// requires: shared/shading.wgsl

fn sky_colour(direction: vec3f) -> vec3f {
    let up = max(direction.y, 0.0);
    let base = mix(shading.horizon, shading.zenith, pow(up, 0.45));
    let below = mix(base, shading.ground, smoothstep(0.0, -0.25, direction.y));
    let to_sun = max(dot(direction, shading.sun_direction), 0.0);
    let glow = 0.25 * pow(to_sun, 8.0) + 0.5 * pow(to_sun, 64.0);
    return below + glow * shading.sun_colour * shading.sun_intensity * 0.12;
}
