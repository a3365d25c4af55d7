// Pairs in red, as in the figures of Khoury's thesis: leaves drawn as one triangle because the other side has no vertex there. The rest
// is grey.
// requires: shared/tinted.wgsl

fn tint(colour: vec3f, v: Varying) -> vec3f {
    let is_pair = (v.leaf & 0x100u) != 0u;
    return tinted(colour, select(vec3f(0.62, 0.64, 0.67), vec3f(0.93, 0.06, 0.05), is_pair));
}
