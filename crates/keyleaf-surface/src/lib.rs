//! Surfaces in f64, their bounds, and the tables that keyleaf's shaders read.
//!
//! # Theory
//!
//! A surface maps every point of the faces of a [`Topology`](keyleaf_key::Topology) to a position in object space. It has two
//! twins of the same name: a type of this crate, in f64, which is the truth, and a WGSL file, which is what is drawn. Both answer
//! the three questions of [`Surface`]: the position of a point, its frame (derivatives and unit normal), and bounds of the
//! *diamond* of a leaf, by which the update decides and culls.
//!
//! | type | WGSL | what it is |
//! |---|---|---|
//! | [`Mesh`] | `surfaces/mesh.wgsl` | flat polygons: bilinear quads, triangles, fans |
//! | [`DisplacedTexture`] | `surfaces/displaced_texture.wgsl` | a mesh moved along its smooth normals by a texture |
//! | [`DisplacedNoise`] | `surfaces/displaced_noise.wgsl` | the same by fractal noise of the position |
//! | [`HeightField`] | `surfaces/height_field.wgsl`, `…_bilinear.wgsl` | a height map over a rectangle |
//! | [`Subdivision`] | `surfaces/catmull_clark.wgsl`, `surfaces/loop.wgsl` | Catmull-Clark and Loop subdivision surfaces |
//! | [`GaussianProduct`] | `surfaces/gaussian_catmull_clark.wgsl`, `surfaces/gaussian_loop.wgsl` | subdivision surfaces of Gaussians |
//! | [`Patches`] | `surfaces/bezier*.wgsl`, `surfaces/nurbs*.wgsl` | Bézier and NURBS surfaces, joined where their boundaries meet |
//! | [`TrianglePatches`] | `surfaces/qas.wgsl`, `surfaces/pn.wgsl` | QAS and PN triangles: a small patch a triangle |
//! | [`Terrain`] | `surfaces/terrain.wgsl` | a procedural terrain over a fixed square |
//!
//! # Practice
//!
//! *Same bits.* A point on a mesh edge or a spoke has several addresses. The shaders first choose their operands by what the point
//! is – the vertices of the edge in a fixed order, the owner's texture coordinates – and then evaluate one shared expression, so
//! that all addresses give the same bits (ARCHITECTURE section 3).
//!
//! *Origin.* [`Surface::tables`] are made for an origin in object space. Near it, f32 positions are exact to 2⁻²⁴ of the distance
//! for maps and terrain, whose parameters are subtracted in integers; for meshes to 2⁻²⁴ of the farthest corner of the face.
//!
//! *Nested bounds.* [`SurfaceBound::size`] at least halves from parent to child, and guard balls hold those of the children.

mod coordinate;
mod diamond;
mod direction;
mod displaced;
mod displaced_noise;
mod displaced_texture;
mod error;
pub mod gaussian;
mod geomorph;
mod height_bounds;
mod height_field;
mod height_map;
mod interpolation;
mod map;
mod mesh;
mod metric;
mod noise;
mod patches;
mod polygon_mesh;
mod pose;
mod quad_coord;
mod quadratic;
mod root_bound;
mod stencil;
mod subdivision;
mod surface;
mod terrain;

pub use coordinate::root_point;
pub use displaced_noise::{DisplacedNoise, NoiseDisplacement};
pub use displaced_texture::{DisplacedTexture, TextureDisplacement};
pub use error::{HeightMapError, MeshError, ParameterError, SettingError};
pub use gaussian::{GaussianProduct, GaussianSettings};
pub use geomorph::{Geomorph, Insertion};
pub use height_field::{HeightField, HeightFieldSettings};
pub use height_map::{HeightMap, MAX_MAP_SIDE};
pub use interpolation::Interpolation;
pub use mesh::Mesh;
pub use metric::MetricSize;
pub use patches::{
    BasisMethod, Boundary, JoinReport, NurbsSurface, PatchError, PatchKind, PatchSettings, Patches, Pole, Side,
    Unjoined,
};
pub use polygon_mesh::{CornerAttributes, Faces, PolygonMesh};
pub use pose::{PoseDispatch, PoseShader, PoseTables};
pub use quadratic::{CornerNormals, LimitSample, LimitSamples, LoopWeights, TrianglePatchError, TrianglePatches};
pub use subdivision::{
    BoundaryRule, ControlMesh, Corner, Crease, Creasing, INFINITE_SHARPNESS, Subdivision, SubdivisionError,
    SubdivisionScheme, SubdivisionSettings,
};
pub use surface::{OwnCoord, Surface, SurfaceBound, SurfaceFrame, SurfaceTables, TextureData};
pub use terrain::{Terrain, TerrainSettings};
