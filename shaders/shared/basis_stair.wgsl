// B-spline basis functions by the stair strategy (Concheiro 6.13 to 6.16), to compare with: N(i-k, p) is the sum over the orderings of
// k steps R and p - k steps L of the product of the steps' weights.
//
// Departure: the printed formulas keep p orderings of C(p, k), which is all of them up to degree 3, once their misprints are mended,
// and too few from degree 4 on. Here all are summed; degrees to 3 are written out with their shared factors.
// requires: shared/basis_slopes.wgsl

// x(i+a) - x(i+1-b).
fn knot_distance(knots: ptr<function, Knots>, a: u32, b: u32) -> f32 {
    return (*knots).right[a] + (*knots).left[b];
}

fn path_product(knots: ptr<function, Knots>, path: u32, degree: u32) -> f32 {
    var product = 1.0;
    for (var step = 0u; step < degree; step++) {
        let r = countOneBits(path & ((1u << step) - 1u)); // steps R before this one
        let l = step - r;
        let is_r = ((path >> step) & 1u) == 1u;
        product *= select((*knots).left[r + 1u], (*knots).right[l + 1u], is_r) / knot_distance(knots, l + 1u, r + 1u);
    }
    return product;
}

fn basis_values(knots: ptr<function, Knots>, degree: u32) -> array<f32, 8> {
    var n: array<f32, 8>;
    let f = (*knots).left[1];
    let g = (*knots).right[1];
    if degree == 0u {
        n[0] = 1.0;
    } else if degree == 1u {
        n[0] = g;
        n[1] = f;
    } else if degree <= 3u {
        let f2 = (*knots).left[2];
        let g2 = (*knots).right[2];
        let low = g / knot_distance(knots, 1u, 2u);  // after R
        let high = f / knot_distance(knots, 2u, 1u); // after L
        if degree == 2u {
            n[0] = g * low;
            n[1] = low * f2 + high * g2;
            n[2] = f * high;
        } else {
            let middle = (low * f2 + high * g2) / knot_distance(knots, 2u, 2u); // after RL and LR
            let lowest = g * low / knot_distance(knots, 1u, 3u);
            let highest = f * high / knot_distance(knots, 3u, 1u);
            n[0] = g * lowest;
            n[1] = middle * g2 + lowest * (*knots).left[3];
            n[2] = middle * f2 + highest * (*knots).right[3];
            n[3] = f * highest;
        }
    } else {
        for (var k = 0u; k <= degree; k++) {
            // Bit j of a path: step j is an R. Function k has degree - k of them.
            var sum = 0.0;
            for (var path = 0u; path < (1u << degree); path++) {
                if countOneBits(path) == degree - k {
                    sum += path_product(knots, path, degree);
                }
            }
            n[k] = sum;
        }
    }
    return n;
}
