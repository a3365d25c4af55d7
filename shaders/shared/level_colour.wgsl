// Twelve hues that neighbours in level tell apart; after twelve levels they come again.

fn level_colour(leaf: u32) -> vec3f {
    let level = leaf & 0xffu;
    let hue = fract(f32(level) * 0.41666667);
    let rgb = clamp(abs(fract(vec3f(hue) + vec3f(0.0, 0.6666667, 0.3333333)) * 6.0 - 3.0) - 1.0, vec3f(0.0), vec3f(1.0));
    let bright = mix(vec3f(1.0), rgb, 0.62) * select(1.0, 0.82, (level & 1u) == 1u);
    return bright * select(1.0, 0.7, (leaf & 0x100u) != 0u);
}
