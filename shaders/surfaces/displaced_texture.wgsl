// A mesh displaced along its smooth normals by a texture, interpolated bicubically at the corners' texture coordinates.
//
// Where the coordinates of two faces differ at their common edge (a seam), the edge takes those of its owner, the half-edge with
// the smaller index, and a vertex those of the first half-edge that starts there: no crack. Twin: keyleaf-surface `displaced_texture`.
// requires: shared/displaced.wgsl, shared/catmull_rom.wgsl, shared/height_bounds.wgsl

struct DisplacedTextureParams {
    vertices: u32,
    faces: u32,
    margin: f32,       // rounding error of a position, from above
    largest: f32,      // of |h|
    size: vec2i,       // of the texture, in texels
    scale: f32,        // h = texel * scale + offset
    offset: f32,
    repeats: u32,      // 1: the texture repeats; 0: its rim goes on for ever
    texel_margin: f32, // rounding error of a texture coordinate in texels, from above
}

@group(1) @binding(0) var<uniform> surface: DisplacedTextureParams;
// A half-edge: start vertex, bits of RootBound position, normal, texel; then bits of u, v, the owner of its start vertex, bits of
// RootBound seam. After all half-edges, a face: bits of u, v of its centre.
@group(1) @binding(3) var<storage, read> surface_b: array<vec4u>;
// Row 0 is at v = 1; texel i, j from below is at ((i + 1/2) / width, (j + 1/2) / height).
@group(1) @binding(4) var heights: texture_2d<f32>;

fn corner_vertex(half_edge: u32) -> u32 {
    return surface_b[2u * half_edge].x;
}

fn centre_point(face: u32) -> u32 {
    return surface.vertices + face;
}

fn root_bound(half_edge: u32) -> RootBound {
    let words = surface_b[2u * half_edge];
    return RootBound(bitcast<f32>(words.y), bitcast<f32>(words.z), bitcast<f32>(words.w), bitcast<f32>(surface_b[2u * half_edge + 1u].w));
}

fn texture_coordinate(face: u32, corner: u32) -> vec2f {
    let entry = select(2u * corner + 1u, 2u * topology[1] + face, corner == NONE);
    return bitcast<vec2f>(surface_b[entry].xy);
}

// The corners whose coordinates make up a point, in the order of polygon_stencil's points; NONE for the centre.
fn stencil_corners(face: u32, at: FaceCoord) -> vec4u {
    let count = corner_count(face);
    let first = first_half_edge(face);
    let next = select(at.root + 1u, 0u, at.root + 1u == count);
    if at.x + at.y != ONE {
        if count == 4u {
            return vec4u(first, first + 1u, first + 2u, first + 3u);
        }
        return vec4u(first + select(at.root, next, at.x == 0u), first + select(next, at.root, at.y == 0u), NONE, NONE);
    }
    if at.x == 0u || at.y == 0u {
        let corner = first + select(at.root, next, at.x == 0u);
        return vec4u(vec2u(surface_b[2u * corner + 1u].z), NONE, NONE);
    }
    var start = first + at.root;
    var end = first + next;
    let other = twin(start);
    if other.x != NONE && half_edge(other.x, other.y) < start {
        start = half_edge(other.x, other.y);
        end = half_edge(other.x, select(other.y + 1u, 0u, other.y + 1u == corner_count(other.x)));
    }
    let swapped = corner_vertex(end) < corner_vertex(start);
    return vec4u(select(start, end, swapped), select(end, start, swapped), NONE, NONE);
}

// Position in the texture, in texels: texel (i, j) from below is at (i, j).
fn texel_position(face: u32, corners: vec4u, weights: vec4f) -> vec2f {
    let uv = texture_coordinate(face, corners.x) * weights.x + texture_coordinate(face, corners.y) * weights.y
        + texture_coordinate(face, corners.z) * weights.z + texture_coordinate(face, corners.w) * weights.w;
    return uv * vec2f(surface.size) - 0.5;
}

