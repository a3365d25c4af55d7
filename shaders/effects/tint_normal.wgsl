// World normals n as colours n / 2 + 1 / 2.

fn tint(colour: vec3f, v: Varying) -> vec3f {
    let encoded = normalize(v.normal) * 0.5 + 0.5;
    return encoded * encoded;
}
