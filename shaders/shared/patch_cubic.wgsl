// `patch_basis` for models of degrees up to 3, without loops and without arrays that are indexed at run time: a patch of a lower degree
// reads its last points again, for functions that are zero. Which functions is another file: it defines
// `fn cubic_basis(span: u32, degree: u32, f: f32, g: f32) -> CubicBasis`.
// requires: shared/patch.wgsl

// See `Basis`; zero beyond the degree.
struct CubicBasis {
    value: vec4f,
    slope: vec3f,
}

// Entries of table A with the four points of a row, or with the first points of the four rows.
fn four_entries(first: u32, step: u32, degree: u32) -> vec4u {
    return vec4u(first) + step * min(vec4u(0u, 1u, 2u, 3u), vec4u(degree));
}

// A difference to a point, weighted, and the weight.
fn arm(entry: u32, reference: vec3f, offset: vec3f) -> vec4f {
    let point = surface_a[entry];
    return vec4f(point.w * ((point.xyz - reference) - offset), point.w);
}

fn position_row(p: Patch, row: u32, value: vec4f, reference: vec3f) -> vec4f {
    let entries = four_entries(row, 1u, p.degree.x);
    return value.x * arm(entries.x, reference, vec3f(0.0)) + value.y * arm(entries.y, reference, vec3f(0.0))
        + value.z * arm(entries.z, reference, vec3f(0.0)) + value.w * arm(entries.w, reference, vec3f(0.0));
}

fn patch_position(p: Patch, at: PatchCoord, u: CubicBasis, v: CubicBasis) -> PatchPoint {
    let nearest = vec2u(at.f * vec2f(p.degree) + 0.5);
    let reference = surface_a[p.base + nearest.x + nearest.y * p.stride].xyz;
    let rows = four_entries(p.base, p.stride, p.degree.y);
    let sum = v.value.x * position_row(p, rows.x, u.value, reference) + v.value.y * position_row(p, rows.y, u.value, reference)
        + v.value.z * position_row(p, rows.z, u.value, reference) + v.value.w * position_row(p, rows.w, u.value, reference);
    return PatchPoint(reference, select(vec3f(0.0), sum.xyz / sum.w, sum.w > 0.0));
}

// A sum along a row, and its derivative.
struct TangentRow {
    value: vec4f,
    slope: vec4f,
}

fn tangent_row(p: Patch, row: u32, u: CubicBasis, position: PatchPoint) -> TangentRow {
    let entries = four_entries(row, 1u, p.degree.x);
    let a = arm(entries.x, position.reference, position.offset);
    let b = arm(entries.y, position.reference, position.offset);
    let c = arm(entries.z, position.reference, position.offset);
    let d = arm(entries.w, position.reference, position.offset);
    return TangentRow(u.value.x * a + u.value.y * b + u.value.z * c + u.value.w * d,
        u.slope.x * (b - a) + u.slope.y * (c - b) + u.slope.z * (d - c));
}

fn tangents_at(p: Patch, position: PatchPoint, u: CubicBasis, v: CubicBasis) -> Tangents {
    let rows = four_entries(p.base, p.stride, p.degree.y);
    let a = tangent_row(p, rows.x, u, position);
    let b = tangent_row(p, rows.y, u, position);
    let c = tangent_row(p, rows.z, u, position);
    let d = tangent_row(p, rows.w, u, position);
    let sum = v.value.x * a.value + v.value.y * b.value + v.value.z * c.value + v.value.w * d.value;
    let du = v.value.x * a.slope + v.value.y * b.slope + v.value.z * c.slope + v.value.w * d.slope;
    let dv = v.slope.x * (b.value - a.value) + v.slope.y * (c.value - b.value) + v.slope.z * (d.value - c.value);
    let duv = v.slope.x * (b.slope - a.slope) + v.slope.y * (c.slope - b.slope) + v.slope.z * (d.slope - c.slope);
    return tangents_of_sums(p, sum, du, dv, duv.xyz);
}

fn patch_point(p: Patch, at: PatchCoord) -> vec3f {
    let u = cubic_basis(p.spans.x, p.degree.x, at.f.x, at.g.x);
    let v = cubic_basis(p.spans.y, p.degree.y, at.f.y, at.g.y);
    let position = patch_position(p, at, u, v);
    return position.reference + position.offset;
}

fn patch_tangents(p: Patch, at: PatchCoord) -> Tangents {
    let u = cubic_basis(p.spans.x, p.degree.x, at.f.x, at.g.x);
    let v = cubic_basis(p.spans.y, p.degree.y, at.f.y, at.g.y);
    return tangents_at(p, patch_position(p, at, u, v), u, v);
}
