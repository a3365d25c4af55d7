//! Comparison tessellators: what adaptive quadtrees on parametric surfaces are measured against.
//!
//! # Theory
//!
//! The methods are those of R. Concheiro, *Parametric surfaces on the GPU* (thesis, A Coruña 2013), here on the CPU in
//! f64, where triangle counts, errors and cracks can be compared; times on a GPU cannot.
//!
//! | function | thesis | what it does |
//! |---|---|---|
//! | [`uniform::per_surface`], [`uniform::at_levels`] | 2.2, VST | one grid a surface |
//! | [`zones::at_levels`] | 2.3, GST | the same in zones, with what that costs |
//! | [`uniform::per_ks_quad`] | 6.3, 6.6, RPNS-U | one grid a KSQuad, by its size on screen |
//! | [`semi_adaptive::tessellate`] | 4.2 | rows that are there or not, with virtual vertices, in triangle strips |
//! | [`dabt::tessellate`] | 3.2 | three resolutions a triangle, tests by vertex, strips of vertices |
//!
//! Each returns a [`Tessellation`]; [`check`] looks for cracks, folds and overlaps in any of them, [`deviation`]
//! measures its distance to the surfaces, and [`compare`] tables all methods at the three qualities of tables 3.1 and
//! 4.1.
//!
//! # Changes from the thesis
//!
//! *No cracks between surfaces.* In the thesis, patches are cut alike, or gaps are hidden by oversampling (6.3). Here
//! every shared edge is cut once, from one of its surfaces, and shared points are one vertex. Where joined sides have
//! different knots, each gets those of the other, across the strip of surfaces. A collapsed side is one vertex;
//! triangles that have no area for it are kept apart as [`Sliver`]s. What a method changes besides is listed under
//! *Departures* in its module.
//!
//! *KSQuads instead of patches.* The thesis tessellates bicubic patches in chapters 2 to 4. The adaptive methods here
//! take a KSQuad of a NURBS surface as such a patch.
//!
//! # Practice
//!
//! Implement [`Sampler`] for a model, then:
//!
//! ```
//! use glam::{DVec2, DVec3};
//! use keyleaf_baseline::{BaselineError, Boundary, Sampler, Side, View, compare};
//!
//! /// One bicubic patch: a monkey saddle.
//! struct Saddle;
//!
//! impl Sampler for Saddle {
//!     fn surfaces(&self) -> usize {
//!         1
//!     }
//!     fn point(&self, _surface: usize, at: DVec2) -> DVec3 {
//!         DVec3::new(at.x, at.y, at.x.powi(3) - 3.0 * at.x * at.y * at.y)
//!     }
//!     fn spans(&self, _surface: usize) -> [Vec<f64>; 2] {
//!         [vec![-1.0, 1.0], vec![-1.0, 1.0]]
//!     }
//!     fn boundary(&self, _surface: usize, _side: Side) -> Boundary {
//!         Boundary::Free
//!     }
//! }
//!
//! # fn main() -> Result<(), BaselineError> {
//! let view = View { eye: DVec3::new(0.0, -5.0, 5.0), pixels_per_radian: 1000.0, near: 0.1 };
//! for row in compare(&Saddle, &view)? {
//!     println!(
//!         "{:<30} {:<8} {:>6} triangles, error {:6.3} px, mean {:6.3} px",
//!         row.method, row.quality, row.triangles, row.max_error_pixels, row.mean_error_pixels
//!     );
//! }
//! # Ok(())
//! # }
//! ```
//!
//! Costs are in evaluations of [`Sampler::point`]; each module says how many. Nothing is cached between calls.

mod breaks;
mod cells;
mod check;
mod coarse;
mod compare;
mod curve;
pub mod dabt;
mod deviation;
mod disjoint_sets;
mod error;
mod geometry;
mod grid;
mod insertion;
mod mesher;
mod numbering;
mod quality;
mod rows;
mod sampler;
pub mod semi_adaptive;
mod strip;
mod tessellation;
pub mod uniform;
mod view;
mod virtual_rows;
pub mod zones;

pub use check::{Report, check};
pub use compare::{Row, compare, threshold_for_share};
pub use deviation::{Deviation, deviation};
pub use error::BaselineError;
pub use insertion::{MAX_RESOLUTION, Settings, Test};
pub use quality::{Method, Quality, TestKind};
pub use sampler::{Boundary, Sampler, Side};
pub use tessellation::{Sliver, Tessellation};
pub use view::View;
