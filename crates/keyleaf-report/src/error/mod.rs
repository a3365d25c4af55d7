//! How far drawn triangles are from the surface that they stand for.
//!
//! # Theory
//!
//! | measure | is the distance |
//! |---|---|
//! | forward | from a point of a triangle to the nearest point of the surface |
//! | backward | from a point of the surface over a triangle to the nearest point of all triangles |
//! | parametric | between triangle and surface at equal parameters; bounds both, and is the chord error of the literature |
//! | normal | in degrees, between the interpolated normal and that of the surface's nearest point |
//! | shift | in pixels, between where a point of a triangle and the surface's nearest point are seen |
//! | side-on | in pixels, the forward distance as if it were seen from the side: what screen-space metrics bound |
//! | silhouette | in pixels, between the contours of triangles and surface, both ways |
//!
//! The greater of forward and backward maximum is the Hausdorff distance, to the density of the samples.
//!
//! # Practice
//!
//! Every triangle carries the parameters of its corners, so that the search on the surface starts beside its end: Gauss-Newton steps
//! on |S(u, v) − p|², taken only if they come nearer, across the edges of faces where they lead there (`foot`). Backward distances ask a
//! tree of all triangles (`tree`), exactly. Samples are a lattice whose weights integrate the square of a linear function exactly over
//! each cell (`lattice`). Cost: about four evaluations of the surface a sample, 28 samples a triangle by default; all cores take part.
//!
//! Everything is in f64. What a distance of 0 means is limited by [`RootPoint`](keyleaf_key::RootPoint)s, which round parameters to
//! 2⁻³¹: an error of that part of a face along it, and the square of it across.
//!
//! A triangle belongs to one face. Tessellations whose triangles reach over several, such as uniform grids of a surface with many knot
//! spans, are refused: they are to be cut at the spans, or measured face by face.

mod chord;
mod domain;
mod foot;
mod lattice;
mod measure;
mod nearest;
mod object;
mod screen;
mod silhouette;
#[cfg(test)]
mod sphere;
#[cfg(test)]
mod tests;
mod tree;
mod triangle;

pub use chord::{ChordError, chord_error};
pub use measure::Measure;
pub use object::{MeshError, Truth, measure};
pub use screen::{ScreenError, ScreenView};
pub use silhouette::Silhouette;
pub use triangle::{DrawnTriangle, DrawnVertex};

use thiserror::Error;

/// How densely is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorSettings {
    /// Intervals an edge of a triangle, an even number from 2. A multiple of 6 meets the middle of edges and of the triangle.
    pub intervals: u32,
    /// Samples at most, over all triangles. If they are more, intervals fall to 2; then every n-th triangle is measured, and
    /// [`MeshError::measured`] says how many were.
    pub most_samples: usize,
    /// Which points count as the surface.
    pub truth: Truth,
    /// The length that errors are divided by; `None` for the diagonal of the surface's bounding box.
    pub diagonal: Option<f64>,
}

impl Default for ErrorSettings {
    fn default() -> Self {
        Self {
            intervals: 6,
            most_samples: 4_000_000,
            truth: Truth::Limit,
            diagonal: None,
        }
    }
}

/// Why triangles cannot be measured.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum MeasureError {
    /// There are none.
    #[error("no triangles: expected one at least; does the view see the surface?")]
    Empty,
    /// A position or normal is not finite.
    #[error("triangle {triangle} has a position or normal that is not finite: `keyleaf check` finds out why")]
    NotFinite {
        /// Which of the triangles, from 0.
        triangle: usize,
    },
    /// A corner is no point of the surface.
    #[error("triangle {triangle} has a corner outside of root {root} of face {face}: expected a point of the surface")]
    Outside {
        /// Which of the triangles, from 0.
        triangle: usize,
        /// The face that the corner names.
        face: u32,
        /// The root that the corner names.
        root: u32,
    },
    /// The corners belong to several faces, so that there is no surface "over" the triangle.
    #[error("triangle {triangle} has corners on several faces, or, with more than four corners, roots: expected one")]
    AcrossFaces {
        /// Which of the triangles, from 0.
        triangle: usize,
    },
    /// The surface refused a parameter.
    #[error("the surface cannot be evaluated: {0}")]
    Parameter(String),
    /// A setting is out of range.
    #[error("{name} is {value}: expected {expected}")]
    Setting {
        /// The setting.
        name: &'static str,
        /// What it is.
        value: f64,
        /// What it may be.
        expected: &'static str,
    },
}
