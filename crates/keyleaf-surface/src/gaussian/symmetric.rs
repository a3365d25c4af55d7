//! Symmetric 3 × 3 matrices.

use glam::{DMat3, DVec3};
use std::ops::{Add, Mul, Sub};

/// The most sweeps of Jacobi's method; convergence is quadratic, and six are enough for any matrix.
const SWEEPS: usize = 12;

/// What is left beside the diagonal, over the largest entry, when Jacobi's method has done.
const CONVERGED: f64 = 1e-20;

/// A symmetric 3 × 3 matrix by its upper triangle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Symmetric3 {
    /// Row 0, column 0.
    pub xx: f64,
    /// Rows 0 and 1.
    pub xy: f64,
    /// Rows 0 and 2.
    pub xz: f64,
    /// Row 1, column 1.
    pub yy: f64,
    /// Rows 1 and 2.
    pub yz: f64,
    /// Row 2, column 2.
    pub zz: f64,
}

/// Eigenvalues, the greatest first, and unit eigenvectors at right angles: S = Σ λ v vᵀ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eigen {
    /// The eigenvalues, descending.
    pub values: [f64; 3],
    /// Their eigenvectors.
    pub vectors: [DVec3; 3],
}

impl Symmetric3 {
    /// The unit matrix.
    pub const IDENTITY: Self = Self::diagonal([1.0; 3]);

    /// With this diagonal, and zeros beside it.
    pub const fn diagonal([xx, yy, zz]: [f64; 3]) -> Self {
        Self {
            xx,
            xy: 0.0,
            xz: 0.0,
            yy,
            yz: 0.0,
            zz,
        }
    }

    /// From (xx, xy, xz, yy, yz, zz).
    pub fn from_array([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> Self {
        Self { xx, xy, xz, yy, yz, zz }
    }

    /// As (xx, xy, xz, yy, yz, zz).
    pub fn to_array(self) -> [f64; 6] {
        [self.xx, self.xy, self.xz, self.yy, self.yz, self.zz]
    }

    /// v vᵀ.
    pub fn outer(v: DVec3) -> Self {
        Self::from_array([v.x * v.x, v.x * v.y, v.x * v.z, v.y * v.y, v.y * v.z, v.z * v.z])
    }

    /// The rows, which are also the columns.
    pub fn rows(self) -> [DVec3; 3] {
        [
            DVec3::new(self.xx, self.xy, self.xz),
            DVec3::new(self.xy, self.yy, self.yz),
            DVec3::new(self.xz, self.yz, self.zz),
        ]
    }

    /// The sum of the diagonal, which is that of the eigenvalues.
    pub fn trace(self) -> f64 {
        self.xx + self.yy + self.zz
    }

    /// The largest absolute value of an entry.
    pub fn largest(self) -> f64 {
        self.to_array()
            .into_iter()
            .fold(0.0, |largest, x| f64::max(largest, x.abs()))
    }

    /// The Frobenius norm, which bounds the absolute values of the eigenvalues.
    pub fn norm(self) -> f64 {
        self.norm_squared().sqrt()
    }

    pub(super) fn norm_squared(self) -> f64 {
        let off_diagonal = self.xy * self.xy + self.xz * self.xz + self.yz * self.yz;
        self.xx * self.xx + self.yy * self.yy + self.zz * self.zz + 2.0 * off_diagonal
    }

    /// Tᵀ S T.
    pub fn congruent(self, t: DMat3) -> Self {
        let [a, b, c] = [t.x_axis, t.y_axis, t.z_axis];
        let (sa, sb, sc) = (self * a, self * b, self * c);
        Self::from_array([a.dot(sa), a.dot(sb), a.dot(sc), b.dot(sb), b.dot(sc), c.dot(sc)])
    }

    /// Eigenvalues and eigenvectors by Jacobi's method (Golub & Van Loan 8.5), to rounding of the greatest. All entries must be
    /// finite.
    pub fn eigen(self) -> Eigen {
        let mut a = self.rows().map(|row| row.to_array());
        let mut vectors = [DVec3::X, DVec3::Y, DVec3::Z];
        let rest = CONVERGED * self.largest();
        for _ in 0..SWEEPS {
            if a[0][1].abs().max(a[0][2].abs()).max(a[1][2].abs()) <= rest {
                break;
            }
            for [p, q] in [[0, 1], [0, 2], [1, 2]] {
                rotate(&mut a, &mut vectors, p, q);
            }
        }
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| a[j][j].total_cmp(&a[i][i]));
        Eigen {
            values: order.map(|i| a[i][i]),
            vectors: order.map(|i| vectors[i]),
        }
    }
}

/// One rotation, after which the entry (p, q) is zero.
fn rotate(a: &mut [[f64; 3]; 3], vectors: &mut [DVec3; 3], p: usize, q: usize) {
    if a[p][q] == 0.0 {
        return;
    }
    let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
    let tangent = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
    let cosine = 1.0 / (tangent * tangent + 1.0).sqrt();
    let sine = tangent * cosine;
    let off = a[p][q];
    let k = 3 - p - q;
    let (kp, kq) = (a[k][p], a[k][q]);
    a[p][p] -= tangent * off;
    a[q][q] += tangent * off;
    (a[p][q], a[q][p]) = (0.0, 0.0);
    a[k][p] = cosine * kp - sine * kq;
    a[k][q] = sine * kp + cosine * kq;
    (a[p][k], a[q][k]) = (a[k][p], a[k][q]);
    let (vp, vq) = (vectors[p], vectors[q]);
    vectors[p] = vp * cosine - vq * sine;
    vectors[q] = vp * sine + vq * cosine;
}

impl Eigen {
    /// Σ f(λ) v vᵀ.
    pub fn map(&self, f: impl Fn(f64) -> f64) -> Symmetric3 {
        let term = |k: usize| Symmetric3::outer(self.vectors[k]) * f(self.values[k]);
        term(0) + term(1) + term(2)
    }
}

impl Add for Symmetric3 {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            xx: self.xx + other.xx,
            xy: self.xy + other.xy,
            xz: self.xz + other.xz,
            yy: self.yy + other.yy,
            yz: self.yz + other.yz,
            zz: self.zz + other.zz,
        }
    }
}

