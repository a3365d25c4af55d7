//! keyleaf: adaptive level of detail on the GPU, every frame.
//!
//! For every root triangle of a coarse surface keyleaf keeps a *linear quadtree*: the list of its leaves, each a 64-bit key. Compute
//! passes split and merge leaves to the detail that the view needs; one indirect draw renders them through a surface evaluator. The
//! CPU never reads back to draw a frame. No frame cracks, whatever the metric and however the camera jumps.
//!
//! The library borrows device, queue and encoder; it submits nothing and waits for nothing (but in [`read_back`] and [`headless`],
//! which are for tools).
//!
//! # Objects, by lifetime
//! | object | lives as long as | holds |
//! |---|---|---|
//! | [`Passes`] | the device | pipelines for a kind of surface and metric |
//! | [`Quadtree`] | the surface | tables, leaves, leaf table, lists |
//! | [`View`] | a frame | the camera |
//! | [`Statistics`] | – | figures, some frames late |

#![deny(missing_docs)]

pub mod binding;
pub mod draw;
mod error;
mod grid;
pub mod headless;
pub mod inspect;
pub mod layout;
mod passes;
mod quadtree;
pub mod read_back;
mod settings;
pub mod shading;
mod statistics;
mod surface_buffers;
mod view;

pub use error::KeyleafError;
pub use grid::BaseGrid;
pub use keyleaf_key as key;
pub use keyleaf_surface as surface;
pub use passes::{Kind, Module, Passes, modules};
pub use quadtree::Quadtree;
pub use settings::{Balance, Metric, Settings};
pub use statistics::Statistics;
pub use view::{Frame, Projection, View};
pub use wgpu;
