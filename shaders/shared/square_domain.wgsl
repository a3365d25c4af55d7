// The domains of Catmull-Clark faces: a quad is one; of another face each corner has one, the quad of the first step of subdivision,
// with (0, 0) at the corner and (1, 1) at the centre. Twin: keyleaf-surface `subdivision::cell`.
// requires: shared/subdivision.wgsl, shared/quad_coord.wgsl

// Where a point is: a patch, and its parameters in it with their complements, each rounded once.
struct SquareCell {
    first: u32, // entry of table A with control point 0
    f: vec2f,
    g: vec2f,
    scale: f32, // derivatives in the domain over those in the patch
}

// The half-edge with the record of the domain, and the domain's parameters.
struct SquareDomain {
    half_edge: u32,
    at: QuadCoord,
}

// Of x and y weights the one of the nearer corner is the first: whether the point is on the side of corner `root`.
fn is_near_root(at: FaceCoord) -> bool {
    return at.x >= at.y;
}

fn square_domain(face: u32, at: FaceCoord) -> SquareDomain {
    let first = first_half_edge(face);
    let count = corner_count(face);
    if count == 4u {
        return SquareDomain(first, quad_coord(at));
    }
    // At the centre the parameters of the roots differ; there it is domain 0.
    let root = select(at.root, 0u, (at.x | at.y) == 0u);
    let is_near = is_near_root(at);
    let along = select(at.y - at.x, at.x - at.y, is_near);
    let next = select(root + 1u, 0u, root + 1u == count);
    // 1 - |x - y| and 1 - x - y, with 32 fraction bits.
    let near = 2u * (ONE - along);
    let far = 2u * (ONE - at.x - at.y);
    let is_one = vec2<bool>(along == 0u, (at.x | at.y) == 0u);
    if is_near {
        return SquareDomain(first + root, QuadCoord(near, far, is_one.x, is_one.y));
    }
    return SquareDomain(first + next, QuadCoord(far, near, is_one.y, is_one.x));
}

// ds/du, ds/dv, dt/du, dt/dv: the domain's parameters by the face's.
fn domain_rates(face: u32, at: FaceCoord) -> vec4f {
    let count = corner_count(face);
    if count == 4u {
        return vec4f(1.0, 0.0, 0.0, 1.0);
    }
    // dx/du, dx/dv, dy/du, dy/dv of a fan with (root + s, v), or of a triangle with corners (0, 0), (1, 0), (0, 1).
    let rim = fixed_to_float(at.x + at.y);
    let along = select(fixed_to_float(at.y) / rim, 0.5, at.x + at.y == 0u);
    var rates = vec4f(-rim, along - 1.0, rim, -along);
    if count == 3u {
        if at.root == 0u {
            rates = vec4f(-1.0, -2.0, 1.0, -1.0);
        } else if at.root == 1u {
            rates = vec4f(2.0, 1.0, 1.0, 2.0);
        } else {
            rates = vec4f(-1.0, 1.0, -2.0, -1.0);
        }
    }
    let minus = rates.zw - rates.xy;
    let plus = -rates.xy - rates.zw;
    if is_near_root(at) {
        return vec4f(minus, plus);
    }
    return vec4f(plus, -minus);
}

fn square_cell(face: u32, at: FaceCoord, entries: u32) -> SquareCell {
    let domain = square_domain(face, at);
    let record = half_edge_record(domain.half_edge);
    var q = domain.at;
    var node = surface_b[surface_b[record + 5u]];
    var scale = 1.0;
    for (var depth = 0u; depth < MAX_DEPTH && has_children(node); depth++) {
        let right = q.u_is_one || q.u >= 0x80000000u;
        let up = q.v_is_one || q.v >= 0x80000000u;
        node = surface_b[node + select(0u, 1u, right) + select(0u, 2u, up)];
        q.u <<= 1u;
        q.v <<= 1u;
        scale *= 2.0;
    }
    return SquareCell(surface_b[record + 6u] + entries * (node & ~PATCH),
        vec2f(parameter(q.u, q.u_is_one), parameter(q.v, q.v_is_one)),
        vec2f(complement(q.u, q.u_is_one), complement(q.v, q.v_is_one)), scale);
}
