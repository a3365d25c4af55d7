//! Linear equations with a symmetric positive definite 3 × 3 matrix.

use super::symmetric::Symmetric3;
use glam::{DMat3, DVec3};

/// P S Pᵀ = L D Lᵀ, rows in the order of the largest pivots.
///
/// In f32, and with one step of refinement, its solutions have a few roundings times the condition; the adjugate inverse loses up to
/// an order of magnitude more, and from conditions of 1e5 on its determinant may be negative (Komar, ERRATA).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ldl {
    order: [usize; 3],
    pivots: [f64; 3],
    /// L at (1, 0), (2, 0) and (2, 1).
    lower: [f64; 3],
}

impl Ldl {
    /// The factors, none unless all pivots are positive.
    pub fn new(matrix: Symmetric3) -> Option<Self> {
        let rows = matrix.rows().map(|row| row.to_array());
        let mut order = [0, 1, 2];
        let first = larger(larger(0, 1, |i| rows[i][i]), 2, |i| rows[i][i]);
        order.swap(0, first);
        let p0 = rows[order[0]][order[0]];
        if p0.is_nan() || p0 <= 0.0 {
            return None;
        }
        let rest = |a: usize, b: usize| rows[a][b] - rows[a][first] / p0 * rows[first][b];
        if rest(order[2], order[2]) > rest(order[1], order[1]) {
            order.swap(1, 2);
        }
        let [a, b, c] = order;
        let p1 = rest(b, b);
        if p1.is_nan() || p1 <= 0.0 {
            return None;
        }
        let l21 = rest(c, b) / p1;
        let p2 = rest(c, c) - l21 * rest(c, b);
        (p2 > 0.0).then_some(Self {
            order,
            pivots: [p0, p1, p2],
            lower: [rows[b][a] / p0, rows[c][a] / p0, l21],
        })
    }

    /// T with Tᵀ S T = 1: Pᵀ L⁻ᵀ D^(−1/2).
    pub(super) fn whitening(&self) -> DMat3 {
        let [l10, l20, l21] = self.lower;
        let columns = [[1.0, 0.0, 0.0], [-l10, 1.0, 0.0], [l10 * l21 - l20, -l21, 1.0]];
        let [x, y, z] = [0, 1, 2].map(|k| {
            let mut column = [0.0; 3];
            for (row, value) in self.order.into_iter().zip(columns[k]) {
                column[row] = value / self.pivots[k].sqrt();
            }
            DVec3::from_array(column)
        });
        DMat3::from_cols(x, y, z)
    }

    /// x with S x = b.
    pub fn solve(&self, b: DVec3) -> DVec3 {
        let b = b.to_array();
        let [i, j, k] = self.order;
        let [l10, l20, l21] = self.lower;
        let y0 = b[i];
        let y1 = b[j] - l10 * y0;
        let y2 = b[k] - l20 * y0 - l21 * y1;
        let x2 = y2 / self.pivots[2];
        let x1 = y1 / self.pivots[1] - l21 * x2;
        let x0 = y0 / self.pivots[0] - l10 * x1 - l20 * x2;
        let mut x = [0.0; 3];
        (x[i], x[j], x[k]) = (x0, x1, x2);
        DVec3::from_array(x)
    }
}

fn larger(i: usize, j: usize, value: impl Fn(usize) -> f64) -> usize {
    if value(j) > value(i) { j } else { i }
}

/// x with S x = b by the adjugate, to compare with; none unless the determinant is positive.
pub fn solve_by_adjugate(matrix: Symmetric3, b: DVec3) -> Option<DVec3> {
    let [r0, r1, r2] = matrix.rows();
    let adjugate = [r1.cross(r2), r2.cross(r0), r0.cross(r1)];
    let determinant = r0.dot(adjugate[0]);
    (determinant > 0.0).then(|| DVec3::from_array(adjugate.map(|row| row.dot(b))) / determinant)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::EulerRot;

    #[test]
    fn both_solve_and_indefinite_matrices_are_refused() {
        let t = DMat3::from_euler(EulerRot::XYZ, 0.7, -0.4, 2.5);
        let x = DVec3::new(1.0, -2.0, 3.0);
        for values in [[1.0, 2.0, 3.0], [1e5, 1.0, 1e-2], [1e-9, 2e-9, 1e-9], [5.0, 5.0, 5.0]] {
            let matrix = Symmetric3::diagonal(values).congruent(t);
            let b = matrix * x;
            let factors = Ldl::new(matrix).expect("definite");
            assert!(factors.solve(b).distance(x) < 1e-8);
            let one = matrix.congruent(factors.whitening());
            assert!((one - Symmetric3::IDENTITY).norm() < 1e-8, "{one:?}");
            // The adjugate squares the condition.
            assert!(solve_by_adjugate(matrix, b).expect("definite").distance(x) < 1e-3);
        }
        for values in [
            [1.0, 2.0, -3.0],
            [0.0, 0.0, 0.0],
            [-1.0, -1.0, -1.0],
            [f64::NAN, 1.0, 1.0],
            [1.0, 1.0, -1e-3],
        ] {
            assert_eq!(Ldl::new(Symmetric3::diagonal(values)), None);
        }
    }
}
