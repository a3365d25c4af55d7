// A clear sky: zenith to horizon by height, brighter around the sun.
// requires: shared/shading.wgsl

const ZENITH: vec3f = vec3f(0.13, 0.29, 0.62);
const HORIZON: vec3f = vec3f(0.60, 0.73, 0.87);
const BELOW: vec3f = vec3f(0.30, 0.31, 0.32);

fn sky_colour(direction: vec3f) -> vec3f {
    let up = max(direction.y, 0.0);
    let base = mix(HORIZON, ZENITH, pow(up, 0.45));
    let whole = mix(base, BELOW, smoothstep(0.0, -0.3, direction.y));
    let to_sun = max(dot(direction, shading.sun_direction), 0.0);
    return whole + (0.10 * pow(to_sun, 8.0) + 0.22 * pow(to_sun, 64.0)) * shading.sun_colour;
}
