//! The space in which Gaussian products are sums (Preiner et al. 2019; Komar 2.2).
//!
//! A Gaussian with mean μ and covariance Σ becomes the nine numbers q = (q̂, q̄): the precision q̂ = Σ⁻¹ and q̄ = Σ⁻¹ μ. The product
//! of powers of Gaussians is the weighted sum of their q, and its mean is q̂⁻¹ q̄. Derivatives of the mean follow from those of q by
//! differentiating q̂ μ = q̄: q̂ μ_u = q̄_u − q̂_u μ (Komar 3.12), q̂ μ_uv = q̄_uv − q̂_uv μ − q̂_u μ_v − q̂_v μ_u.
//!
//! Affine maps commute with products. So every patch has a frame of its own, in which its numbers are harmless: without it, q̄ of
//! coordinates far from zero cancels, and flat Gaussians are ill-conditioned.

use super::covariance::Covariance;
use super::solve::Ldl;
use super::symmetric::Symmetric3;
use crate::SurfaceFrame;
use crate::direction::frame_normal;
use crate::subdivision::exact::Located;
use crate::subdivision::stencil::Vector;
use glam::{DMat3, DVec3};
use std::ops::{Add, Mul, Sub};

/// An affine map x = centre + axes · y from the coordinates of a patch to object space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DualFrame {
    /// The origin of the patch's coordinates, object space.
    pub centre: DVec3,
    /// Its columns are the units of the patch's coordinates, in object units.
    pub axes: DMat3,
}

impl DualFrame {
    /// Object space itself.
    pub const OBJECT: Self = Self {
        centre: DVec3::ZERO,
        axes: DMat3::IDENTITY,
    };

    /// About the mean of the means, in units in which the greatest trace of a precision is 1.
    pub fn scaled(gaussians: &[(DVec3, Covariance)]) -> Self {
        let traces = gaussians.iter().map(|(_, covariance)| covariance.precision().trace());
        let largest = traces.fold(0.0, f64::max);
        Self::round(mean(gaussians), largest)
    }

    /// About the mean of the means, in axes and units in which the mean of the precisions is the unit matrix ("whitened"). Gaussians
    /// that are flat alike become round, so that their condition is that of their differences.
    pub fn whitened(gaussians: &[(DVec3, Covariance)]) -> Self {
        let share = 1.0 / gaussians.len().max(1) as f64;
        let precision = gaussians.iter().fold(Symmetric3::default(), |sum, (_, covariance)| {
            sum + covariance.precision() * share
        });
        Self {
            centre: mean(gaussians),
            axes: whitening(precision).unwrap_or(DMat3::IDENTITY),
        }
    }

    /// About a centre, in units in which this trace of a precision is 1.
    pub(crate) fn round(centre: DVec3, trace: f64) -> Self {
        let unit = if trace > 0.0 { trace.sqrt().recip() } else { 1.0 };
        Self {
            centre,
            axes: DMat3::from_diagonal(DVec3::splat(unit)),
        }
    }

    /// A point of the patch in object space.
    pub fn point(&self, local: DVec3) -> DVec3 {
        self.centre + self.axes * local
    }
}

fn mean(gaussians: &[(DVec3, Covariance)]) -> DVec3 {
    let share = 1.0 / gaussians.len().max(1) as f64;
    gaussians.iter().map(|(mean, _)| *mean * share).sum()
}

/// T with Tᵀ S T = 1, none unless S is positive definite.
pub fn whitening(matrix: Symmetric3) -> Option<DMat3> {
    let scale = matrix.largest();
    let eigen = (matrix * (1.0 / scale)).eigen();
    let column = |k: usize| eigen.vectors[k] / (eigen.values[k] * scale).sqrt();
    let is_definite = scale > 0.0 && eigen.values[2] > 0.0;
    is_definite.then(|| DMat3::from_cols(column(0), column(1), column(2)))
}

/// A Gaussian, or a weighted sum of some, in dual space.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Dual {
    /// q̂: the precision matrix. Of a sum with negative weights it may be indefinite.
    pub precision: Symmetric3,
    /// q̄: the precision times the mean.
    pub information: DVec3,
}

impl Dual {
    /// Mean 0 and precision 1.
    pub(super) const ONE: Self = Self {
        precision: Symmetric3::IDENTITY,
        information: DVec3::ZERO,
    };

    /// Of a Gaussian, in the coordinates of a frame: the precision is Tᵀ Σ⁻¹ T, and the mean T⁻¹ (μ − c).
    pub fn of(mean: DVec3, covariance: &Covariance, frame: &DualFrame) -> Self {
        Self::of_precision(mean, covariance.precision(), frame)
    }

    /// The same from Σ⁻¹.
    pub(crate) fn of_precision(mean: DVec3, precision: Symmetric3, frame: &DualFrame) -> Self {
        Self {
            precision: precision.congruent(frame.axes),
            information: frame.axes.transpose() * (precision * (mean - frame.centre)),
        }
    }

