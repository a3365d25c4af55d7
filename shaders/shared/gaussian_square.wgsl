// Bicubic patches of Gaussian products over the domains of Catmull-Clark faces.
// requires: shared/gaussian.wgsl, shared/square_domain.wgsl

const SQUARE_ENTRIES: u32 = FRAME_ENTRIES + 2u * 16u + 4u;

fn cubic(f: f32, g: f32) -> vec4f {
    return vec4f(g * g * g, 3.0 * (g * g) * f, 3.0 * g * (f * f), f * f * f);
}

fn quadratic(f: f32, g: f32) -> vec3f {
    return vec3f(g * g, 2.0 * g * f, f * f);
}

// Row j of the control points, weighted.
fn square_row(first: u32, j: u32, w: vec4f) -> Dual {
    let e = first + FRAME_ENTRIES + 8u * j;
    let a = w.x * surface_a[e] + w.y * surface_a[e + 2u] + w.z * surface_a[e + 4u] + w.w * surface_a[e + 6u];
    let b = w.x * surface_a[e + 1u] + w.y * surface_a[e + 3u] + w.z * surface_a[e + 5u] + w.w * surface_a[e + 7u];
    return Dual(a, b, dot(w, surface_a[first + FRAME_ENTRIES + 32u + j]));
}

// Weights of control points by those of their differences, from each to the next.
fn slope_weights(w: vec3f) -> vec4f {
    return vec4f(0.0, w) - vec4f(w, 0.0);
}

fn square_sum(first: u32, wu: vec4f, wv: vec4f) -> Dual {
    var sum = Dual(vec4f(0.0), vec4f(0.0), 0.0);
    for (var j = 0u; j < 4u; j++) {
        sum = plus(sum, square_row(first, j, wu), wv[j]);
    }
    return sum;
}

// Rows are subtracted before they are weighted: derivatives of small patches keep their digits.
fn square_jet(cell: SquareCell) -> DualJet {
    let bu = cubic(cell.f.x, cell.g.x);
    let bv = cubic(cell.f.y, cell.g.y);
    let su = slope_weights(3.0 * quadratic(cell.f.x, cell.g.x));
    let qv = 3.0 * quadratic(cell.f.y, cell.g.y);
    let zero = Dual(vec4f(0.0), vec4f(0.0), 0.0);
    var jet = DualJet(zero, zero, zero);
    var before = zero;
    for (var j = 0u; j < 4u; j++) {
        let row = square_row(cell.first, j, bu);
        jet.value = plus(jet.value, row, bv[j]);
        jet.du = plus(jet.du, square_row(cell.first, j, su), bv[j]);
        if j > 0u {
            jet.dv = plus(jet.dv, plus(row, before, -1.0), qv[j - 1u]);
        }
        before = row;
    }
    return jet;
}

fn surface_point(face: u32, at: FaceCoord) -> vec3f {
    let site = site_of(face, at);
    let cell = square_cell(site.face, site.at, SQUARE_ENTRIES);
    let q = square_sum(cell.first, cubic(cell.f.x, cell.g.x), cubic(cell.f.y, cell.g.y));
    return positive_zero(gaussian_position(cell.first, q));
}

// The tangent plane is that of the face itself: at a crease each side has its own.
fn surface_frame(face: u32, at: FaceCoord) -> SurfaceFrame {
    let cell = square_cell(face, at, SQUARE_ENTRIES);
    let jet = square_jet(cell);
    let rates = mean_rates(jet);
    let du = in_object_space(cell.first, rates.du);
    let dv = in_object_space(cell.first, rates.dv);
    var normal = cross_direction(du, dv);
    if all(normal == vec3f(0.0)) {
        let wu = slope_weights(3.0 * quadratic(cell.f.x, cell.g.x));
        let wv = slope_weights(3.0 * quadratic(cell.f.y, cell.g.y));
        let twist = mean_twist(rates, jet, square_sum(cell.first, wu, wv));
        normal = frame_normal(du, dv, in_object_space(cell.first, twist), mean_normal(face));
    }
    let by_face = cell.scale * domain_rates(face, at);
    return SurfaceFrame(surface_point(face, at), by_face.x * du + by_face.z * dv, by_face.y * du + by_face.w * dv, normal);
}
