// Bounds of quartic triangular patches and of the roots of Loop faces, from control points. Twin: keyleaf-surface
// `subdivision::bound`. For shared use by shaders/passes/pose.wgsl, which has `difference` and `Slopes`.

const POSED_ENTRIES: u32 = 15u;

// The derivative by the second (x) and the third (y) barycentric coordinate at control point (3 - j - k, j, k) of the cubic net.
fn along_b(first: u32, j: u32, k: u32) -> vec3f {
    return 4.0 * (difference(first, quartic_place(j + 1u, k)) - difference(first, quartic_place(j, k)));
}

fn along_c(first: u32, j: u32, k: u32) -> vec3f {
    return 4.0 * (difference(first, quartic_place(j, k + 1u)) - difference(first, quartic_place(j, k)));
}

fn quartic_place(j: u32, k: u32) -> u32 {
    return j + k * (11u - k) / 2u;
}

fn patch_slopes(first: u32) -> Slopes {
    var slopes = Slopes(vec2f(0.0), vec3f(0.0));
    for (var k = 0u; k < 4u; k++) {
        for (var j = 0u; j + k < 4u; j++) {
            let b = along_b(first, j, k);
            let c = along_c(first, j, k);
            slopes.first = max(slopes.first, vec2f(length(b), length(c)));
            if j + k < 3u {
                let bb = along_b(first, j + 1u, k) - b;
                let bc = along_c(first, j + 1u, k) - c;
                let cc = along_c(first, j, k + 1u) - c;
                slopes.second = max(slopes.second, 3.0 * vec3f(length(bb), length(bc), length(cc)));
            }
        }
    }
    return slopes;
}

fn patch_area(first: u32) -> vec3f {
    return cross(difference(first, 4u), difference(first, 14u));
}

fn speed(along: vec2f, first: vec2f) -> f32 {
    return dot(abs(along), first);
}

fn bend(a: vec2f, b: vec2f, second: vec3f) -> f32 {
    return dot(abs(vec3f(a.x * b.x, a.x * b.y + a.y * b.x, a.y * b.y)), second);
}

// Size and deviation: hypotenuses run along the mesh edge, medians to the centre, by turns.
fn root_bound(slopes: Slopes, root: u32, corners: u32) -> vec2f {
    var ends = array<vec2f, 4>(vec2f(0.0), vec2f(1.0, 0.0), vec2f(0.0, 1.0), vec2f(0.0));
    let edge = ends[root + 1u] - ends[root];
    let median = (ends[root] + ends[root + 1u]) / 2.0 - vec2f(1.0 / 3.0);
    let along = edge / 2.0;
    let size = max(speed(edge, slopes.first) / 2.0, speed(median, slopes.first));
    let second = slopes.second;
    return vec2f(size, (bend(along, along, second) + 2.0 * bend(along, median, second) + bend(median, median, second)) / 2.0);
}