impl Sub for Symmetric3 {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + other * -1.0
    }
}

impl Mul<f64> for Symmetric3 {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self {
            xx: self.xx * factor,
            xy: self.xy * factor,
            xz: self.xz * factor,
            yy: self.yy * factor,
            yz: self.yz * factor,
            zz: self.zz * factor,
        }
    }
}

impl Mul<DVec3> for Symmetric3 {
    type Output = DVec3;

    fn mul(self, v: DVec3) -> DVec3 {
        let [x, y, z] = self.rows();
        DVec3::new(x.dot(v), y.dot(v), z.dot(v))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eigenvectors_rebuild_the_matrix_at_any_scale_and_condition() {
        let turned = |values: [f64; 3]| {
            let t = DMat3::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -2.0);
            Symmetric3::diagonal(values).congruent(t.transpose())
        };
        for scale in [1e-30, 1.0, 1e30] {
            for values in [
                [1.0, 1.0, 1.0],
                [3.0, 2.0, 1.0],
                [1.0, 1e-7, 1e-7],
                [1.0, 0.0, -1.0],
                [2.0, 2.0, -5.0],
            ] {
                let matrix = turned(values) * scale;
                let eigen = matrix.eigen();
                let error = (eigen.map(|x| x) - matrix).norm();
                assert!(
                    error < 1e-15 * matrix.norm().max(1e-300) * 10.0,
                    "{values:?} {scale}: {error}"
                );
                for (found, expected) in eigen.values.into_iter().zip(values) {
                    assert!(
                        (found - expected * scale).abs() < 1e-14 * 5.0 * scale,
                        "{found} {expected}"
                    );
                }
                for v in eigen.vectors {
                    assert!((v.length() - 1.0).abs() < 1e-14);
                }
            }
        }
        assert_eq!(Symmetric3::default().eigen().values, [0.0; 3]);
    }
}
