// Patches as polynomials whose coefficients are made once a patch, on the CPU (Concheiro 2.2), to compare with.
//
// Departure: powers are of the distance from the middle of the patch, not from its corner, so that they are at most 2^-k, and
// coefficients are of w (P - S) with S the reference point: far less is lost to cancellation than in the thesis' form.
// requires: shared/patch.wgsl

// Powers of s = u - 1/2 and t = v - 1/2: the reference point, then coefficients of w (P - S) and of w, s fastest.
struct PowerJet {
    value: vec4f,
    ds: vec4f,
    dt: vec4f,
    dst: vec4f,
}

fn power_value(p: Patch, at: vec2f) -> vec4f {
    let first = p.spans.x + 1u;
    var value = vec4f(0.0);
    for (var l = i32(p.degree.y); l >= 0; l--) {
        let row = first + u32(l) * (p.degree.x + 1u);
        var r = surface_a[row + p.degree.x];
        for (var k = i32(p.degree.x) - 1; k >= 0; k--) {
            r = r * at.x + surface_a[row + u32(k)];
        }
        value = value * at.y + r;
    }
    return value;
}

fn power_jet(p: Patch, at: vec2f) -> PowerJet {
    let first = p.spans.x + 1u;
    var jet: PowerJet;
    for (var l = i32(p.degree.y); l >= 0; l--) {
        let row = first + u32(l) * (p.degree.x + 1u);
        var r = surface_a[row + p.degree.x];
        var dr = vec4f(0.0);
        for (var k = i32(p.degree.x) - 1; k >= 0; k--) {
            dr = dr * at.x + r;
            r = r * at.x + surface_a[row + u32(k)];
        }
        jet.dst = jet.dst * at.y + jet.ds;
        jet.dt = jet.dt * at.y + jet.value;
        jet.ds = jet.ds * at.y + dr;
        jet.value = jet.value * at.y + r;
    }
    return jet;
}

// The distance from the middle: f - 1/2 = 1/2 - g, from the smaller of both, which has lost nothing.
fn from_middle(at: PatchCoord) -> vec2f {
    return select(at.f - 0.5, 0.5 - at.g, at.f > at.g);
}

fn patch_point(p: Patch, at: PatchCoord) -> vec3f {
    let value = power_value(p, from_middle(at));
    let reference = surface_a[p.spans.x].xyz;
    return select(reference, reference + value.xyz / value.w, value.w > 0.0);
}

fn patch_tangents(p: Patch, at: PatchCoord) -> Tangents {
    let jet = power_jet(p, from_middle(at));
    let per_weight = select(0.0, 1.0 / jet.value.w, jet.value.w > 0.0);
    let position = jet.value.xyz * per_weight;
    let ds = (jet.ds.xyz - position * jet.ds.w) * per_weight;
    let dt = (jet.dt.xyz - position * jet.dt.w) * per_weight;
    let dst = (jet.dst.xyz - ds * jet.dt.w - dt * jet.ds.w - position * jet.dst.w) * per_weight;
    return Tangents(ds, dt, dst);
}
