// Quadratic patches whose control mesh moves, from their points (QAS). Twin: keyleaf-surface `quadratic`. The kind of points is another
// file: `POINT_SUMS`, `corner_offset` (of a vertex on the surface from that of the mesh), `fan_normal`, `edge_normal`.
// requires: passes/pose_points.wgsl

fn edge_point(edge: u32) -> u32 {
    return POINT_SUMS * (pose.edge_points + edge);
}

// Points of the surface relative to that of a vertex, from differences that keep their digits far from the origin.
fn corner_from(base: u32, vertex: u32) -> vec3f {
    return (vertex_position(vertex) - vertex_position(base)) + (corner_offset(vertex) - corner_offset(base));
}

fn middle_from(base: u32, edge: u32) -> vec3f {
    let start = start_vertex(edge_owner(edge));
    return (vertex_position(start) - vertex_position(base)) + (scratch[edge_point(edge)].xyz - corner_offset(base));
}

// The control point with which the patch passes through the middle.
fn edge_control_from(base: u32, half_edge: u32) -> vec3f {
    let ends = corner_from(base, start_vertex(half_edge)) + corner_from(base, start_vertex(next_in_face(half_edge)));
    return 2.0 * middle_from(base, edge_of(half_edge)) - 0.5 * ends;
}

// The longest derivative along h over a triangle: at one of its corners.
fn longest_derivative(net: Net, h: vec3f, root: u32) -> f32 {
    let start = polar(net, h, of_root(vec3f(1.0, 0.0, 0.0), root));
    let end = polar(net, h, of_root(vec3f(0.0, 1.0, 0.0), root));
    return 2.0 * max(max(length(start), length(end)), length(polar(net, h, CENTRE)));
}

fn keep_root_bounds(net: Net, half_edge: u32, largest: f32) {
    let root = half_edge % 3u;
    let along = of_root(vec3f(1.0, -1.0, 0.0), root);
    let median = of_root(vec3f(1.0, 1.0, -2.0) / 3.0, root);
    let size = 0.5 * max(longest_derivative(net, along, root), longest_derivative(net, median, root));
    let bends = length(polar(net, along, along)) + 2.0 * length(polar(net, along, median)) + length(polar(net, median, median));
    keep_bounds(half_edge, size, 0.25 * bends, largest);
}

fn keep_triangle(face: u32) {
    let base = start_vertex(3u * face);
    let first = vertex_position(base) + corner_offset(base);
    let at = pose.entries * face;
    surface_a[at] = vec4f(first, 0.0);
    var net: Net;
    var largest = 0.0;
    for (var root = 0u; root < 3u; root++) {
        net.corners[root] = corner_from(base, start_vertex(3u * face + root));
        net.edges[root] = edge_control_from(base, 3u * face + root);
        if root > 0u {
            surface_a[at + root] = vec4f(net.corners[root], 0.0);
        }
        surface_a[at + 3u + root] = vec4f(net.edges[root], 0.0);
        largest = max(largest, max(largest_component(net.corners[root]), largest_component(net.edges[root])));
    }
    for (var root = 0u; root < 3u; root++) {
        keep_root_bounds(net, 3u * face + root, largest + largest_component(first));
    }
    keep_mean_normal(face, net.corners[1], net.corners[2]);
}

// The control point with which the normal patch of a face passes through the normal in the middle.
fn keep_edge_normal(half_edge: u32, normal: vec3f) {
    let ends = corner_normal(half_edge) + corner_normal(next_in_face(half_edge));
    surface_a[edge_normal_at(half_edge)] = vec4f(2.0 * normal - 0.5 * ends, 0.0);
}

fn keep_edge_normals(edge: u32, own: u32, other: u32) {
    let normal = edge_normal(edge, own, other);
    keep_edge_normal(own, normal);
    if other != NONE {
        keep_edge_normal(other, normal);
    }
}
