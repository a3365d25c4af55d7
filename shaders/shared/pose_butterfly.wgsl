// Edge middles of the modified Butterfly scheme, which keeps the vertices, and the normals of the patches through them. Twin:
// keyleaf-surface `quadratic::butterfly`.
// requires: shared/pose_quadratic.wgsl

const POINT_SUMS: u32 = 1u;

fn corner_offset(vertex: u32) -> vec3f {
    return vec3f(0.0);
}

// The tangent planes of the patches about a vertex, weighted by their angles there.
fn fan_normal(fan: Fan) -> vec3f {
    var sum = vec3f(0.0);
    for (var k = 0u; k < listed(fan.spoke_count); k++) {
        let spoke = pose_words[fan.spokes + k];
        let before = next_in_face(next_in_face(spoke));
        sum += weighted_normal(edge_control_from(fan.vertex, spoke), edge_control_from(fan.vertex, before));
    }
    return unit_or_up(sum);
}

// A control point of a patch relative to its first corner.
fn difference(face: u32, k: u32) -> vec3f {
    return select(surface_a[pose.entries * face + k].xyz, vec3f(0.0), k == 0u);
}

// Of a patch in the middle of an edge.
fn middle_normal(half_edge: u32) -> vec3f {
    let face = half_edge / 3u;
    let r = half_edge % 3u;
    let s = (r + 1u) % 3u;
    let t = (r + 2u) % 3u;
    let start = difference(face, r);
    let end = difference(face, s);
    let inner = 0.5 * (difference(face, 3u + s) + difference(face, 3u + t));
    let outer = 0.25 * (start + end + 2.0 * difference(face, 3u + r));
    return cross_direction(end - start, inner - outer);
}

fn edge_normal(edge: u32, own: u32, other: u32) -> vec3f {
    var sum = middle_normal(own);
    if other != NONE {
        sum += middle_normal(other);
    }
    return unit_or_up(sum);
}
