// The domains of Loop faces: barycentric coordinates. Twin: keyleaf-surface `subdivision::cell`.
// requires: shared/subdivision.wgsl

// Where a point is: a patch, and its barycentric coordinates in it.
struct TriangleCell {
    first: u32, // entry of table A with control point 0
    b: vec3f,
    scale: f32, // derivatives in the face over those in the patch; negative where the patch is turned by half a turn
}

// 3 (2x - y - 2^30) >= 0 in units of 2^-31: whether the weight of a corner, x + z/3, is at least a half.
fn is_half(x: u32, y: u32) -> bool {
    return x == ONE || 2u * x >= (ONE >> 1u) + y;
}

fn third_of_whole(value: u32) -> f32 {
    return f32(value) * (4.656612873077393e-10 / 3.0);
}

fn triangle_cell(face: u32, at: FaceCoord, entries: u32) -> TriangleCell {
    let record = half_edge_record(first_half_edge(face));
    let z = ONE - at.x - at.y;
    let own = vec3<bool>(at.root == 0u, at.root == 1u, at.root == 2u);
    let next = own.zxy;
    // Weights times 3 * 2^31 modulo 2^32: exact from the first step on, when they are less than 2^32.
    var w = vec3u(z) + select(vec3u(0u), vec3u(3u * at.x), own) + select(vec3u(0u), vec3u(3u * at.y), next);
    var is_corner = (own & vec3<bool>(is_half(at.x, at.y))) | (next & vec3<bool>(is_half(at.y, at.x)));
    var half = 0xc0000000u; // half of what the weights add up to: 3 * 2^30
    var scale = 1.0;
    var node = surface_b[surface_b[record + 5u]];
    for (var depth = 0u; depth < MAX_DEPTH && has_children(node); depth++) {
        // A corner takes the child at it, the first of two where both have a half.
        let corner = select(select(select(3u, 2u, is_corner.z), 1u, is_corner.y), 0u, is_corner.x);
        if corner == 3u {
            w = vec3u(half) - w;
            scale *= -2.0;
        } else {
            w -= select(vec3u(0u), vec3u(half), vec3<bool>(corner == 0u, corner == 1u, corner == 2u));
            scale *= 2.0;
        }
        node = surface_b[node + corner];
        half >>= 1u;
        is_corner = w >= vec3u(half);
    }
    let first = surface_b[record + 6u] + entries * (node & ~PATCH);
    if abs(scale) == 1.0 {
        let b = vec3f(third_of_whole(z)) + select(vec3f(0.0), vec3f(fixed_to_float(at.x)), own)
            + select(vec3f(0.0), vec3f(fixed_to_float(at.y)), next);
        return TriangleCell(first, b, 1.0);
    }
    return TriangleCell(first, vec3f(w) * (abs(scale) * (4.656612873077393e-10 / 3.0)), scale);
}
