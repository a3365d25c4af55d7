//! Bézier patches by their first control point and the differences of the others to it.

use super::bicubic;
use super::box_spline::EXPONENTS;
use super::bspline::Jet;
use super::quartic::{self, multinomial, place};
use glam::DVec3;

/// The bicubic Bernstein polynomials, u fastest.
pub fn square_basis([u, v]: [f64; 2]) -> [f64; bicubic::CONTROL_POINTS] {
    let [bu, bv] = [u, v].map(cubic);
    std::array::from_fn(|k| bu[k % 4] * bv[k / 4])
}

/// The quartic Bernstein polynomials of a triangle.
pub fn triangle_basis(at: [f64; 3]) -> [f64; quartic::CONTROL_POINTS] {
    EXPONENTS.map(|e| multinomial(e) * (0..3).map(|k| at[k].powi(e[k] as i32)).product::<f64>())
}

fn cubic(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
}

fn quadratic(t: f64) -> [f64; 3] {
    let s = 1.0 - t;
    [s * s, 2.0 * s * t, t * t]
}

/// A control point relative to the first.
fn difference(points: &[DVec3], k: usize) -> DVec3 {
    if k == 0 { DVec3::ZERO } else { points[k] }
}

/// The patch at (u, v).
pub fn evaluate_square(points: &[DVec3], at: [f64; 2]) -> Jet<DVec3> {
    let net = |i: usize, j: usize| difference(points, 4 * j + i);
    let [cu, cv] = at.map(cubic);
    let [qu, qv] = at.map(quadratic);
    let sum = |columns: &[f64], rows: &[f64], of: &dyn Fn(usize, usize) -> DVec3| -> DVec3 {
        let row = |j: usize| -> DVec3 { columns.iter().enumerate().map(|(i, b)| of(i, j) * *b).sum() };
        rows.iter().enumerate().map(|(j, b)| row(j) * *b).sum()
    };
    let along = |i: usize, j: usize| (net(i + 1, j) - net(i, j)) * 3.0;
    let up = |i: usize, j: usize| (net(i, j + 1) - net(i, j)) * 3.0;
    let both = |i: usize, j: usize| (along(i, j + 1) - along(i, j)) * 3.0;
    Jet {
        value: points[0] + sum(&cu, &cv, &net),
        du: sum(&qu, &cv, &along),
        dv: sum(&cu, &qv, &up),
        duv: sum(&qu, &qv, &both),
    }
}

/// The patch at barycentric coordinates, with derivatives in the second and the third of them.
pub fn evaluate_triangle(points: &[DVec3], at: [f64; 3]) -> Jet<DVec3> {
    let net = |e: [usize; 3]| difference(points, place(e));
    let raised = |mut e: [usize; 3], k: usize| {
        e[k] += 1;
        e
    };
    let monomials = |degree: usize| {
        let all = (0..=degree).flat_map(move |k| (0..=degree - k).map(move |j| [degree - j - k, j, k]));
        all.map(move |e| {
            let factorial = |n: usize| (1..=n).map(|x| x as f64).product::<f64>();
            let choose = factorial(degree) / e.map(factorial).into_iter().product::<f64>();
            (e, choose * (0..3).map(|k| at[k].powi(e[k] as i32)).product::<f64>())
        })
    };
    let slope = |e: [usize; 3], k: usize| (net(raised(e, k)) - net(raised(e, 0))) * 4.0;
    let mixed = |e: [usize; 3]| (slope(raised(e, 1), 2) - slope(raised(e, 0), 2)) * 3.0;
    Jet {
        value: points[0] + monomials(4).map(|(e, b)| net(e) * b).sum::<DVec3>(),
        du: monomials(3).map(|(e, b)| slope(e, 1) * b).sum(),
        dv: monomials(3).map(|(e, b)| slope(e, 2) * b).sum(),
        duv: monomials(2).map(|(e, b)| mixed(e) * b).sum(),
    }
}

/// Bounds of the lengths of derivatives over a patch, in its own parameters.
#[derive(Clone, Copy, Debug, Default)]
pub struct Slopes {
    /// Of the first ones.
    pub first: [f64; 2],
    /// Of ∂²/∂u², ∂²/∂u∂v, ∂²/∂v².
    pub second: [f64; 3],
}

/// By the control points of the derivatives. Those of a triangle are in its second and third barycentric coordinate.
pub fn slopes(points: &[DVec3]) -> Slopes {
    if points.len() == bicubic::CONTROL_POINTS {
        square_slopes(points)
    } else {
        triangle_slopes(points)
    }
}

fn square_slopes(points: &[DVec3]) -> Slopes {
    let net = |i: usize, j: usize| difference(points, 4 * j + i);
    let along = |i: usize, j: usize| net(i + 1, j) - net(i, j);
    let up = |i: usize, j: usize| net(i, j + 1) - net(i, j);
    Slopes {
        first: [3.0 * longest(3, 4, along), 3.0 * longest(4, 3, up)],
        second: [
            6.0 * longest(2, 4, |i, j| along(i + 1, j) - along(i, j)),
            9.0 * longest(3, 3, |i, j| along(i, j + 1) - along(i, j)),
            6.0 * longest(4, 2, |i, j| up(i, j + 1) - up(i, j)),
        ],
    }
}

/// The greatest length in a net of vectors.
fn longest(columns: usize, rows: usize, of: impl Fn(usize, usize) -> DVec3) -> f64 {
    let mut greatest: f64 = 0.0;
    for j in 0..rows {
        for i in 0..columns {
            greatest = greatest.max(of(i, j).length_squared());
        }
    }
    greatest.sqrt()
}

fn triangle_slopes(points: &[DVec3]) -> Slopes {
    let raised = |mut e: [usize; 3], k: usize| {
        e[k] += 1;
        e
    };
    let net = |e: [usize; 3]| difference(points, place(e));
    let slope = |e: [usize; 3], k: usize| (net(raised(e, k)) - net(raised(e, 0))) * 4.0;
    let curvature = |e: [usize; 3], k: usize, l: usize| (slope(raised(e, k), l) - slope(raised(e, 0), l)) * 3.0;
    let all = |degree: usize| (0..=degree).flat_map(move |k| (0..=degree - k).map(move |j| [degree - j - k, j, k]));
    let first = |k: usize| all(3).map(|e| slope(e, k).length_squared()).fold(0.0, f64::max).sqrt();
    let second = |k: usize, l: usize| {
        let squares = all(2).map(|e| curvature(e, k, l).length_squared());
        squares.fold(0.0, f64::max).sqrt()
    };
    Slopes {
        first: [first(1), first(2)],
        second: [second(1, 1), second(1, 2), second(2, 2)],
    }
}
