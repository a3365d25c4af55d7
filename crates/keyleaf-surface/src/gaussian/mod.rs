//! Gaussian-product subdivision (Preiner, Boubekeur & Wimmer 2019; Komar 2020).
//!
//! # Theory
//!
//! Vertices of a *covariance mesh* are Gaussians. Mapped to nine numbers each, they are subdivided by the rules of any linear scheme;
//! mapped back, the means are the surface. So everything that is linear – refinement, limit masks, Bézier patches – happens in dual
//! space with the weights of the scheme, and only a point of the surface asks for the mean of what it finds there.
//!
//! # Changes versus the thesis
//!
//! - q̄ = Σ⁻¹ μ of absolute coordinates cancels in f32: at an offset of 1e4 and a condition of 1e4 by 7 % of the patch. Here a patch has
//!   its own [`DualFrame`]: means relative to a centre, and preferably *whitened*, so that disks that are parallel or nearly so become
//!   round and lose no digits at all.
//! - The inverse is an LDLᵀ factorisation with pivots, in f64 with one step of refinement, not the adjugate, which is indefinite in a
//!   quarter of the cases at a condition of 1e5.
//! - Terminal patches are those of the scheme behind, in dual space; in the thesis extraordinary corners are approximated in one patch.
//! - Equation 3.1 gives the inward normal of counter-clockwise triangles, and 2.15 and 3.10 transpose each other's indices.
//!
//! # In f32
//!
//! Largest error of the mean of 16 disks within a patch, in units of 2⁻²⁴ of its extent (400 cases each; `tests/gaussian`):
//!
//! | condition | axes | thesis | about a centre, LDLᵀ | (Σ⁻¹, μ), r = Σ α Q (μ_i − μ) | whitened, LDLᵀ |
//! |---|---|---|---|---|---|
//! | 1e2 | parallel | 350 | 28 | 30 | 1.4 |
//! | 1e4 | parallel | 4e6 | 4,000 | 2,500 | 1.6 |
//! | 1e4 | turned by 0.1 | 5e4 | 3,400 | 560 | 29 |
//! | 1e6 | turned by 0.1 | 1e5 | 2,900 | 780 | 38 |
//! | 1e4 | any | 8 | 3.4 | 1.9 | 3.1 |
//!
//! So tables hold (q̂, q̄) in the whitened frame of a patch, with its centre and axes; a step of refinement gains nothing there. Where
//! vertices must be shared between patches, (Σ⁻¹, μ) with weights of vertices and r = Σ α Q (μ_i − μ) from μ = Σ α μ_i is next best.
//!
//! # Practice
//!
//! | file | does |
//! |---|---|
//! | `covariance`, `covariance_mesh` | what users give; converters from plain meshes |
//! | `symmetric`, `solve` | 3 × 3 matrices: eigenvalues, linear equations |
//! | `dual` | to dual space and back, with derivatives |
//! | `patch` | Bézier patches in dual space |
//! | `bound`, `centred` | bounds of patches and of their parts |
//! | `lanes`, `lanes_of_triangle` | their control points, number by number |
//! | `dual_patches`, `terminal`, `face_bounds` | the patches of a surface, how far they are off, bounds of faces |
//! | `rounding` | what f32 loses of the means of a surface |
//! | `surface`, `tables`, `pose` | [`GaussianProduct`], and what the GPU reads |
//!
//! ```
//! use glam::DVec3;
//! use keyleaf_surface::gaussian::{Covariance, Dual, DualFrame, Symmetric3};
//! // Two disks, one in the plane z = 0, one in the plane x = 1: their product lies where the planes meet.
//! let disk = |variances| Covariance::new(Symmetric3::diagonal(variances));
//! let gaussians = [(DVec3::ZERO, disk([1.0, 1.0, 1e-4])?), (DVec3::new(1.0, 0.0, 1.0), disk([1e-4, 1.0, 1.0])?)];
//! let frame = DualFrame::whitened(&gaussians);
//! let [a, b] = gaussians.map(|(mean, covariance)| Dual::of(mean, &covariance, &frame));
//! let middle = frame.point((a * 0.5 + b * 0.5).mean().expect("positive definite"));
//! assert!(middle.distance(DVec3::new(1.0, 0.0, 0.0)) < 1e-3);
//! # Ok::<(), keyleaf_surface::gaussian::CovarianceDefect>(())
//! ```

mod bound;
mod centred;
mod covariance;
mod covariance_mesh;
mod dual;
mod dual_patches;
mod face_bounds;
mod lanes;
mod lanes_of_triangle;
mod patch;
mod pose;
mod rounding;
mod solve;
mod surface;
mod symmetric;
mod tables;
mod terminal;

pub use bound::MeanBounds;
pub use covariance::{CONDITION_LIMIT, Covariance, CovarianceDefect, symmetric as symmetric_of_rows};
pub use covariance_mesh::{Conditioning, CovarianceError, CovarianceMesh};
pub use dual::{Dual, DualFrame, DualJet, MeanJet};
pub use patch::{DualSquare, DualTriangle};
pub use solve::{Ldl, solve_by_adjugate};
pub use surface::{GaussianProduct, GaussianSettings, Solver};
pub use symmetric::{Eigen, Symmetric3};
