// Quartic triangular Bézier patches by their first control point and the differences of the others to it. Control point (i j k), with
// i + j + k = 4, has place j + k (11 - k) / 2.
// requires: shared/triangle_domain.wgsl

const QUARTIC_ENTRIES: u32 = 15u;

fn place_of(j: u32, k: u32) -> u32 {
    return j + k * (11u - k) / 2u;
}

fn difference(first: u32, k: u32) -> vec3f {
    return select(surface_a[first + k].xyz, vec3f(0.0), k == 0u);
}

struct QuarticJet {
    position: vec3f,
    du: vec3f, // by the second barycentric coordinate of the patch, the first has the rest
    dv: vec3f, // by the third
}

// Sums over the cubic Bernstein polynomials of the three control points next to each.
fn quartic_jet(cell: TriangleCell) -> QuarticJet {
    let b = cell.b;
    let powers_0 = vec4f(1.0, b.x, b.x * b.x, b.x * b.x * b.x);
    let powers_1 = vec4f(1.0, b.y, b.y * b.y, b.y * b.y * b.y);
    let powers_2 = vec4f(1.0, b.z, b.z * b.z, b.z * b.z * b.z);
    let factorial = vec4f(1.0, 1.0, 2.0, 6.0);
    var jet: QuarticJet;
    for (var k = 0u; k < 4u; k++) {
        for (var j = 0u; j + k < 4u; j++) {
            let i = 3u - j - k;
            let weight = 6.0 / (factorial[i] * factorial[j] * factorial[k]) * (powers_0[i] * powers_1[j] * powers_2[k]);
            let p = difference(cell.first, place_of(j, k));
            let q = surface_a[cell.first + place_of(j + 1u, k)].xyz;
            let r = surface_a[cell.first + place_of(j, k + 1u)].xyz;
            jet.position += weight * (b.x * p + b.y * q + b.z * r);
            jet.du += weight * (q - p);
            jet.dv += weight * (r - p);
        }
    }
    jet.position += surface_a[cell.first].xyz;
    jet.du *= 4.0;
    jet.dv *= 4.0;
    return jet;
}

// The mixed derivative, which tells the side where du x dv vanishes.
fn quartic_twist(cell: TriangleCell) -> vec3f {
    let b = cell.b;
    let powers_0 = vec3f(1.0, b.x, b.x * b.x);
    let powers_1 = vec3f(1.0, b.y, b.y * b.y);
    let powers_2 = vec3f(1.0, b.z, b.z * b.z);
    var sum = vec3f(0.0);
    for (var k = 0u; k < 3u; k++) {
        for (var j = 0u; j + k < 3u; j++) {
            let i = 2u - j - k;
            let weight = select(2.0, 1.0, max(i, max(j, k)) == 2u) * (powers_0[i] * powers_1[j] * powers_2[k]);
            let p = difference(cell.first, place_of(j, k));
            let q = surface_a[cell.first + place_of(j + 1u, k)].xyz;
            let r = surface_a[cell.first + place_of(j, k + 1u)].xyz;
            let s = surface_a[cell.first + place_of(j + 1u, k + 1u)].xyz;
            sum += weight * ((s - r) - (q - p));
        }
    }
    return 12.0 * sum;
}
