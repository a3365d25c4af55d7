//! Cells of a Loop surface whose control net is a quartic box spline (Stam 1998, *Evaluation of Loop subdivision surfaces*).
//!
//! Boundaries, creases and corners become end conditions: points reflected in the edge, a + b − c.

use super::bspline::Jet;
use super::ring::Ring;
use super::sector::{Sector, SectorKind};
use super::stencil::{Stencil, Vector};

/// Control points of a cell: the corners; then of every corner, the three neighbours that no later corner has, counter-clockwise: the
/// first is across the edge that ends at the corner.
pub const CONTROL_POINTS: usize = 12;

/// Exponents of the barycentric coordinates in the fifteen monomials of degree 4, in the order of the control points of a quartic
/// Bézier triangle.
pub const EXPONENTS: [[usize; 3]; 15] = {
    let mut exponents = [[0; 3]; 15];
    let (mut place, mut k) = (0, 0);
    while k <= 4 {
        let mut j = 0;
        while j + k <= 4 {
            exponents[place] = [4 - j - k, j, k];
            place += 1;
            j += 1;
        }
        k += 1;
    }
    exponents
};

/// The six neighbours of a corner, counter-clockwise from the middle face's next corner.
pub fn neighbours(ring: &Ring, corner: usize) -> Option<[Stencil; 6]> {
    let sector = Sector::of(&ring.fans[corner])?;
    let middle = sector.vertex;
    let spoke = |k: usize| Stencil::of(sector.spoke(k));
    let reflected = |a: u32, b: u32, c: u32| Stencil(vec![(a, 1.0), (b, 1.0), (c, -1.0)]).merged();
    let mut about = match (sector.kind, sector.faces.len()) {
        (SectorKind::Interior, 6) => [0, 1, 2, 3, 4, 5].map(spoke),
        (SectorKind::Crease, 3) => {
            let [a, b, c, d] = [0, 1, 2, 3].map(|k| sector.spoke(k));
            let (after, before) = (reflected(middle, d, c), reflected(middle, a, b));
            [spoke(0), spoke(1), spoke(2), spoke(3), after, before]
        }
        (SectorKind::Corner, 1) if !sector.is_closed() => {
            let [a, b] = [0, 1].map(|k| sector.spoke(k));
            let opposite = |of| reflected(middle, middle, of);
            let (after, before) = (reflected(middle, b, a), reflected(middle, a, b));
            [spoke(0), spoke(1), after, opposite(a), opposite(b), before]
        }
        _ => return None,
    };
    about.rotate_left(sector.own);
    Some(about)
}

/// The control points of a cell all of whose corners are regular.
pub fn control_points(ring: &Ring) -> Option<[Stencil; CONTROL_POINTS]> {
    let about = [neighbours(ring, 0)?, neighbours(ring, 1)?, neighbours(ring, 2)?];
    Some(std::array::from_fn(|k| match k {
        0..3 => Stencil::of(ring.fans[k].vertex),
        _ => about[(k - 3) / 3][2 + (k - 3) % 3].clone(),
    }))
}

/// Coefficients of the basis functions, 12 times as large, by monomial.
pub fn basis() -> [[f64; 15]; CONTROL_POINTS] {
    std::array::from_fn(|point| {
        EXPONENTS.map(|exponents| {
            // Exponents counted from a corner.
            let from = |corner: usize| [0, 1, 2].map(|k| exponents[(corner + k) % 3]);
            match point {
                0..3 => of_corner(from(point)),
                _ => {
                    let corner = (point - 3) / 3;
                    let [a, b, c] = from(corner);
                    match (point - 3) % 3 {
                        0 => across_edge([c, a, b]),
                        1 => outside([a, c, b]),
                        _ => outside([a, b, c]),
                    }
                }
            }
        })
    })
}

/// Of the corner a.
fn of_corner([a, b, c]: [usize; 3]) -> f64 {
    let high = b.max(c);
    match (a, high) {
        (4, _) => 6.0,
        (3, _) => 24.0,
        (2, 2) => 24.0,
        (2, _) => 60.0,
        (1, 3) => 8.0,
        (1, _) => 36.0,
        (_, 4) => 1.0,
        (_, 3) => 6.0,
        _ => 12.0,
    }
}

/// Of the point across the edge a–b.
fn across_edge([a, b, c]: [usize; 3]) -> f64 {
    match (c, a.max(b)) {
        (0, 4) => 1.0,
        (0, 3) => 6.0,
        (0, _) => 12.0,
        (1, 3) => 2.0,
        (1, _) => 6.0,
        _ => 0.0,
    }
}

/// Of the neighbour of corner a alone that is nearer to b.
fn outside([a, b, _]: [usize; 3]) -> f64 {
    match (a, b) {
        (4, _) => 1.0,
        (3, 1) => 2.0,
        _ => 0.0,
    }
}

/// The surface of these control points at barycentric coordinates, with derivatives in the second and the third of them.
pub fn evaluate<V: Vector>(points: &[V; CONTROL_POINTS], at: [f64; 3]) -> Jet<V> {
    let power = |x: f64, n: usize| x.powi(n as i32);
    let monomial = |e: [usize; 3]| power(at[0], e[0]) * power(at[1], e[1]) * power(at[2], e[2]) / 12.0;
    let lowered = |mut e: [usize; 3], k: usize| {
        let factor = e[k] as f64;
        e[k] = e[k].saturating_sub(1);
        (factor, e)
    };
    let slope = |e: [usize; 3], k: usize| {
        let (factor, e) = lowered(e, k);
        factor * monomial(e)
    };
    let curvature = |e: [usize; 3], k: usize, l: usize| {
        let (first, e) = lowered(e, k);
        let (second, e) = lowered(e, l);
        first * second * monomial(e)
    };
    let mut jet = Jet {
        value: V::ZERO,
        du: V::ZERO,
        dv: V::ZERO,
        duv: V::ZERO,
    };
    for (point, coefficients) in points.iter().zip(basis()) {
        let sum = |of: &dyn Fn([usize; 3]) -> f64| -> f64 {
            coefficients.iter().zip(EXPONENTS).map(|(c, e)| c * of(e)).sum()
        };
        jet.value = jet.value.plus(*point, sum(&monomial));
        jet.du = jet.du.plus(*point, sum(&|e| slope(e, 1) - slope(e, 0)));
        jet.dv = jet.dv.plus(*point, sum(&|e| slope(e, 2) - slope(e, 0)));
        let mixed = |e| curvature(e, 1, 2) - curvature(e, 1, 0) - curvature(e, 0, 2) + curvature(e, 0, 0);
        jet.duv = jet.duv.plus(*point, sum(&mixed));
    }
    jet
}