fn texel(at: vec2i) -> f32 {
    let wrapped = ((at % surface.size) + surface.size) % surface.size;
    let clamped = clamp(at, vec2i(0), surface.size - 1);
    let i = select(clamped, wrapped, surface.repeats == 1u);
    return textureLoad(heights, vec2i(i.x, surface.size.y - 1 - i.y), 0).x;
}

// The texture at a position in texels, and its derivatives a texel. Samples enter as differences from the nearest.
fn sample_texture(at: vec2f) -> vec3f {
    let whole = floor(at);
    let f = at - whole;
    let cell = vec2i(whole);
    let x = catmull_rom(f.x);
    let y = catmull_rom(f.y);
    let dx = catmull_rom_slope(f.x);
    let dy = catmull_rom_slope(f.y);
    let reference = texel(cell);
    var sum = vec3f(0.0);
    for (var j = 0; j < 4; j++) {
        let row = vec4f(texel(cell + vec2i(-1, j - 1)), texel(cell + vec2i(0, j - 1)), texel(cell + vec2i(1, j - 1)),
            texel(cell + vec2i(2, j - 1))) - reference;
        sum += vec3f(y[j] * dot(x, row), y[j] * dot(dx, row), dy[j] * dot(x, row));
    }
    return vec3f(sum.x + reference, sum.yz);
}

fn displacement(face: u32, at: FaceCoord, s: Stencil, base: vec3f) -> f32 {
    return sample_texture(texel_position(face, stencil_corners(face, at), s.weights)).x * surface.scale + surface.offset;
}

fn displacement_jet(jet: Jet, base: vec3f, du: vec3f, dv: vec3f) -> vec3f {
    let face = jet.face;
    let t0 = texture_coordinate(face, jet.corners.x);
    let t1 = texture_coordinate(face, jet.corners.y) - t0;
    let t2 = texture_coordinate(face, jet.corners.z) - t0;
    let t3 = texture_coordinate(face, jet.corners.w) - t0;
    let size = vec2f(surface.size);
    let h = sample_texture(texel_position(face, jet.corners, jet.value));
    let slope = h.yz * size * surface.scale;
    return vec3f(h.x * surface.scale + surface.offset,
        dot(slope, jet.du.y * t1 + jet.du.z * t2 + jet.du.w * t3), dot(slope, jet.dv.y * t1 + jet.dv.z * t2 + jet.dv.w * t3));
}

// Bounds over a box of texel positions: the cell from texel i to i + 1 is cell i, or i + 1 where the rim goes on.
fn bounds_over_texels(low: vec2f, high: vec2f) -> vec3f {
    var first = vec2i(floor(low));
    var last = vec2i(floor(high));
    if surface.repeats == 1u {
        let wrapped = ((first % surface.size) + surface.size) % surface.size;
        last += wrapped - first;
        first = wrapped;
        if any(last >= surface.size) {
            return bounds_of_map();
        }
    } else {
        first = clamp(first + 1, vec2i(0), surface.size);
        last = clamp(last + 1, vec2i(0), surface.size);
    }
    return bounds_over_cells(vec2u(first), vec2u(last));
}

fn displacement_bound(leaf: Place, root: RootBound) -> DisplacementBound {
    let crosses = diamond_crosses_edge(leaf);
    let at = diamond_centre(leaf);
    let s = polygon_stencil(leaf.face, at);
    let middle = texel_position(leaf.face, stencil_corners(leaf.face, at), s.weights);
    let reach = root.texel * ball_scale(leaf.level);
    let box = vec2f(reach + surface.texel_margin * f32(33u - leaf.level));
    var bounds: vec3f;
    if crosses && root.seam > 0.0 {
        bounds = bounds_of_map();
    } else {
        bounds = bounds_over_texels(middle - box, middle + box);
    }
    return DisplacementBound(surface.largest, min(bounds.y - bounds.x, bounds.z * reach), bounds.z * reach,
        bounds.z * root.texel * level_scale(leaf.level), select(0.0, root.seam, diamond_touches_edge(leaf)));
}
