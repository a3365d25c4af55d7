// The colours of the mesh's corners.
// requires: shared/shading.wgsl, draw/varying_attributes.wgsl

fn material(v: Varying, normal: vec3f) -> vec3f {
    return shading.base_colour * v.colour.rgb;
}
