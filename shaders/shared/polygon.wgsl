// Points of a mesh of polygons as weighted sums of at most four entries of its point table: first its vertices, then the centres of
// its faces. Quads are bilinear; all other polygons are fans of flat triangles about their centre. Twin: keyleaf-surface `stencil`.
//
// The surface defines `fn corner_vertex(half_edge: u32) -> u32` and `fn centre_point(face: u32) -> u32`: indices of that table.
// requires: shared/place.wgsl, shared/topology.wgsl, shared/quad_coord.wgsl

struct Stencil {
    points: vec4u,
    weights: vec4f,
}

// The same for every address of one point (ARCHITECTURE section 3, "same bits"): what lies on a mesh edge is made of its two vertices
// alone, the smaller index first; on a spoke of the corner and the centre; inside a quad of its corners in order.
fn polygon_stencil(face: u32, at: FaceCoord) -> Stencil {
    let count = corner_count(face);
    let first = first_half_edge(face);
    let next = select(at.root + 1u, 0u, at.root + 1u == count);
    let z = ONE - at.x - at.y;
    if z != 0u && count == 4u {
        let points = vec4u(corner_vertex(first), corner_vertex(first + 1u), corner_vertex(first + 2u), corner_vertex(first + 3u));
        return Stencil(points, bilinear_weights(quad_coord(at)));
    }
    // Where only one of the two corners counts, it takes both places.
    let a = corner_vertex(first + select(at.root, next, at.x == 0u));
    let b = corner_vertex(first + select(next, at.root, at.y == 0u));
    let centre = centre_point(face);
    let only = select(at.y, at.x, at.y == 0u);
    let single = at.x == 0u || at.y == 0u;
    let swapped = z == 0u && b < a;
    let x = select(select(at.x, at.y, swapped), only, single);
    let y = select(select(at.y, at.x, swapped), 0u, single);
    let points = vec4u(select(a, b, swapped), select(b, a, swapped), centre, centre);
    return Stencil(points, vec4f(fixed_to_float(x), fixed_to_float(y), fixed_to_float(z), 0.0));
}

fn bilinear_weights(at: QuadCoord) -> vec4f {
    let u = parameter(at.u, at.u_is_one);
    let v = parameter(at.v, at.v_is_one);
    let u_rest = complement(at.u, at.u_is_one);
    let v_rest = complement(at.v, at.v_is_one);
    return vec4f(u_rest * v_rest, u * v_rest, u * v, u_rest * v);
}

// Value and derivatives at a point of a face, from the entries of that face alone.
struct Jet {
    face: u32,
    points: vec4u,
    corners: vec4u, // half-edges; the centre of face f counts as half-edge NONE
    value: vec4f,
    du: vec4f,      // the weights of a derivative add up to zero
    dv: vec4f,
    duv: vec4f,
}

// Parameters: quads as above; triangles with corners (0, 0), (1, 0), (0, 1); fans (root + s, v), v = 0 on the mesh edge.
fn polygon_jet(face: u32, at: FaceCoord) -> Jet {
    let count = corner_count(face);
    let first = first_half_edge(face);
    let next = select(at.root + 1u, 0u, at.root + 1u == count);
    var jet: Jet;
    jet.face = face;
    if count == 4u {
        let q = quad_coord(at);
        let u = parameter(q.u, q.u_is_one);
        let v = parameter(q.v, q.v_is_one);
        let u_rest = complement(q.u, q.u_is_one);
        let v_rest = complement(q.v, q.v_is_one);
        jet.corners = vec4u(first, first + 1u, first + 2u, first + 3u);
        jet.value = vec4f(u_rest * v_rest, u * v_rest, u * v, u_rest * v);
        jet.du = vec4f(-v_rest, v_rest, v, -v);
        jet.dv = vec4f(-u_rest, -u, u, u_rest);
        jet.duv = vec4f(1.0, -1.0, 1.0, -1.0);
    } else if count == 3u {
        var weights = vec3f(f32(ONE - at.x - at.y) * (4.656612873077393e-10 / 3.0));
        weights[at.root] += fixed_to_float(at.x);
        weights[next] += fixed_to_float(at.y);
        jet.corners = vec4u(first, first + 1u, first + 2u, first + 2u);
        jet.value = vec4f(weights, 0.0);
        jet.du = vec4f(-1.0, 1.0, 0.0, 0.0);
        jet.dv = vec4f(-1.0, 0.0, 1.0, 0.0);
    } else {
        let rim = at.x + at.y;
        let along = select(f32(at.y) / f32(rim), 0.5, rim == 0u);
        jet.corners = vec4u(first + at.root, first + next, NONE, NONE);
        jet.value = vec4f(fixed_to_float(at.x), fixed_to_float(at.y), fixed_to_float(ONE - rim), 0.0);
        jet.du = vec4f(-fixed_to_float(rim), fixed_to_float(rim), 0.0, 0.0);
        jet.dv = vec4f(along - 1.0, -along, 1.0, 0.0);
        jet.duv = vec4f(1.0, -1.0, 0.0, 0.0);
    }
    for (var i = 0u; i < 4u; i++) {
        if jet.corners[i] == NONE {
            jet.points[i] = centre_point(face);
        } else {
            jet.points[i] = corner_vertex(jet.corners[i]);
        }
    }
    return jet;
}

// The sum of four table entries with the weights of a derivative, from differences: no digits are lost far from the origin.
fn derivative(weights: vec4f, p0: vec3f, p1: vec3f, p2: vec3f, p3: vec3f) -> vec3f {
    return weights.y * (p1 - p0) + weights.z * (p2 - p0) + weights.w * (p3 - p0);
}
