// A base-colour texture, times the colours of the mesh's corners.
// requires: shared/shading.wgsl, draw/varying_attributes.wgsl

@group(2) @binding(2) var base_texture: texture_2d<f32>;
@group(2) @binding(3) var base_sampler: sampler;

fn material(v: Varying, normal: vec3f) -> vec3f {
    return shading.base_colour * v.colour.rgb * textureSample(base_texture, base_sampler, v.uv).rgb;
}
