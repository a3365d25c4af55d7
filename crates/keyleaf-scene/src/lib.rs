//! Scene and camera-path files, importers and exporters of keyleaf.
#![warn(missing_docs)]

pub mod error;
pub mod export;
pub mod heightmap;
pub mod material;
pub mod model;
pub mod note;
pub mod open;
pub mod path;
pub mod scene;
mod soup;
mod surfaces;
pub mod texture;
pub mod triangulate;
pub mod view;
mod weld;

pub use export::{ExportError, ExportMesh, write_mesh, write_whole};
pub use heightmap::{HeightMapFile, HeightMapOptions, read_height_map};
pub use model::{Model, ModelOptions, read_model};
pub use open::{OpenError, OpenOptions, OpenedScene, OpenedSurface, load_scene, open};
pub use path::Frame;
pub use scene::{Scene, SceneError};
pub use view::View;
pub use weld::MANY_FACES;

/// The largest coordinate of a model or a scene, in either direction: squares of distances stay finite in f32.
pub const MAX_COORDINATE: f64 = 1e15;
