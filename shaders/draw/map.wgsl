// All leaves as one triangle each, whether the view sees them or not, coloured by level: the map of a quadtree. The odd half of a pair
// is no triangle, as in the draw.
// requires: shared/leaf.wgsl, shared/frame.wgsl, shared/grid.wgsl, shared/surface.wgsl, shared/level_colour.wgsl

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> leaves: array<Leaf>;
@group(0) @binding(2) var<storage, read> state: array<u32>;

struct MapVarying {
    @builtin(position) clip: vec4f,
    @location(0) corner: vec3f, // weights of the corners
    @location(1) @interpolate(flat, either) leaf: u32,
}

@vertex
fn map_vertex(@builtin(instance_index) slot: u32, @builtin(vertex_index) index: u32) -> MapVarying {
    let word = state[slot];
    let is_pair = (word & PAIR) != 0u;
    let weights = vec3f(f32(index == 0u), f32(index == 1u), f32(index == 2u));
    if is_pair && (state_digit(word) & 1u) == 1u {
        return MapVarying(vec4f(0.0, 0.0, 2.0, 1.0), weights, 0u);
    }
    let place = leaf_place(leaves[slot]);
    let at = grid_coord(place, is_pair, u32(index == 1u), u32(index == 2u), 0u);
    let seen = frame.view_from_object * vec4f(surface_point(place.face, at) - frame.eye, 0.0);
    return MapVarying(frame.clip_from_view * vec4f(seen.xyz, 1.0), weights, place.level | select(0u, 0x100u, is_pair));
}

@fragment
fn map_fragment(v: MapVarying) -> @location(0) vec4f {
    let away = min(v.corner.x, min(v.corner.y, v.corner.z));
    let width = fwidth(away);
    // Where leaves are a few pixels wide, their edges would be all there is.
    let line = (1.0 - smoothstep(0.0, width, away)) * saturate(0.16 / max(width, 1e-9) - 1.0);
    return vec4f(level_colour(v.leaf) * (0.85 - 0.6 * line), 1.0);
}
