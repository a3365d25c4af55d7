// The half-edges of the control mesh, as `Topology::gpu_words` in crate keyleaf-key lays them out:
// [F, E, first half-edge of each face (F + 1), then (twin face, twin root) of each half-edge; NONE, NONE on a boundary].
// requires: shared/place.wgsl

@group(1) @binding(1) var<storage, read> topology: array<u32>;

fn face_count() -> u32 {
    return topology[0];
}

fn first_half_edge(face: u32) -> u32 {
    return topology[2u + face];
}

fn corner_count(face: u32) -> u32 {
    return topology[3u + face] - topology[2u + face];
}

fn half_edge(face: u32, root: u32) -> u32 {
    return first_half_edge(face) + root;
}

// The (face, root) on the other side of a mesh edge, or (NONE, NONE).
fn twin(half_edge: u32) -> vec2u {
    let word = 3u + topology[0] + 2u * half_edge;
    return vec2u(topology[word], topology[word + 1u]);
}