    /// The mean, by LDLᵀ with one step of refinement; none if the precision is not positive definite.
    pub fn mean(&self) -> Option<DVec3> {
        Some(self.solve()?.1)
    }

    /// The factors of the precision, and the mean.
    pub(super) fn solve(&self) -> Option<(Ldl, DVec3)> {
        let factors = Ldl::new(self.precision)?;
        let mean = factors.solve(self.information);
        let residual = self.information - self.precision * mean;
        Some((factors, mean + factors.solve(residual)))
    }

    /// The same in the coordinates y' of x = centre + axes · y'. Linear, so that it holds for sums and derivatives as well.
    pub fn in_frame(&self, frame: &DualFrame) -> Self {
        Self {
            precision: self.precision.congruent(frame.axes),
            information: frame.axes.transpose() * (self.information - self.precision * frame.centre),
        }
    }

    /// From (q̂ xx, xy, xz, yy, yz, zz, q̄ x, y, z).
    pub fn from_array([xx, xy, xz, yy, yz, zz, x, y, z]: [f64; 9]) -> Self {
        Self {
            precision: Symmetric3::from_array([xx, xy, xz, yy, yz, zz]),
            information: DVec3::new(x, y, z),
        }
    }

    /// As (q̂ xx, xy, xz, yy, yz, zz, q̄ x, y, z).
    pub fn to_array(&self) -> [f64; 9] {
        let [xx, xy, xz, yy, yz, zz] = self.precision.to_array();
        let [x, y, z] = self.information.to_array();
        [xx, xy, xz, yy, yz, zz, x, y, z]
    }
}

impl Add for Dual {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            precision: self.precision + other.precision,
            information: self.information + other.information,
        }
    }
}

impl Sub for Dual {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + other * -1.0
    }
}

impl Mul<f64> for Dual {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self {
            precision: self.precision * factor,
            information: self.information * factor,
        }
    }
}

impl Vector for Dual {
    const ZERO: Self = Self {
        precision: Symmetric3::diagonal([0.0; 3]),
        information: DVec3::ZERO,
    };

    #[inline]
    fn plus(self, other: Self, weight: f64) -> Self {
        let mut sum = self.to_array();
        for (sum, other) in sum.iter_mut().zip(other.to_array()) {
            *sum += other * weight;
        }
        Self::from_array(sum)
    }
}

impl Located for Dual {
    /// Zero where there is no mean; limits of subdivision always have one, since their weights are not negative.
    fn position(&self) -> DVec3 {
        self.mean().unwrap_or(DVec3::ZERO)
    }

    fn motion(&self, rate: Self) -> DVec3 {
        let moved = |(factors, mean): (Ldl, DVec3)| factors.solve(rate.information - rate.precision * mean);
        self.solve().map_or(DVec3::ZERO, moved)
    }
}

/// A point in dual space with derivatives in two parameters.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DualJet {
    /// Value, ∂u, ∂v, ∂uu, ∂uv, ∂vv.
    pub terms: [Dual; 6],
}

/// The mean of a Gaussian product with its derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeanJet {
    /// The mean.
    pub mean: DVec3,
    /// First derivatives, in u and v.
    pub first: [DVec3; 2],
    /// ∂uu, ∂uv, ∂vv.
    pub second: [DVec3; 3],
}

impl DualJet {
    /// Σ of control points times the values and derivatives (as in [`DualJet::terms`]) of their basis functions.
    pub fn weighted(controls: impl IntoIterator<Item = (Dual, [f64; 6])>) -> Self {
        let mut jet = Self::default();
        for (control, basis) in controls {
            for (term, weight) in jet.terms.iter_mut().zip(basis) {
                *term = *term + control * weight;
            }
        }
        jet
    }

    /// The mean and its derivatives; none if the precision is not positive definite.
    pub fn mean(&self) -> Option<MeanJet> {
        let [value, u, v, uu, uv, vv] = self.terms;
        let (factors, mean) = value.solve()?;
        let first = [u, v].map(|d| factors.solve(d.information - d.precision * mean));
        let second = |d: Dual, a: usize, b: usize| {
            let sides = [u, v];
            let products = sides[a].precision * first[b] + sides[b].precision * first[a];
            factors.solve(d.information - d.precision * mean - products)
        };
        Some(MeanJet {
            mean,
            first,
            second: [second(uu, 0, 0), second(uv, 0, 1), second(vv, 1, 1)],
        })
    }
}

impl MeanJet {
    /// From the coordinates of a frame to object space.
    pub fn in_object_space(&self, frame: &DualFrame) -> Self {
        Self {
            mean: frame.point(self.mean),
            first: self.first.map(|v| frame.axes * v),
            second: self.second.map(|v| frame.axes * v),
        }
    }

    /// Position, derivatives and unit normal; where the derivatives are parallel, a limit by the mixed one, or `fallback`.
    pub fn frame(&self, fallback: DVec3) -> SurfaceFrame {
        let [du, dv] = self.first;
        SurfaceFrame {
            position: self.mean,
            du,
            dv,
            normal: frame_normal(du, dv, self.second[1], fallback),
        }
    }
}
