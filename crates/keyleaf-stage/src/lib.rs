//! A scene of keyleaf on the GPU: what the program, the viewer and the tests share.
//!
//! | module | does |
//! |---|---|
//! | [`load`] | scene file, model or height map → surfaces with their settings and looks; no GPU |
//! | [`plan`] | what those need on a GPU |
//! | [`Stage`] | their quadtrees and draws |
//! | [`Canvas`] | offscreen pictures |
//! | [`drawn`] | the triangles drawn, and how far they are from the exact surface |
//! | [`check`] | what is wrong with what the GPU holds: nothing, one hopes |

#![deny(missing_docs)]

pub mod check;
mod drawn;
mod load;
mod picture;
pub mod plan;
mod stage;

pub use drawn::{Deviations, Difference, Drawn, DrawnVertex, difference, differences, drawn};
pub use load::{LoadError, LoadOptions, Loaded, LoadedObject, load, settings, view_of};
pub use picture::{Canvas, DEPTH, SAMPLES, target};
pub use stage::{Effects, Pipelines, Show, Stage, StageLook, StageObject};
