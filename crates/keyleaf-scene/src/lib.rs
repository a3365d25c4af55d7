//! Scene and camera-path files, importers and exporters of keyleaf.
//!
//! [`open()`] takes what a user points at – a scene (`.ron`), a model, a file of patches or a height map – and gives an [`OpenedScene`]: surfaces
//! of `keyleaf-surface` with their materials and settings, at least one camera, and at least one camera path.
//!
//! | module | gives |
//! |---|---|
//! | [`scene`] | the scene file, documented field by field; errors with file, line, column and field |
//! | [`open`](mod@open) | opening scenes, models, patches and height maps |
//! | [`model`] | OBJ, glTF, PLY, STL, OFF: one welded [`PolygonMesh`](keyleaf_surface::PolygonMesh), one material; or a control mesh |
//! | [`patch`] | `.bpt`, Newell's tea set, OBJ free-form surfaces: Bézier and NURBS surfaces |
//! | [`heightmap`] | PNG, TIFF, EXR, raw: exact samples, voids filled |
//! | [`motion`] | the vertices of a moving control mesh at any time |
//! | [`path`], [`view`] | the camera at any time of a path; default views |
//! | [`export`] | triangles to OBJ, PLY, STL, bit by bit, whole files or none |
//! | [`triangulate`] | convexity and ear clipping of polygons |
//! | [`error`], [`note`] | what was refused and where; what was done and may surprise |
//!
//! World space is right-handed, Y up, north is -Z, in metres. Colours are linear, pictures are sRGB, v = 0 is the bottom of a
//! picture. Nothing is printed, and nothing panics, whatever the files hold.

mod control_surfaces;
mod curve;
pub mod error;
pub mod export;
pub mod heightmap;
pub mod material;
pub mod model;
pub mod motion;
pub mod note;
pub mod open;
pub mod patch;
mod patch_surfaces;
pub mod path;
pub mod scene;
mod soup;
mod surfaces;
pub mod texture;
pub mod triangulate;
pub mod view;
mod wavefront;
mod weld;

pub use control_surfaces::{ControlCage, PoseError};
pub use export::{ExportError, ExportMesh, write_mesh, write_whole};
pub use heightmap::{HeightMapFile, HeightMapOptions, read_height_map};
pub use model::{
    ControlMeshOptions, ControlModel, CovarianceSource, Model, ModelOptions, read_control_mesh, read_covariances,
    read_model,
};
pub use motion::CageMotion;
pub use open::{OpenError, OpenOptions, OpenedScene, OpenedSurface, load_scene, open};
pub use patch::{PatchFileOptions, PatchModel, read_patches};
pub use path::Frame;
pub use scene::{Scene, SceneError, ShapeName};
pub use view::View;
pub use weld::MANY_FACES;

/// The largest coordinate of a model or a scene, in either direction: squares of distances stay finite in f32.
pub const MAX_COORDINATE: f64 = 1e15;
