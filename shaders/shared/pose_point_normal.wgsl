// PN triangles whose control mesh moves. Twin: keyleaf-surface `quadratic::point_normal`. Normals that are given at corners are in table A
// already: no fan lists their half-edges.
// requires: passes/pose_triangles.wgsl

fn fan_normal(fan: Fan) -> vec3f {
    return mean_normal_of_fan(fan);
}

// From one end of an edge to its control point near it: a third of the edge, projected into the tangent plane.
fn tangent(edge: vec3f, normal: vec3f) -> vec3f {
    return (edge - dot(edge, normal) * normal) / 3.0;
}

// From the start of a half-edge to the control point near it, and the same at its end: the mean of what both sides say.
struct EdgeTangents {
    start: vec3f,
    end: vec3f,
}

fn edge_tangents(half_edge: u32) -> EdgeTangents {
    let next = next_in_face(half_edge);
    let other = other_side(half_edge);
    let edge = vertex_position(start_vertex(next)) - vertex_position(start_vertex(half_edge));
    let start = tangent(edge, corner_normal(half_edge));
    let end = tangent(-edge, corner_normal(next));
    if other == NONE {
        return EdgeTangents(start, end);
    }
    let other_start = tangent(edge, corner_normal(next_in_face(other)));
    let other_end = tangent(-edge, corner_normal(other));
    return EdgeTangents(0.5 * (start + other_start), 0.5 * (end + other_end));
}

// Relative to corner 0.
struct CubicNet {
    corners: array<vec3f, 3>,
    near: array<vec3f, 3>, // of edge r, at its start
    far: array<vec3f, 3>,
    centre: vec3f,
}

fn cubic_net(face: u32) -> CubicNet {
    var net: CubicNet;
    let base = vertex_position(start_vertex(3u * face));
    var mean_edge = vec3f(0.0);
    for (var r = 0u; r < 3u; r++) {
        net.corners[r] = vertex_position(start_vertex(3u * face + r)) - base;
    }
    for (var r = 0u; r < 3u; r++) {
        let tangents = edge_tangents(3u * face + r);
        net.near[r] = net.corners[r] + tangents.start;
        net.far[r] = net.corners[(r + 1u) % 3u] + tangents.end;
        mean_edge += (net.near[r] + net.far[r]) / 6.0;
    }
    let mean_corner = (net.corners[1] + net.corners[2]) / 3.0;
    net.centre = mean_edge + 0.5 * (mean_edge - mean_corner);
    return net;
}

// The polar form with one argument set.
fn reduced(net: CubicNet, a: vec3f) -> Net {
    return Net(
        array<vec3f, 3>(
            a.x * net.corners[0] + a.y * net.near[0] + a.z * net.far[2],
            a.y * net.corners[1] + a.z * net.near[1] + a.x * net.far[0],
            a.z * net.corners[2] + a.x * net.near[2] + a.y * net.far[1],
        ),
        array<vec3f, 3>(
            a.x * net.near[0] + a.y * net.far[0] + a.z * net.centre,
            a.y * net.near[1] + a.z * net.far[1] + a.x * net.centre,
            a.z * net.near[2] + a.x * net.far[2] + a.y * net.centre,
        ),
    );
}

// The longest control point of the derivative along h over a root.
fn longest_derivative(net: CubicNet, h: vec3f, root: u32) -> f32 {
    let slope = reduced(net, h);
    let start = of_root(vec3f(1.0, 0.0, 0.0), root);
    let end = of_root(vec3f(0.0, 1.0, 0.0), root);
    let corners = max(max(length(polar(slope, start, start)), length(polar(slope, end, end))), length(polar(slope, CENTRE, CENTRE)));
    let edges = max(max(length(polar(slope, start, end)), length(polar(slope, end, CENTRE))), length(polar(slope, CENTRE, start)));
    return 3.0 * max(corners, edges);
}

fn keep_root_bounds(net: CubicNet, half_edge: u32, largest: f32) {
    let root = half_edge % 3u;
    let along = of_root(vec3f(1.0, -1.0, 0.0), root);
    let median = of_root(vec3f(1.0, 1.0, -2.0) / 3.0, root);
    let size = 0.5 * max(longest_derivative(net, along, root), longest_derivative(net, median, root));
    // Second derivatives are linear: the longest is at a corner of the root.
    let start = reduced(net, of_root(vec3f(1.0, 0.0, 0.0), root));
    let end = reduced(net, of_root(vec3f(0.0, 1.0, 0.0), root));
    let centre = reduced(net, CENTRE);
    let bends = longest_bend(start, end, centre, along, along) + 2.0 * longest_bend(start, end, centre, along, median)
        + longest_bend(start, end, centre, median, median);
    keep_bounds(half_edge, size, 0.75 * bends, largest);
}

fn longest_bend(start: Net, end: Net, centre: Net, h: vec3f, k: vec3f) -> f32 {
    return max(max(length(polar(start, h, k)), length(polar(end, h, k))), length(polar(centre, h, k)));
}

fn keep_triangle(face: u32) {
    let net = cubic_net(face);
    let base = vertex_position(start_vertex(3u * face));
    let at = pose.entries * face;
    surface_a[at] = vec4f(base, 0.0);
    surface_a[at + 1u] = vec4f(net.corners[1], 0.0);
    surface_a[at + 2u] = vec4f(net.corners[2], 0.0);
    surface_a[at + 3u] = vec4f(net.near[0], 0.0);
    surface_a[at + 4u] = vec4f(net.far[0], 0.0);
    surface_a[at + 5u] = vec4f(net.near[1], 0.0);
    surface_a[at + 6u] = vec4f(net.far[1], 0.0);
    surface_a[at + 7u] = vec4f(net.near[2], 0.0);
    surface_a[at + 8u] = vec4f(net.far[2], 0.0);
    surface_a[at + 9u] = vec4f(net.centre, 0.0);
    var largest = largest_component(net.centre);
    for (var k = 1u; k < 9u; k++) {
        largest = max(largest, largest_component(surface_a[at + k].xyz));
    }
    for (var root = 0u; root < 3u; root++) {
        keep_root_bounds(net, 3u * face + root, largest + largest_component(base));
    }
    keep_mean_normal(face, net.corners[1], net.corners[2]);
}

// The mean of the normals at both ends, mirrored in the plane that halves the edge (Vlachos et al. 3.3): of every side its own.
fn mirrored_normal(half_edge: u32) -> vec3f {
    let next = next_in_face(half_edge);
    let sum = corner_normal(half_edge) + corner_normal(next);
    let chord = scaled_vector(vertex_position(start_vertex(next)) - vertex_position(start_vertex(half_edge)));
    let mirrored = sum - (2.0 * dot(chord, sum) / max(dot(chord, chord), 1e-30)) * chord;
    let scaled = scaled_vector(mirrored);
    return select(vec3f(0.0), normalize(scaled), any(scaled != vec3f(0.0)));
}

fn keep_edge_normals(edge: u32, own: u32, other: u32) {
    surface_a[edge_normal_at(own)] = vec4f(mirrored_normal(own), 0.0);
    if other != NONE {
        surface_a[edge_normal_at(other)] = vec4f(mirrored_normal(other), 0.0);
    }
}
