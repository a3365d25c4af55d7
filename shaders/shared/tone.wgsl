// Linear radiance to what a screen shows: the filmic curve of K. Narkowicz (ACES approximation, 2015). Applied to each sample, so that
// edges against a bright sky are smooth after the resolve. The target's sRGB format encodes.
// requires: shared/shading.wgsl

fn tone(radiance: vec3f) -> vec3f {
    let x = radiance * shading.exposure;
    return saturate((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14));
}
