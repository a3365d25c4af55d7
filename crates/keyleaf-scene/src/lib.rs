//! Scene and camera-path files, importers and exporters of keyleaf.
#![warn(missing_docs)]

pub mod error;
pub mod heightmap;
pub mod material;
pub mod mesh;
pub mod model;
pub mod note;
pub mod scene;
mod soup;
pub mod texture;
pub mod triangulate;
mod weld;

pub use heightmap::{HeightMap, HeightMapOptions, read_height_map};
pub use model::{Model, read_model};
pub use scene::{Scene, SceneError};
pub use weld::MANY_FACES;

/// The largest coordinate of a model or a scene, in either direction: squares of distances stay finite in f32.
pub const MAX_COORDINATE: f64 = 1e15;
