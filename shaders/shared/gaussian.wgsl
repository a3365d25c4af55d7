// Means of Gaussian products (Komar 2020): patches are in dual space, (q^, q_) = (precision, precision times mean), in a frame of their
// own. `factors` and `solve` are another file. Twin: keyleaf-surface `gaussian`.
// requires: shared/subdivision.wgsl, shared/symmetric.wgsl

// A patch begins with the columns of the axes of its frame, and a coordinate of its centre each; then its control points, two entries
// each; then the last numbers of all of them.
const FRAME_ENTRIES: u32 = 3u;

// A point of dual space, as the table has it: q^ xx, xy, xz, yy; q^ yz, zz, q_ x, y; q_ z.
struct Dual {
    a: vec4f,
    b: vec4f,
    c: f32,
}

fn dual_control(first: u32, place: u32, last: u32) -> Dual {
    let entry = first + FRAME_ENTRIES + 2u * place;
    return Dual(surface_a[entry], surface_a[entry + 1u], surface_a[last + (place >> 2u)][place & 3u]);
}

fn scaled_dual(p: Dual, w: f32) -> Dual {
    return Dual(w * p.a, w * p.b, w * p.c);
}

fn plus(p: Dual, q: Dual, w: f32) -> Dual {
    return Dual(p.a + w * q.a, p.b + w * q.b, p.c + w * q.c);
}

fn precision_of(q: Dual) -> Symmetric {
    return Symmetric(vec3f(q.a.x, q.a.w, q.b.y), vec3f(q.b.x, q.a.z, q.a.y));
}

fn information_of(q: Dual) -> vec3f {
    return vec3f(q.b.zw, q.c);
}

// The mean in the coordinates of the patch; where there is none, its middle.
fn mean_of(f: Factors, q: Dual) -> vec3f {
    if !f.is_definite {
        return vec3f(0.0);
    }
    return solve(f, information_of(q));
}

// What the precision `f` makes of a change of q, besides that of a change of precision: q_h - q^_h m (Komar 3.12).
fn rate_of(f: Factors, mean: vec3f, rate: Dual) -> vec3f {
    if !f.is_definite {
        return vec3f(0.0);
    }
    return solve(f, information_of(rate) - times(precision_of(rate), mean));
}

// The vector of object space with these coordinates of a patch.
fn in_object_space(first: u32, v: vec3f) -> vec3f {
    return v.x * surface_a[first].xyz + v.y * surface_a[first + 1u].xyz + v.z * surface_a[first + 2u].xyz;
}

fn gaussian_position(first: u32, q: Dual) -> vec3f {
    let centre = vec3f(surface_a[first].w, surface_a[first + 1u].w, surface_a[first + 2u].w);
    return centre + in_object_space(first, mean_of(factors(precision_of(q)), q));
}

// A point with its derivatives in both parameters.
struct DualJet {
    value: Dual,
    du: Dual,
    dv: Dual,
}

// The derivatives of the mean in object space.
struct MeanRates {
    mean: vec3f, // in the coordinates of the patch, as the others
    du: vec3f,
    dv: vec3f,
    f: Factors,
}

fn mean_rates(jet: DualJet) -> MeanRates {
    let f = factors(precision_of(jet.value));
    let mean = mean_of(f, jet.value);
    return MeanRates(mean, rate_of(f, mean, jet.du), rate_of(f, mean, jet.dv), f);
}

// The mixed derivative: q^ m_uv = q_uv - q^_uv m - q^_u m_v - q^_v m_u.
fn mean_twist(m: MeanRates, jet: DualJet, duv: Dual) -> vec3f {
    if !m.f.is_definite {
        return vec3f(0.0);
    }
    let right = information_of(duv) - times(precision_of(duv), m.mean) - times(precision_of(jet.du), m.dv)
        - times(precision_of(jet.dv), m.du);
    return solve(m.f, right);
}
