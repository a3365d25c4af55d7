// Points of the Loop limit surface and its tangents there: first of all vertices, then of all edges. Twin: keyleaf-surface
// `quadratic::loop_limit`. Where there are no tangents, normals are those of the triangles of the control mesh.
// requires: shared/pose_quadratic.wgsl

const POINT_SUMS: u32 = 3u;

fn corner_offset(vertex: u32) -> vec3f {
    return scratch[POINT_SUMS * vertex].xyz;
}

// The direction of the cross product of the tangents at a point, or zero.
fn tangent_normal(point: u32) -> vec3f {
    return cross_direction(scratch[point + 1u].xyz, scratch[point + 2u].xyz);
}

fn fan_normal(fan: Fan) -> vec3f {
    let normal = tangent_normal(POINT_SUMS * fan.vertex);
    if any(normal != vec3f(0.0)) {
        return normal;
    }
    return mean_normal_of_fan(fan);
}

// Of the triangle at a half-edge.
fn triangle_normal(half_edge: u32) -> vec3f {
    let next = next_in_face(half_edge);
    let p = vertex_position(start_vertex(half_edge));
    return cross_direction(vertex_position(start_vertex(next)) - p, vertex_position(start_vertex(next_in_face(next))) - p);
}

fn edge_normal(edge: u32, own: u32, other: u32) -> vec3f {
    let normal = tangent_normal(edge_point(edge));
    if any(normal != vec3f(0.0)) {
        return normal;
    }
    var sum = triangle_normal(own);
    if other != NONE {
        sum += triangle_normal(other);
    }
    return unit_or_up(sum);
}
