// Light and material of what is drawn. Colours are linear. Rust: keyleaf `shading::Shading`.

struct Shading {
    eye: vec3f,           // world
    exposure: f32,
    sun_direction: vec3f, // towards the sun, world, unit
    line_width: f32,      // of the wireframe, pixels
    sun_colour: vec3f,
    fog_density: f32,     // a world unit
    ambient: vec3f,       // of the whole sky
    lowest: f32,          // heights between which a terrain goes from `low` to `high`, world units
    fog_colour: vec3f,
    highest: f32,
    base_colour: vec3f,
    snow_line: f32,       // world units
    low: vec3f,
    gentle: f32,          // slopes between which a terrain goes to `steep`, tangents
    high: vec3f,
    steepest: f32,
    steep: vec3f,
    pixels_per_unit: f32, // that a world unit at distance 1 covers
    snow: vec3f,
    unused_too: f32,
    line_colour: vec4f,
}

@group(2) @binding(0) var<uniform> shading: Shading;
