// Unit normals that are never zero and never NaN (ARCHITECTURE section 7), and bits that do not depend on a sign of zero.
// Twin: keyleaf-surface `direction`.

fn largest_component(v: vec3f) -> f32 {
    let a = abs(v);
    return max(a.x, max(a.y, a.z));
}

// v over its largest component, so that squares neither vanish nor overflow; zero stays zero.
fn scaled_vector(v: vec3f) -> vec3f {
    let m = largest_component(v);
    return select(vec3f(0.0), v / m, m > 1e-37);
}

// Below this sine the rounding of the operands decides the direction of their cross product.
const PARALLEL: f32 = 1e-6;

// The direction of a x b, or zero where there is none.
fn cross_direction(a: vec3f, b: vec3f) -> vec3f {
    let c = cross(scaled_vector(a), scaled_vector(b));
    if largest_component(c) > PARALLEL {
        return normalize(scaled_vector(c));
    }
    return vec3f(0.0);
}

// The normal of a surface with these derivatives. Where du x dv vanishes: its limit from the side that the mixed derivative
// names, then the given unit vector.
fn frame_normal(du: vec3f, dv: vec3f, duv: vec3f, fallback: vec3f) -> vec3f {
    var n = cross_direction(du, dv);
    if any(n != vec3f(0.0)) {
        return n;
    }
    n = cross_direction(duv, dv);
    if all(n == vec3f(0.0)) {
        n = cross_direction(du, duv);
    }
    if all(n == vec3f(0.0)) {
        return fallback;
    }
    return select(n, -n, dot(n, fallback) < 0.0);
}

// -0 becomes +0, in integers, where no optimiser takes the two for equal.
fn positive_zero(v: vec3f) -> vec3f {
    let bits = bitcast<vec3u>(v);
    return bitcast<vec3f>(select(bits, vec3u(0u), bits == vec3u(0x80000000u)));
}
