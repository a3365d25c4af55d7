//! Cells of a Catmull-Clark surface whose control net is a bicubic B-spline.
//!
//! Boundaries, creases and corners become end conditions: rows of control points reflected in the edge, 2 pᵢ − pᵢ₊₁.

use super::ring::Ring;
use super::sector::{Sector, SectorKind};
use super::stencil::{Stencil, Vector};

/// Control points about a corner: `[j][i]`, the corner in the middle, i towards the middle face's next corner, j towards its previous.
pub type Block = [[Stencil; 3]; 3];

/// The block of a corner where the surface is that of a B-spline: four faces, two beside a crease or boundary, or one at a sharp corner.
pub fn block(ring: &Ring, corner: usize) -> Option<Block> {
    let fan = &ring.fans[corner];
    if fan.faces.iter().any(|&face| ring.faces[face as usize].len() != 4) {
        return None;
    }
    let sector = Sector::of(fan)?;
    let spoke = |k: usize| Stencil::of(sector.spoke(sector.own + k));
    let diagonal = |k: usize| Stencil::of(sector.diagonal(ring, sector.own + k));
    let middle = Stencil::of(sector.vertex);
    let (next, previous, across) = (spoke(0), spoke(1), diagonal(0));
    let [low_left, low, low_right, left, up_left] = match (sector.kind, sector.faces.len(), sector.own) {
        (SectorKind::Interior, 4, _) => [diagonal(2), spoke(3), diagonal(3), spoke(2), diagonal(1)],
        (SectorKind::Crease, 2, 0) => {
            let (left, up_left) = (spoke(2), diagonal(1));
            [
                reflected(&left, &up_left),
                reflected(&middle, &previous),
                reflected(&next, &across),
                left,
                up_left,
            ]
        }
        (SectorKind::Crease, 2, _) => {
            let low = Stencil::of(sector.spoke(0));
            let low_right = Stencil::of(sector.diagonal(ring, 0));
            [
                reflected(&low, &low_right),
                low,
                low_right,
                reflected(&middle, &next),
                reflected(&previous, &across),
            ]
        }
        (SectorKind::Corner, 1, _) if !sector.is_closed() => {
            let (low, low_right) = (reflected(&middle, &previous), reflected(&next, &across));
            [
                reflected(&low, &low_right),
                low,
                low_right,
                reflected(&middle, &next),
                reflected(&previous, &across),
            ]
        }
        _ => return None,
    };
    Some([
        [low_left, low, low_right],
        [left, middle, next],
        [up_left, previous, across],
    ])
}

/// 2 a − b.
fn reflected(a: &Stencil, b: &Stencil) -> Stencil {
    Stencil::sum([(a, 2.0), (b, -1.0)])
}

/// The sixteen control points of a cell, `[j][i]` with i in u, where all corners have their blocks.
pub fn control_points(ring: &Ring) -> Option<[[Stencil; 4]; 4]> {
    let blocks = [block(ring, 0)?, block(ring, 1)?, block(ring, 2)?, block(ring, 3)?];
    let point = |i: usize, j: usize| {
        // The corner whose block holds the point, and the place in its turned frame.
        let corner = match (i < 2, j < 2) {
            (true, true) => 0,
            (false, true) => 1,
            (false, false) => 2,
            (true, false) => 3,
        };
        let (along, up) = match corner {
            0 => (i, j),
            1 => (j, 3 - i),
            2 => (3 - i, 3 - j),
            _ => (3 - j, i),
        };
        blocks[corner][up][along].clone()
    };
    Some(std::array::from_fn(|j| std::array::from_fn(|i| point(i, j))))
}

/// Value and derivatives of a sum of products of two bases.
#[derive(Clone, Copy, Debug)]
pub struct Jet<V> {
    /// The value.
    pub value: V,
    /// In the first parameter.
    pub du: V,
    /// In the second parameter.
    pub dv: V,
    /// In both.
    pub duv: V,
}

/// The surface of these control points of a uniform bicubic B-spline at (u, v) in the unit square.
pub fn evaluate<V: Vector>(points: &[[V; 4]; 4], u: f64, v: f64) -> Jet<V> {
    let ([bu, du], [bv, dv]) = (basis(u), basis(v));
    let sum = |bu: [f64; 4], bv: [f64; 4]| {
        let terms = (0..4).flat_map(|j| (0..4).map(move |i| (j, i)));
        terms.fold(V::ZERO, |sum, (j, i)| sum.plus(points[j][i], bu[i] * bv[j]))
    };
    Jet {
        value: sum(bu, bv),
        du: sum(du, bv),
        dv: sum(bu, dv),
        duv: sum(du, dv),
    }
}

/// The uniform cubic B-splines over a span, and their derivatives.
fn basis(t: f64) -> [[f64; 4]; 2] {
    let s = 1.0 - t;
    let value = [
        s * s * s / 6.0,
        (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0,
        (4.0 - 6.0 * s * s + 3.0 * s * s * s) / 6.0,
        t * t * t / 6.0,
    ];
    let slope = [
        -s * s / 2.0,
        (3.0 * t * t - 4.0 * t) / 2.0,
        (4.0 * s - 3.0 * s * s) / 2.0,
        t * t / 2.0,
    ];
    [value, slope]
}
