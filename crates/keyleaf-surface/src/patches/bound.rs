//! Bounds of the roots of a KSQuad.
//!
//! Hypotenuses of nodes run along u or v and are 2^−level long, so that two numbers a root bound all its diamonds: half the speed
//! for sizes, the same for balls. Second derivatives, for the distance to flat triangles, are bounded by cells ([`LocalDeviation`]).
//!
//! [`LocalDeviation`]: super::local_deviation::LocalDeviation

use super::bezier_net::{BezierNet, DerivativeBounds};
use super::evaluation::KsQuad;
use crate::root_bound::RootBound;

/// A KSQuad is bounded in parts, 4^this of them.
const DEPTH: u32 = 2;
/// The same where weights change a lot: derivatives of rational patches change most where weights are small.
const DEPTH_OF_UNEVEN_WEIGHTS: u32 = 3;
/// The same where they vanish.
const DEPTH_OF_ZERO_WEIGHTS: u32 = 4;
/// Weights are uneven when their ratio is greater.
const UNEVEN: f64 = 4.0;

fn of_derivatives(bounds: DerivativeBounds) -> RootBound {
    let [u, v] = bounds.first;
    // |du| + |dv| is at most half the hypotenuse over a diamond, so that the greater speed bounds its ball as well.
    let half_speed = u.max(v) / 2.0;
    RootBound {
        size: half_speed,
        ball: half_speed,
        deviation: 0.0,
    }
}

/// The bounds of a KSQuad, taken alone.
pub struct OfQuad {
    /// Of its four roots, without deviations.
    pub roots: [RootBound; 4],
    /// Of second derivatives (uu, uv, vv) over 4^depth cells, row by row.
    pub second: Vec<[f64; 3]>,
}

/// The bounds of a KSQuad with 4^`cells` cells.
pub fn of_quad(quad: &KsQuad<'_>, cells: u32) -> OfQuad {
    let net = BezierNet::of(quad);
    let [least, greatest] = net.weights();
    let depth = if least <= 0.0 {
        DEPTH_OF_ZERO_WEIGHTS
    } else if greatest > UNEVEN * least {
        DEPTH_OF_UNEVEN_WEIGHTS
    } else {
        DEPTH
    }
    .max(cells);
    let side = 1u32 << depth;
    let parts: Vec<DerivativeBounds> = net
        .parts(depth)
        .iter()
        .map(|part| part.bounds(1.0 / f64::from(side)))
        .collect();
    let of_root = |root: u32| {
        let cells = (0..side).flat_map(|j| (0..side).map(move |i| [i, j]));
        cells
            .zip(&parts)
            .filter(|&(cell, _)| overlaps(root, cell, side))
            .fold(DerivativeBounds::default(), |bounds, (_, &part)| bounds.max(part))
    };
    OfQuad {
        roots: [0, 1, 2, 3].map(|root| of_derivatives(of_root(root))),
        second: of_cells(&parts, depth, cells),
    }
}

/// Second derivatives over cells that hold 4^(depth − cells) parts each.
fn of_cells(parts: &[DerivativeBounds], depth: u32, cells: u32) -> Vec<[f64; 3]> {
    let shift = depth - cells;
    let mut second = vec![DerivativeBounds::default(); 1 << (2 * cells)];
    for (k, &part) in parts.iter().enumerate() {
        let [i, j] = [k % (1 << depth), k >> depth].map(|at| at >> shift);
        let cell = &mut second[i + (j << cells)];
        *cell = cell.max(part);
    }
    second.into_iter().map(|cell| cell.second).collect()
}

/// Whether a cell of the grid has a part inside the quarter of the square at edge `root`.
fn overlaps(root: u32, [i, j]: [u32; 2], side: u32) -> bool {
    let last = side - 1;
    // Turned so that the edge is v = 0.
    let [i, j] = match root {
        0 => [i, j],
        1 => [j, last - i],
        2 => [last - i, last - j],
        _ => [last - j, i],
    };
    // The lower corners of the cell against the highest point of the triangle over it; `side` is even.
    let highest = if i < side / 2 { i + 1 } else { side - i };
    j < highest
}
