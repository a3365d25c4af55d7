// Material capture: a picture of a lit sphere is the light and the material in one, looked up by the normal as the eye sees it (Sloan et
// al. 2001, "The Lit Sphere"), times the colours of the mesh's corners. Up is the world's, however the camera is rolled.
// requires: shared/shading.wgsl, draw/varying_attributes.wgsl

@group(2) @binding(2) var base_texture: texture_2d<f32>;
@group(2) @binding(3) var base_sampler: sampler;

// The part of the picture's half side that the sphere reaches: its rim is not blended with what lies outside.
const REACH: f32 = 0.49;

fn shade(v: Varying, normal: vec3f, to_eye: vec3f) -> vec3f {
    // Straight from above or below any direction is to the right.
    let across = vec3f(to_eye.z, 0.0, -to_eye.x);
    let right = select(vec3f(1.0, 0.0, 0.0), across, dot(across, across) > 1e-8);
    let x = normalize(right);
    let y = cross(to_eye, x);
    let at = vec2f(0.5) + REACH * vec2f(dot(normal, x), -dot(normal, y));
    return shading.base_colour * v.colour.rgb * textureSampleLevel(base_texture, base_sampler, at, 0.0).rgb;
}
