// Solves S x = b with a symmetric positive definite 3 x 3 matrix by P S P^T = L D L^T, largest pivot first. Twin: keyleaf-surface
// `gaussian::solve`.
// requires: shared/symmetric.wgsl

struct Factors {
    is_definite: bool,
    turn: u32,        // the largest entry of the diagonal; the others follow it cyclically
    is_swapped: bool, // unless the third is greater than the second
    pivots: vec3f,
    lower: vec3f,     // at (1, 0), (2, 0) and (2, 1)
}

fn turned(v: vec3f, turn: u32) -> vec3f {
    return select(select(v, v.yzx, turn == 1u), v.zxy, turn == 2u);
}

fn factors(s: Symmetric) -> Factors {
    let turn = select(select(0u, 1u, s.diagonal.y > s.diagonal.x), 2u, s.diagonal.z > max(s.diagonal.x, s.diagonal.y));
    let d = turned(s.diagonal, turn);
    let o = turned(s.opposite, turn);
    if !(d.x > LEAST_PIVOT) {
        return Factors(false, 0u, false, vec3f(1.0), vec3f(0.0));
    }
    let left = o.zy / d.x;
    let rest = d.yz - left * o.zy;
    let beside = o.x - left.x * o.y;
    let is_swapped = rest.y > rest.x;
    let l = select(left, left.yx, is_swapped);
    let r = select(rest, rest.yx, is_swapped);
    if !(r.x > LEAST_PIVOT) {
        return Factors(false, 0u, false, vec3f(1.0), vec3f(0.0));
    }
    let below = beside / r.x;
    let last = r.y - below * beside;
    return Factors(last > LEAST_PIVOT, turn, is_swapped, vec3f(d.x, r.x, last), vec3f(l, below));
}

fn solve(f: Factors, right: vec3f) -> vec3f {
    let b = turned(right, f.turn);
    let rest = select(b.yz, b.zy, f.is_swapped);
    let y1 = rest.x - f.lower.x * b.x;
    let y2 = rest.y - f.lower.y * b.x - f.lower.z * y1;
    let x2 = y2 / f.pivots.z;
    let x1 = y1 / f.pivots.y - f.lower.z * x2;
    let x0 = b.x / f.pivots.x - f.lower.x * x1 - f.lower.y * x2;
    let x = vec3f(x0, select(vec2f(x1, x2), vec2f(x2, x1), f.is_swapped));
    return in_range(turned(x, (3u - f.turn) % 3u));
}
