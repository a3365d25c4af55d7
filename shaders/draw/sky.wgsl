// The sky behind everything: one triangle over the picture, at infinite depth.
// requires: shared/tone.wgsl, shared/sky_colour.wgsl

struct Background {
    world_from_clip: mat4x4f, // directions: the eye at the origin
}

@group(0) @binding(0) var<uniform> background: Background;

struct SkyVarying {
    @builtin(position) clip: vec4f,
    @location(0) direction: vec3f,
}

@vertex
fn sky_vertex(@builtin(vertex_index) index: u32) -> SkyVarying {
    let corner = vec2f(f32((index << 1u) & 2u), f32(index & 2u)) * 2.0 - 1.0;
    let direction = background.world_from_clip * vec4f(corner, 0.0, 1.0);
    return SkyVarying(vec4f(corner, 0.0, 1.0), direction.xyz);
}

@fragment
fn sky_fragment(v: SkyVarying) -> @location(0) vec4f {
    let direction = normalize(v.direction);
    let disc = smoothstep(0.99985, 0.99995, dot(direction, shading.sun_direction));
    return vec4f(tone(sky_colour(direction) + disc * shading.sun_colour * 6.0), 1.0);
}
