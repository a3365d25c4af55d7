// The flat test as a length: how far the surface is from an edge, at the samples of the vector deviation test.
// requires: shared/flat_samples.wgsl, shared/direction.wgsl

fn flat_size(edge: vec3f, arm: vec3f) -> f32 {
    let along = scaled_vector(edge);
    let square = dot(along, along);
    return select(length(arm), length(cross(along, arm)) / sqrt(square), square > 0.0);
}
