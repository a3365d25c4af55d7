// Quartic patches of Gaussian products over Loop faces. Control point (i j k), with i + j + k = 4, has place j + k (11 - k) / 2.
// requires: shared/gaussian.wgsl, shared/triangle_domain.wgsl

const TRIANGLE_ENTRIES: u32 = FRAME_ENTRIES + 2u * 15u + 4u;

fn place_of(j: u32, k: u32) -> u32 {
    return j + k * (11u - k) / 2u;
}

fn control_at(first: u32, j: u32, k: u32) -> Dual {
    return dual_control(first, place_of(j, k), first + FRAME_ENTRIES + 30u);
}

// Powers 0 to 3.
fn powers(x: f32) -> vec4f {
    return vec4f(1.0, x, x * x, x * x * x);
}

// Sums over the cubic Bernstein polynomials of the three control points next to each.
fn triangle_jet(cell: TriangleCell) -> DualJet {
    let b = cell.b;
    let p0 = powers(b.x);
    let p1 = powers(b.y);
    let p2 = powers(b.z);
    let factorial = vec4f(1.0, 1.0, 2.0, 6.0);
    let zero = Dual(vec4f(0.0), vec4f(0.0), 0.0);
    var jet = DualJet(zero, zero, zero);
    for (var k = 0u; k < 4u; k++) {
        for (var j = 0u; j + k < 4u; j++) {
            let i = 3u - j - k;
            let weight = 6.0 / (factorial[i] * factorial[j] * factorial[k]) * (p0[i] * p1[j] * p2[k]);
            let p = control_at(cell.first, j, k);
            let q = control_at(cell.first, j + 1u, k);
            let r = control_at(cell.first, j, k + 1u);
            jet.value = plus(jet.value, plus(plus(scaled_dual(p, b.x), q, b.y), r, b.z), weight);
            jet.du = plus(jet.du, plus(q, p, -1.0), 4.0 * weight);
            jet.dv = plus(jet.dv, plus(r, p, -1.0), 4.0 * weight);
        }
    }
    return jet;
}

// The mixed derivative, which tells the side where du x dv vanishes.
fn triangle_twist(cell: TriangleCell) -> Dual {
    let b = cell.b;
    let p0 = powers(b.x);
    let p1 = powers(b.y);
    let p2 = powers(b.z);
    var sum = Dual(vec4f(0.0), vec4f(0.0), 0.0);
    for (var k = 0u; k < 3u; k++) {
        for (var j = 0u; j + k < 3u; j++) {
            let i = 2u - j - k;
            let weight = 12.0 * select(2.0, 1.0, max(i, max(j, k)) == 2u) * (p0[i] * p1[j] * p2[k]);
            let along = plus(control_at(cell.first, j + 1u, k), control_at(cell.first, j, k), -1.0);
            let beside = plus(control_at(cell.first, j + 1u, k + 1u), control_at(cell.first, j, k + 1u), -1.0);
            sum = plus(sum, plus(beside, along, -1.0), weight);
        }
    }
    return sum;
}

fn surface_point(face: u32, at: FaceCoord) -> vec3f {
    let site = site_of(face, at);
    let cell = triangle_cell(site.face, site.at, TRIANGLE_ENTRIES);
    return positive_zero(gaussian_position(cell.first, triangle_jet(cell).value));
}

// The tangent plane is that of the face itself: at a crease each side has its own.
fn surface_frame(face: u32, at: FaceCoord) -> SurfaceFrame {
    let cell = triangle_cell(face, at, TRIANGLE_ENTRIES);
    let jet = triangle_jet(cell);
    let rates = mean_rates(jet);
    let du = in_object_space(cell.first, rates.du);
    let dv = in_object_space(cell.first, rates.dv);
    var normal = cross_direction(du, dv);
    if all(normal == vec3f(0.0)) {
        let twist = mean_twist(rates, jet, triangle_twist(cell));
        normal = frame_normal(du, dv, in_object_space(cell.first, twist), mean_normal(face));
    }
    return SurfaceFrame(surface_point(face, at), cell.scale * du, cell.scale * dv, normal);
}
