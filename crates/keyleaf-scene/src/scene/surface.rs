//! The surfaces of a scene: where they come from, how they are shaped, placed and coloured.

use glam::{DMat4, DQuat, DVec3, EulerRot};
use keyleaf_surface::TerrainSettings;
use serde::{Deserialize, Serialize};

use super::motion::Motion;
use super::patches::{BezierSource, NurbsSource, PatchesSource};
use super::settings::SettingsOverrides;
use super::subdivision::{GaussianShape, LoopShape, QasShape, SubdivisionShape};

/// One surface of a scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename = "Surface", deny_unknown_fields)]
pub struct SurfaceEntry {
    /// Unique among the surfaces.
    pub name: String,
    /// Where its control data come from.
    pub source: Source,
    /// How a mesh is shaped; only `Flat` for the other sources. Default `Flat`.
    #[serde(default)]
    pub surface: Shape,
    /// How its control mesh moves. Default `Still`.
    #[serde(default)]
    pub motion: Motion,
    /// Where it stands.
    #[serde(default)]
    pub transform: Transform,
    /// How it is coloured.
    #[serde(default)]
    pub material: Material,
    /// What differs from the scene's settings.
    #[serde(default)]
    pub settings: SettingsOverrides,
}

/// Where the control data of a surface come from. Paths are relative to the folder of the scene file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Source {
    /// A model of polygons: .obj, .gltf, .glb, .ply, .stl, .off.
    Mesh(String),
    /// A height map: .png, .tif, .exr, .r16.
    HeightField(HeightFieldSource),
    /// Procedural terrain.
    Terrain(TerrainSource),
    /// A file of Bézier or NURBS surfaces: .bpt, .obj with `surf`, Newell's tea set.
    Patches(PatchesSource),
    /// NURBS surfaces, written here.
    Nurbs(NurbsSource),
    /// Bézier patches, written here.
    Bezier(BezierSource),
}

/// A height map over the rectangle (0..width, -depth..0) of the XZ plane: east is +X, north is -Z.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HeightFieldSource {
    /// The file.
    pub path: String,
    /// Distance of samples in metres, east and north, each above 0; default `None`: as the map's sidecar says, else
    /// so that the relief is a sixth of the larger side.
    #[serde(default)]
    pub spacing: Option<[f64; 2]>,
    /// Metres of one unit of the samples, not 0; default 1.
    #[serde(default = "one")]
    pub scale: f64,
    /// Metres added to all heights; default 0.
    #[serde(default)]
    pub offset: f64,
    /// Between samples. Default `Bicubic`.
    #[serde(default)]
    pub interpolation: Interpolation,
    /// A sample value that means "not known"; default `None`: only what is recognised.
    #[serde(default)]
    pub void_value: Option<f32>,
    /// Width and height of a raw file in samples; default `None`: a square.
    #[serde(default)]
    pub raw_size: Option<[u32; 2]>,
}

impl HeightFieldSource {
    /// A map with defaults for all but its path.
    pub fn new(path: impl Into<String>) -> Self {
        Self {
            path: path.into(),
            spacing: None,
            scale: 1.0,
            offset: 0.0,
            interpolation: Interpolation::default(),
            void_value: None,
            raw_size: None,
        }
    }
}

/// How heights run between samples; all go through the samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Interpolation {
    /// Catmull-Rom: smooth slopes.
    #[default]
    Bicubic,
    /// Flat slopes with creases at the samples.
    Bilinear,
}

/// Procedural terrain over the square (0..extent, -extent..0) of the XZ plane.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TerrainSource {
    /// Side of the square in metres, above 0; default 10⁷.
    pub extent: f64,
    /// All heights lie within ± this many metres, most within a third of it; above 0, default 6000.
    pub height: f64,
    /// The first octave has 2 to the power of this cells along a side; 1..=28, default 7 (78 km).
    pub first_level: u32,
    /// Number of octaves, each with half the cells' length of the one before; at least 1, with `first_level` at most
    /// 29; default 17.
    pub octaves: u32,
    /// Amplitude of an octave over that of the one before; 0..=1, default 0.5.
    pub gain: f64,
    /// 0: rolling hills; 1: sharp ridges. Default 0.7.
    pub ridged: f64,
    /// 0: as rough everywhere; 1: smooth valleys, rough heights. Default 0.8.
    pub contrast: f64,
    /// Any number; another one is another terrain. Default 1.
    pub seed: u32,
}

impl Default for TerrainSource {
    fn default() -> Self {
        let TerrainSettings {
            extent,
            height,
            first_level,
            octaves,
            gain,
            ridged,
            contrast,
            seed,
        } = TerrainSettings::default();
        Self {
            extent,
            height,
            first_level,
            octaves,
            gain,
            ridged,
            contrast,
            seed,
        }
    }
}

impl From<&TerrainSource> for TerrainSettings {
    fn from(source: &TerrainSource) -> Self {
        let &TerrainSource {
            extent,
            height,
            first_level,
            octaves,
            gain,
            ridged,
            contrast,
            seed,
        } = source;
        Self {
            extent,
            height,
            first_level,
            octaves,
            gain,
            ridged,
            contrast,
            seed,
        }
    }
}

/// How a mesh is shaped.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub enum Shape {
    /// As its polygons are.
    #[default]
    Flat,
    /// Its polygons, moved along smooth normals.
    Displaced(DisplacedSource),
    /// The Catmull-Clark surface of its polygons.
    CatmullClark(SubdivisionShape),
    /// The Loop surface of its triangles.
    Loop(LoopShape),
    /// A quadratic patch a triangle that follows a Loop or a butterfly surface.
    Qas(QasShape),
    /// A cubic patch a triangle through its vertices, with its normals (Vlachos et al. 2001).
    PnTriangles,
    /// The Gaussian-product surface of its polygons.
    GaussianProduct(GaussianShape),
}

