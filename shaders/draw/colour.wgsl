// The picture: shade, tint, overlay, atmosphere, tone; all but the tone are chosen by the scene. A shade is a material under a light, or a
// matcap.
// requires: shared/shading.wgsl, shared/tone.wgsl

@fragment
fn fragment(v: Varying, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    let normal = normalize(select(-v.normal, v.normal, front));
    let shaded = shade(v, normal, normalize(-v.position));
    return vec4f(tone(atmosphere(overlay(tint(shaded, v), v), v.position)), 1.0);
}
