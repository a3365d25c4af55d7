// Light and material of what is drawn. Rust: keyleaf `shading::Shading`.

struct Shading {
    eye: vec3f,            // world
    sun_intensity: f32,
    sun_direction: vec3f,  // towards the sun, world, unit
    ambient: f32,
    sun_colour: vec3f,     // linear
    fog_density: f32,      // a world unit
    base_colour: vec3f,    // linear
    line_width: f32,       // of the wireframe, pixels
    zenith: vec3f,         // colours of the sky, linear
    lowest: f32,           // range of heights of the scene, world units
    horizon: vec3f,
    highest: f32,
    ground: vec3f,
    exposure: f32,
    line_colour: vec4f,
}

@group(2) @binding(0) var<uniform> shading: Shading;