impl Shape {
    /// The name of the variant, as a scene writes it.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Flat => "Flat",
            Self::Displaced(_) => "Displaced",
            Self::CatmullClark(_) => "CatmullClark",
            Self::Loop(_) => "Loop",
            Self::Qas(_) => "Qas",
            Self::PnTriangles => "PnTriangles",
            Self::GaussianProduct(_) => "GaussianProduct",
        }
    }
}

/// A displacement.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DisplacedSource {
    /// How far each point is moved.
    pub height: DisplacementHeight,
}

/// How far each point of a displaced mesh is moved.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum DisplacementHeight {
    /// By a picture, looked up with the texture coordinates of the corners.
    Texture(TextureHeight),
    /// By noise of the position.
    Noise(NoiseHeight),
}

/// Displacement by a picture.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TextureHeight {
    /// The file, read like a height map but scaled: integers to 0..1, floats as they are.
    pub path: String,
    /// Metres for a sample of 1, not 0.
    pub amplitude: f64,
    /// The sample that moves nothing; default 0.
    #[serde(default)]
    pub middle: f64,
    /// Whether the picture repeats outside the unit square of texture coordinates; else its rim goes on. Default true.
    #[serde(default = "yes")]
    pub repeats: bool,
}

/// Displacement by noise.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NoiseHeight {
    /// Height of the first octave in metres, not 0.
    pub amplitude: f64,
    /// Size of the features of the first octave in metres, above 0.
    pub wavelength: f64,
    /// Number of octaves, each with half the wavelength of the one before; 1..=16, default 5.
    #[serde(default = "five")]
    pub octaves: u32,
    /// Amplitude of an octave over that of the one before; 0..=1, default 0.5.
    #[serde(default = "half")]
    pub gain: f64,
    /// Any number; another one is another noise. Default 1.
    #[serde(default = "first_seed")]
    pub seed: u32,
}

/// Where a surface stands: scaled, then turned, then moved.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Transform {
    /// Metres; default (0, 0, 0).
    pub translation: [f64; 3],
    /// Degrees about X, then about Y, then about Z, all fixed axes; default (0, 0, 0).
    pub rotation: [f64; 3],
    /// Factor of all directions, above 0; default 1.
    pub scale: f64,
}

impl Default for Transform {
    fn default() -> Self {
        Self {
            translation: [0.0; 3],
            rotation: [0.0; 3],
            scale: 1.0,
        }
    }
}

impl Transform {
    /// `world_from_object`.
    pub fn matrix(&self) -> DMat4 {
        let [x, y, z] = self.rotation.map(f64::to_radians);
        let rotation = DQuat::from_euler(EulerRot::ZYX, z, y, x);
        DMat4::from_scale_rotation_translation(DVec3::splat(self.scale), rotation, self.translation.into())
    }
}

/// How a surface is coloured. Colours are linear RGB, each 0..1.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Material {
    /// Multiplies the other colours; default `None`: white, or (0.45, 0.45, 0.45) where there are no other colours.
    pub base_colour: Option<[f32; 3]>,
    /// A picture in place of the model's own, relative to the scene's folder. Needs texture coordinates; a height
    /// field and a terrain have (0..1) over the whole, Bézier and NURBS surfaces none.
    pub texture: Option<String>,
    /// A picture of a lit sphere that fills it, looked up by the normal in view space in place of the scene's light, relative to the
    /// scene's folder; multiplied with the other colours. Not together with a texture or a colouring. Default `None`.
    pub matcap: Option<String>,
    /// Whether colours at the corners of the model are used, also those of several materials. Default true.
    pub vertex_colours: bool,
    /// What is added by shape. Default `Plain`.
    pub colouring: Colouring,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            base_colour: None,
            texture: None,
            matcap: None,
            vertex_colours: true,
            colouring: Colouring::Plain,
        }
    }
}

/// Colours that follow the shape.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub enum Colouring {
    /// None.
    #[default]
    Plain,
    /// By slope and height.
    Terrain(TerrainColours),
}

/// Colours by slope and height: `low` to `high` by height, `steep` on slopes, `snow` on top.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TerrainColours {
    /// Linear RGB of the lowest ground; default (0.13, 0.19, 0.06).
    pub low: [f32; 3],
    /// Linear RGB of the highest ground; default (0.30, 0.25, 0.16).
    pub high: [f32; 3],
    /// Linear RGB of steep ground; default (0.22, 0.20, 0.18).
    pub steep: [f32; 3],
    /// Linear RGB of snow; default (0.85, 0.88, 0.93).
    pub snow: [f32; 3],
    /// Lowest and highest ground in metres, first below second; default `None`: of the surface.
    pub heights: Option<[f64; 2]>,
    /// Metres above which there is snow; default `None`: at 70 % of `heights`.
    pub snow_line: Option<f64>,
    /// Slopes in degrees at which ground begins to be steep, and is; 0..=90, first below second, default (25, 42).
    pub slopes: [f64; 2],
}

impl Default for TerrainColours {
    fn default() -> Self {
        Self {
            low: [0.13, 0.19, 0.06],
            high: [0.30, 0.25, 0.16],
            steep: [0.22, 0.20, 0.18],
            snow: [0.85, 0.88, 0.93],
            heights: None,
            snow_line: None,
            slopes: [25.0, 42.0],
        }
    }
}

fn yes() -> bool {
    true
}

fn one() -> f64 {
    1.0
}

fn half() -> f64 {
    0.5
}

fn five() -> u32 {
    5
}

fn first_seed() -> u32 {
    1
}
