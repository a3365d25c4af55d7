// Integer hashes of lattice points: pcg2d and pcg3d of Jarzynski and Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020.
// Twin: keyleaf-surface `noise`.

// Added to the seed from octave to octave: 2^32 over the golden ratio.
const OCTAVE_SEED: u32 = 0x9e3779b9u;

fn hash2(point: vec2u, seed: u32) -> vec2u {
    var v = (point + vec2u(seed, seed ^ 0x85ebca6bu)) * 1664525u + 1013904223u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> vec2u(16u);
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    return v ^ (v >> vec2u(16u));
}

fn hash3(point: vec3u, seed: u32) -> vec3u {
    var v = (point + vec3u(seed, seed ^ 0x85ebca6bu, seed ^ 0xc2b2ae35u)) * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> vec3u(16u);
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}
