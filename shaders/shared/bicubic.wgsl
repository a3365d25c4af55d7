// Bicubic Bézier patches by their first control point and the differences of the others to it, so that small patches keep their digits.
// requires: shared/square_domain.wgsl

const BICUBIC_ENTRIES: u32 = 16u;

fn cubic(f: f32, g: f32) -> vec4f {
    return vec4f(g * g * g, 3.0 * (g * g) * f, 3.0 * g * (f * f), f * f * f);
}

fn quadratic(f: f32, g: f32) -> vec3f {
    return vec3f(g * g, 2.0 * g * f, f * f);
}

// Control points k of row `row` with the first of the patch as zero.
fn difference(first: u32, k: u32) -> vec3f {
    return select(surface_a[first + k].xyz, vec3f(0.0), k == 0u);
}

fn bicubic_point(cell: SquareCell) -> vec3f {
    let bu = cubic(cell.f.x, cell.g.x);
    let bv = cubic(cell.f.y, cell.g.y);
    var sum = vec3f(0.0);
    for (var j = 0u; j < 4u; j++) {
        let row = cell.first + 4u * j;
        let start = difference(cell.first, 4u * j);
        sum += bv[j] * (bu.x * start + bu.y * surface_a[row + 1u].xyz + bu.z * surface_a[row + 2u].xyz
            + bu.w * surface_a[row + 3u].xyz);
    }
    return surface_a[cell.first].xyz + sum;
}

// Derivatives by the parameters of the patch.
struct Tangents {
    du: vec3f,
    dv: vec3f,
    duv: vec3f,
}

fn bicubic_tangents(cell: SquareCell) -> Tangents {
    let bu = cubic(cell.f.x, cell.g.x);
    let bv = cubic(cell.f.y, cell.g.y);
    let qu = 3.0 * quadratic(cell.f.x, cell.g.x);
    let qv = 3.0 * quadratic(cell.f.y, cell.g.y);
    var t: Tangents;
    var value_before = vec3f(0.0);
    var slope_before = vec3f(0.0);
    for (var j = 0u; j < 4u; j++) {
        let row = cell.first + 4u * j;
        let a = difference(cell.first, 4u * j);
        let b = surface_a[row + 1u].xyz;
        let c = surface_a[row + 2u].xyz;
        let d = surface_a[row + 3u].xyz;
        let value = bu.x * a + bu.y * b + bu.z * c + bu.w * d;
        let slope = qu.x * (b - a) + qu.y * (c - b) + qu.z * (d - c);
        t.du += bv[j] * slope;
        if j > 0u {
            t.dv += qv[j - 1u] * (value - value_before);
            t.duv += qv[j - 1u] * (slope - slope_before);
        }
        value_before = value;
        slope_before = slope;
    }
    return t;
}
