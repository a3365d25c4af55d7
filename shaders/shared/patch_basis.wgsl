// Patches as sums of control points by basis functions, which are computed for every sample. Which ones is another file: it defines
// `fn basis(span: u32, degree: u32, f: f32, g: f32) -> Basis`.
// requires: shared/patch.wgsl

// At most seven: the p + 1 functions that are not zero, and N(k, p-1) / D(k), of which p times the differences of control points make
// the derivative.
struct Basis {
    value: array<f32, 8>,
    slope: array<f32, 8>,
}

fn patch_position(p: Patch, at: PatchCoord, u: ptr<function, Basis>, v: ptr<function, Basis>) -> PatchPoint {
    let nearest = vec2u(at.f * vec2f(p.degree) + 0.5);
    let reference = surface_a[p.base + nearest.x + nearest.y * p.stride].xyz;
    var sum = vec4f(0.0);
    for (var l = 0u; l <= p.degree.y; l++) {
        var row = vec4f(0.0);
        for (var k = 0u; k <= p.degree.x; k++) {
            let point = surface_a[p.base + k + l * p.stride];
            row += ((*u).value[k] * point.w) * vec4f(point.xyz - reference, 1.0);
        }
        sum += (*v).value[l] * row;
    }
    // All weights that count are zero only at a corner whose own is.
    return PatchPoint(reference, select(vec3f(0.0), sum.xyz / sum.w, sum.w > 0.0));
}

fn tangents_at(p: Patch, position: PatchPoint, u: ptr<function, Basis>, v: ptr<function, Basis>) -> Tangents {
    var rest = vec4f(0.0);
    var du = vec4f(0.0);
    var dv = vec4f(0.0);
    var duv = vec3f(0.0);
    var value_before = vec4f(0.0);
    var slope_before = vec3f(0.0);
    for (var l = 0u; l <= p.degree.y; l++) {
        var value = vec4f(0.0);
        var slope = vec4f(0.0);
        var before = vec4f(0.0);
        for (var k = 0u; k <= p.degree.x; k++) {
            let point = surface_a[p.base + k + l * p.stride];
            let arm = vec4f(point.w * ((point.xyz - position.reference) - position.offset), point.w);
            value += (*u).value[k] * arm;
            if k > 0u {
                slope += (*u).slope[k - 1u] * (arm - before);
            }
            before = arm;
        }
        rest += (*v).value[l] * value;
        du += (*v).value[l] * slope;
        if l > 0u {
            dv += (*v).slope[l - 1u] * (value - value_before);
            duv += (*v).slope[l - 1u] * (slope.xyz - slope_before);
        }
        value_before = value;
        slope_before = slope.xyz;
    }
    return tangents_of_sums(p, rest, du, dv, duv);
}

fn patch_point(p: Patch, at: PatchCoord) -> vec3f {
    var u = basis(p.spans.x, p.degree.x, at.f.x, at.g.x);
    var v = basis(p.spans.y, p.degree.y, at.f.y, at.g.y);
    let position = patch_position(p, at, &u, &v);
    return position.reference + position.offset;
}

fn patch_tangents(p: Patch, at: PatchCoord) -> Tangents {
    var u = basis(p.spans.x, p.degree.x, at.f.x, at.g.x);
    var v = basis(p.spans.y, p.degree.y, at.f.y, at.g.y);
    return tangents_at(p, patch_position(p, at, &u, &v), &u, &v);
}
