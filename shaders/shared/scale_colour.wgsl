// A colour for a number from 0 (blue) to 1 (red). Rust: keyleaf-viewer `palette::SCALE`.

fn scale_colour(t: f32) -> vec3f {
    let stops = array<vec3f, 5>(
        vec3f(0.03, 0.07, 0.42),
        vec3f(0.02, 0.36, 0.42),
        vec3f(0.16, 0.62, 0.16),
        vec3f(0.95, 0.62, 0.03),
        vec3f(0.82, 0.05, 0.05),
    );
    let at = saturate(t) * 4.0;
    let i = min(u32(at), 3u);
    return mix(stops[i], stops[i + 1u], at - f32(i));
}
