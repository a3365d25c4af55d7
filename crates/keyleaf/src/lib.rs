//! keyleaf: adaptive level of detail on the GPU, every frame.
//!
//! For every root triangle of a coarse surface keyleaf keeps a *linear quadtree*: the list of its leaves, each a 64-bit key. Compute
//! passes split and merge leaves to the detail that the view needs; one indirect draw renders them through a surface evaluator. The
//! CPU never reads back to draw a frame. No frame cracks, whatever the metric and however the camera jumps.
//!
//! The library borrows device, queue and encoder; it submits nothing and waits for nothing (but in [`read_back`] and [`headless`],
//! which are for tools).
//!
//! # Example
//! An engine brings device, queue, encoder and render pass:
//!
//! ```no_run
//! use glam::{DAffine3, DVec3, UVec2};
//! use keyleaf::draw::{LeafDraw, LeafPipeline, Look, Target};
//! use keyleaf::shading::{Channel, Shading};
//! use keyleaf::surface::{Terrain, TerrainSettings};
//! use keyleaf::{Passes, Quadtree, Settings, View, wgpu};
//! use std::sync::Arc;
//!
//! # fn frame(device: &wgpu::Device, queue: &wgpu::Queue, target: Target, encoder: &mut wgpu::CommandEncoder,
//! #     mut begin: impl FnMut(&mut wgpu::CommandEncoder) -> wgpu::RenderPass<'static>) -> Result<(), Box<dyn std::error::Error>> {
//! // Once: a surface, its pipelines, its quadtree.
//! let surface = Arc::new(Terrain::new(TerrainSettings::default())?);
//! let settings = Settings::default();
//! let kind = Quadtree::kind(surface.as_ref(), &settings);
//! let passes = Arc::new(Passes::new(device, kind)?);
//! let mut quadtree = Quadtree::new(device, queue, passes, surface, DAffine3::IDENTITY, settings)?;
//! let channel = Channel::Colour(Default::default(), Default::default(), Default::default());
//! let pipeline = LeafPipeline::new(device, &kind, channel, target)?;
//! let mut draw = LeafDraw::new(device, queue, &pipeline, &quadtree, &Look::default());
//!
//! // Every frame: refine, then draw in a pass of one's own.
//! let view = View::look_at(DVec3::new(0.0, 2e4, 0.0), DVec3::new(5e4, 0.0, -5e4), 0.9, 1.0, UVec2::new(1280, 720));
//! quadtree.update(queue, encoder, &view);
//! draw.prepare(device, queue, &quadtree, &Shading::default());
//! let mut pass = begin(encoder);
//! draw.draw(&mut pass, &pipeline, &quadtree);
//! # Ok(())
//! # }
//! ```
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
mod buffers;
mod colour_texture;
pub mod draw;
mod error;
mod grid;
pub mod headless;
pub mod inspect;
pub mod layout;
pub mod map;
mod metric;
mod module;
mod passes;
mod posing;
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
pub use metric::{Metric, Threshold};
pub use passes::{Kind, Module, Passes, modules};
pub use quadtree::{Phase, Quadtree};
pub use settings::{BackFaces, Balance, Morph, Pairs, Settings};
pub use statistics::Statistics;
pub use view::{Frame, Projection, View};
pub use wgpu;
