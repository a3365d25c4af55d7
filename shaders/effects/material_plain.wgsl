// One colour.
// requires: shared/shading.wgsl, draw/varying.wgsl

fn material(v: Varying, normal: vec3f) -> vec3f {
    return shading.base_colour;
}
