// A mesh displaced along its smooth normals by gradient noise of the position on the flat mesh, summed over octaves that double in
// frequency (fBm: Musgrave, "Texturing and Modeling", ch. 16). Twin: keyleaf-surface `displaced_noise`.
// requires: shared/displaced.wgsl, shared/noise3.wgsl

struct DisplacedNoiseParams {
    vertices: u32,
    faces: u32,
    margin: f32,       // rounding error of a position, from above
    octaves: u32,
    origin_cell: vec3i, // the origin in cells of the first octave: whole cells, and the rest in 2^-32
    seed: u32,
    origin_rest: vec3u,
    frequency: f32,    // cells of the first octave a unit of length
    amplitude: f32,    // of the first octave
    gain: f32,         // of the amplitude from octave to octave
    largest: f32,      // of |h|
    typical_slope: f32, // of h a unit of length: the octaves' greatest slopes, added as squares
}

@group(1) @binding(0) var<uniform> surface: DisplacedNoiseParams;
// A half-edge: its start vertex, then the bits of RootBound position and normal, then nothing.
@group(1) @binding(3) var<storage, read> surface_b: array<vec4u>;

fn corner_vertex(half_edge: u32) -> u32 {
    return surface_b[half_edge].x;
}

fn centre_point(face: u32) -> u32 {
    return surface.vertices + face;
}

fn root_bound(half_edge: u32) -> RootBound {
    let words = surface_b[half_edge];
    return RootBound(bitcast<f32>(words.y), bitcast<f32>(words.z), 0.0, 0.0);
}

// The noise at a point relative to the origin, and its gradient a unit of length. The origin is added in integers, octave by
// octave, so that moving it does not move the noise.
fn fractal_noise(point: vec3f) -> vec4f {
    var cell = surface.origin_cell;
    var rest = surface.origin_rest;
    var frequency = surface.frequency;
    var amplitude = surface.amplitude;
    var sum = vec4f(0.0);
    for (var octave = 0u; octave < surface.octaves; octave++) {
        let at = point * frequency + vec3f(rest) * 2.3283064365386963e-10;
        let whole = floor(at);
        let n = noise3(bitcast<vec3u>(cell + vec3i(whole)), at - whole, surface.seed + octave * OCTAVE_SEED);
        sum += amplitude * vec4f(n.x, frequency * n.yzw);
        cell = (cell << vec3u(1u)) | vec3i(rest >> vec3u(31u));
        rest = rest << vec3u(1u);
        frequency *= 2.0;
        amplitude *= surface.gain;
    }
    return sum;
}

fn displacement(face: u32, at: FaceCoord, s: Stencil, base: vec3f) -> f32 {
    return fractal_noise(base).x;
}

fn displacement_jet(jet: Jet, base: vec3f, du: vec3f, dv: vec3f) -> vec3f {
    let n = fractal_noise(base);
    return vec3f(n.x, dot(n.yzw, du), dot(n.yzw, dv));
}

fn displacement_bound(leaf: Place, root: RootBound) -> DisplacementBound {
    let reach = root.position * ball_scale(leaf.level);
    var slope = NOISE3_SLOPE * abs(surface.amplitude) * surface.frequency;
    var range = 2.0 * NOISE3_LARGEST * abs(surface.amplitude);
    var variation = 0.0;
    var steepest = 0.0;
    for (var octave = 0u; octave < surface.octaves; octave++) {
        variation += min(range, slope * reach);
        steepest += slope * reach;
        slope *= 2.0 * surface.gain;
        range *= surface.gain;
    }
    // The typical slope counts as if it were at right angles to the flat mesh.
    let smooth_speed = root.position + surface.largest * root.normal;
    let speed = length(vec2f(smooth_speed, surface.typical_slope * root.position));
    return DisplacementBound(surface.largest, variation, steepest, (speed - smooth_speed) * level_scale(leaf.level), 0.0);
}
