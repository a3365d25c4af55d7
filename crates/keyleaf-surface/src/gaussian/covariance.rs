//! Covariances of vertices: which matrices are ones, and what becomes of those that nearly are.

use super::solve::Ldl;
use super::symmetric::{Eigen, Symmetric3};
use glam::DVec3;

/// The greatest ratio of the greatest to the least variance of a covariance.
pub const CONDITION_LIMIT: f64 = 1e7;

/// How much more the floor of variances is, of the greatest: entries are about as large as that, and so is what rounding does to the
/// least one.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Nine numbers are a symmetric matrix if they are to this part of the largest.
const SYMMETRY: f64 = 1e-6;

/// Variances beyond these would overflow when they are squared.
const LEAST_VARIANCE: f64 = 1e-100;
const GREATEST_VARIANCE: f64 = 1e100;

/// The covariance of a Gaussian in space: symmetric and positive definite, with variances whose ratio is at most
/// [`CONDITION_LIMIT`]. In squared object units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Covariance(Symmetric3);

/// Why a matrix is no covariance.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum CovarianceDefect {
    /// An entry is NaN or infinite.
    #[error("it has entries that are not finite")]
    NotFinite,
    /// Nine numbers that are no symmetric matrix.
    #[error("it is not symmetric")]
    Asymmetric,
    /// No variance is positive, or all are out of range.
    #[error("its greatest variance is {greatest}; expected 1e-100 to 1e100")]
    Size {
        /// The greatest eigenvalue.
        greatest: f64,
    },
    /// A variance is not positive, or too small beside the greatest.
    #[error("its variances run from {least} to {greatest}; expected positive numbers with a ratio of at most 1e7")]
    Condition {
        /// The least eigenvalue.
        least: f64,
        /// The greatest eigenvalue.
        greatest: f64,
    },
}

impl Covariance {
    /// The same variance in all directions; none if it is not between 1e-100 and 1e100.
    pub fn isotropic(variance: f64) -> Option<Self> {
        Self::new(Symmetric3::IDENTITY * variance).ok()
    }

    /// The covariance with this matrix.
    ///
    /// # Errors
    /// [`CovarianceDefect`] if it is none.
    pub fn new(matrix: Symmetric3) -> Result<Self, CovarianceDefect> {
        let [greatest, _, least] = variances(matrix)?;
        if least * CONDITION_LIMIT * (1.0 + 1e-9) >= greatest {
            Ok(Self(matrix))
        } else {
            Err(CovarianceDefect::Condition { least, greatest })
        }
    }

    /// The covariance nearest to this matrix, and whether it had to be changed: variances below the greatest over
    /// [`CONDITION_LIMIT`], also negative ones, become that.
    ///
    /// # Errors
    /// [`CovarianceDefect`] if entries are not finite or no variance is positive.
    pub fn regularised(matrix: Symmetric3) -> Result<(Self, bool), CovarianceDefect> {
        match Self::new(matrix) {
            Ok(covariance) => Ok((covariance, false)),
            Err(CovarianceDefect::Condition { greatest, .. }) => {
                let floor = greatest * (1.0 / CONDITION_LIMIT + ROUNDING);
                Ok((Self(matrix.eigen().map(|variance| variance.max(floor))), true))
            }
            Err(defect) => Err(defect),
        }
    }

    /// The matrix.
    pub fn matrix(&self) -> Symmetric3 {
        self.0
    }

    /// The inverse, Σ⁻¹, by LDLᵀ.
    pub fn precision(&self) -> Symmetric3 {
        // Scaled to 1, so that pivots neither vanish nor overflow.
        let scale = self.0.largest();
        let Some(factors) = Ldl::new(self.0 * (1.0 / scale)) else {
            return self.0.eigen().map(|variance| 1.0 / variance);
        };
        let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| factors.solve(axis));
        let mean = |a: f64, b: f64| (a + b) / 2.0;
        Symmetric3::from_array([x.x, mean(x.y, y.x), mean(x.z, z.x), y.y, mean(y.z, z.y), z.z]) * (1.0 / scale)
    }

    /// Axes, and standard deviations along them.
    pub fn axes(&self) -> ([DVec3; 3], DVec3) {
        let Eigen { values, vectors } = self.0.eigen();
        let least = values[0] / (2.0 * CONDITION_LIMIT); // that of a covariance is more, but for rounding
        (vectors, DVec3::from(values.map(|variance| variance.max(least).sqrt())))
    }

    /// Greatest over least variance.
    pub fn condition(&self) -> f64 {
        let [greatest, _, least] = self.0.eigen().values;
        greatest / least
    }
}

/// The eigenvalues of a matrix that may be a covariance, descending.
fn variances(matrix: Symmetric3) -> Result<[f64; 3], CovarianceDefect> {
    if !matrix.to_array().iter().all(|x| x.is_finite()) {
        return Err(CovarianceDefect::NotFinite);
    }
    let scale = matrix.largest();
    if !(LEAST_VARIANCE..=GREATEST_VARIANCE).contains(&scale) {
        return Err(CovarianceDefect::Size { greatest: scale });
    }
    let values = (matrix * (1.0 / scale)).eigen().values.map(|value| value * scale);
    let greatest = values[0];
    if (LEAST_VARIANCE..=GREATEST_VARIANCE).contains(&greatest) {
        Ok(values)
    } else {
        Err(CovarianceDefect::Size { greatest })
    }
}

/// The symmetric matrix of nine numbers, row by row.
///
/// # Errors
/// [`CovarianceDefect::Asymmetric`] if opposite entries differ by more than 1e-6 of the largest, and
/// [`CovarianceDefect::NotFinite`].
pub fn symmetric(rows: [f64; 9]) -> Result<Symmetric3, CovarianceDefect> {
    if !rows.iter().all(|x| x.is_finite()) {
        return Err(CovarianceDefect::NotFinite);
    }
    let largest = rows.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let [xx, xy, xz, yx, yy, yz, zx, zy, zz] = rows;
    if [xy - yx, xz - zx, yz - zy]
        .iter()
        .any(|difference| difference.abs() > SYMMETRY * largest)
    {
        return Err(CovarianceDefect::Asymmetric);
    }
    let mean = |a: f64, b: f64| a / 2.0 + b / 2.0;
    Ok(Symmetric3::from_array([
        xx,
        mean(xy, yx),
        mean(xz, zx),
        yy,
        mean(yz, zy),
        zz,
    ]))
}
