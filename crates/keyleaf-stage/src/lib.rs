//! A scene of keyleaf on the GPU: what the program, the viewer and the tests share.
//!
//! | module | does |
//! |---|---|
//! | [`load`] | scene file, model or height map → surfaces with their settings and looks; no GPU |
//! | [`plan`] | what those need on a GPU |
//! | [`Stage`] | their quadtrees and draws |
//! | [`Canvas`] | offscreen pictures |
//! | [`drawn`] | the triangles drawn, and how far they are from the exact surface |
//! | [`ErrorProbe`] | how far drawn triangles are from the surface |
//! | [`Timer`], [`Settling`] | what passes cost; whether anything still changes |
//! | [`mesh`] | the triangles that are drawn, for export |
//! | [`construction`] | control meshes and covariances, to be drawn beside their surface |
//! | [`check`] | what is wrong with what the GPU holds: nothing, one hopes |

#![deny(missing_docs)]

pub mod check;
pub mod construction;
mod drawn;
mod error_probe;
mod load;
pub mod mesh;
mod picture;
mod pipelines;
pub mod plan;
mod settling;
mod stage;
mod timer;

pub use drawn::{Deviations, Difference, Drawn, DrawnVertex, difference, differences, drawn};
pub use error_probe::{ErrorProbe, MeasuredError};
pub use load::{LoadError, LoadOptions, Loaded, LoadedObject, load, load_scene, settings, view_of};
pub use picture::{Canvas, DEPTH, SAMPLES, target};
pub use pipelines::Pipelines;
pub use settling::Settling;
pub use stage::{Effects, Show, Stage, StageLook, StageObject};
pub use timer::Timer;
