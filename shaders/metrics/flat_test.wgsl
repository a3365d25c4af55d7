// The vector deviation flat test (Concheiro 3.2.2): one minus the cosine between an edge and the way from its end to the surface.
// requires: shared/flat_samples.wgsl, shared/direction.wgsl

fn flat_size(edge: vec3f, arm: vec3f) -> f32 {
    let a = scaled_vector(edge);
    let b = scaled_vector(arm);
    let lengths = length(a) * length(b);
    // 1 - cos = sin^2 / (1 + cos), which does not cancel.
    let cosine = abs(dot(a, b)) / lengths;
    let across = cross(a, b) / lengths;
    return select(0.0, dot(across, across) / (1.0 + cosine), lengths > 0.0);
}
