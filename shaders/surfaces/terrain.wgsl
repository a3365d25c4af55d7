// A procedural terrain over a fixed square: gradient noise summed over octaves (fBm: Musgrave, "Texturing and Modeling", ch. 16),
// each turned towards ridges by choice, and the detail stronger on high ground. Twin: keyleaf-surface `terrain`.
//
// Every octave has exactly twice the lattice of the one before, so that the lattice cell and the fraction within it are bits of the
// 32-bit parameter: nothing rounds before the noise, at any distance. The terrain repeats at its borders.
// requires: shared/surface.wgsl, shared/diamond.wgsl, shared/direction.wgsl, shared/map_position.wgsl, shared/noise2.wgsl

struct TerrainParams {
    map: MapPosition,
    shift: f32,          // y of height 0, relative to the origin
    first_bits: u32,     // the first octave has 2^first_bits cells along an edge, at least 2
    octaves: u32,
    seed: u32,
    amplitude: f32,      // of the first octave
    gain: f32,           // of the amplitude from octave to octave
    ridged: f32,         // 0: noise, 1: ridges
    contrast: f32,       // 0: detail is the same everywhere, 1: none in the deepest valleys
    largest: f32,        // of |height|
    steepest_slope: f32, // no slope is greater
    typical_slope: f32,  // the octaves' greatest slopes added as squares: what the metric counts
}

@group(1) @binding(0) var<uniform> surface: TerrainParams;

// Ridges are rounded where |noise| is less than this, so that the surface has a normal there too.
const RIDGE_ROUNDING: f32 = 0.05;
// 2 / (sqrt(1 + RIDGE_ROUNDING^2) - RIDGE_ROUNDING): makes the ridge of noise in [-1, 1] fill [-1, 1].
const RIDGE_SCALE: f32 = 2.1024984;

// (value, gradient) of one octave from the noise's.
fn octave_shape(n: vec3f) -> vec3f {
    let rounded = sqrt(n.x * n.x + RIDGE_ROUNDING * RIDGE_ROUNDING);
    let ridge = 1.0 - RIDGE_SCALE * (rounded - RIDGE_ROUNDING);
    let slope = 1.0 - surface.ridged - surface.ridged * RIDGE_SCALE * n.x / rounded;
    return vec3f(mix(n.x, ridge, surface.ridged), slope * n.yz);
}

// Height and its derivatives in u and v. Where u or v is one its bits are zero, which is the same point of the lattice.
fn terrain_height(at: vec2u) -> vec3f {
    var ground = vec3f(0.0); // the first two octaves, which also set the strength of the others
    var detail = vec3f(0.0);
    var strength = vec3f(0.0);
    var amplitude = surface.amplitude;
    for (var octave = 0u; octave < surface.octaves; octave++) {
        let bits = surface.first_bits + octave;
        let f = vec2f(at << vec2u(bits)) * 2.3283064365386963e-10;
        let n = noise2(at >> vec2u(32u - bits), (1u << bits) - 1u, f, surface.seed + octave * OCTAVE_SEED);
        let shape = octave_shape(n) * vec3f(1.0, vec2f(f32(1u << bits)));
        if octave < 2u {
            ground += amplitude * shape;
            strength += shape / f32(3u * octave + 3u) * 2.0;
        } else {
            detail += amplitude * shape;
        }
        amplitude *= surface.gain;
    }
    let weight = 1.0 + 0.5 * surface.contrast * (strength.x - 1.0);
    return vec3f(ground.x + weight * detail.x, ground.yz + weight * detail.yz + 0.5 * surface.contrast * detail.x * strength.yz);
}

fn surface_point(face: u32, at: FaceCoord) -> vec3f {
    let q = quad_coord(at);
    let xz = map_xz(q, surface.map);
    return positive_zero(vec3f(xz.x, terrain_height(vec2u(q.u, q.v)).x + surface.shift, xz.y));
}

fn surface_frame(face: u32, at: FaceCoord) -> SurfaceFrame {
    let q = quad_coord(at);
    return map_frame(surface_point(face, at), terrain_height(vec2u(q.u, q.v)).yz, surface.map);
}

// How far the height may be from its value at the middle of a ball of this radius.
fn terrain_variation(reach: f32) -> f32 {
    let shape_slope = NOISE2_SLOPE * mix(1.0, RIDGE_SCALE, surface.ridged);
    var amplitude = abs(surface.amplitude);
    var turn = shape_slope * reach * f32(1u << surface.first_bits) / min(surface.map.extent.x, surface.map.extent.y);
    let first_turn = turn;
    var sum = 0.0;
    var detail = 0.0;
    for (var octave = 0u; octave < surface.octaves; octave++) {
        sum += amplitude * min(turn, 2.0);
        detail += select(0.0, amplitude, octave >= 2u);
        amplitude *= surface.gain;
        turn *= 2.0;
    }
    return sum + detail * surface.contrast * min(first_turn * (2.0 / 3.0), 1.0);
}

fn surface_bound(leaf: Place) -> SurfaceBound {
    let centre = surface_point(leaf.face, diamond_centre(leaf));
    let margin = 1e-6 * max(largest_component(centre), surface.largest);
    let reach = map_reach(surface.map) * ball_scale(leaf.level);
    let vertical = terrain_variation(reach);
    let typical = sqrt(1.0 + surface.typical_slope * surface.typical_slope);
    let steepest = sqrt(1.0 + surface.steepest_slope * surface.steepest_slope);
    let size = map_reach(surface.map) * level_scale(leaf.level) * typical;
    return SurfaceBound(centre, sqrt(reach * reach + vertical * vertical) * 1.000001 + margin, size,
        2.0 * reach * steepest + guard_margin(leaf.level, margin), size, HALF_LEVEL * size);
}
