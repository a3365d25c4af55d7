//! Scene files (RON): what is drawn, how finely, in which light, and from where.
//!
//! Every field but names, sources, keys and the like has a default, unknown fields are errors, and every error names
//! file, line, column, field and what was expected ([`SceneError`]). `Some(...)` may be left out.
//!
//! ```
//! let text = r#"
//! Scene(
//!     surfaces: [
//!         Surface(
//!             name: "hills",
//!             source: Terrain(height: 900.0, octaves: 14),
//!             material: (colouring: Terrain()),
//!         ),
//!     ],
//!     settings: (metric: Edge(pixels: 6.0), capacity: 400000),
//!     cameras: [(name: "start", eye: (0, 1500, 0), look_at: (4000, 500, -9000))],
//!     paths: [(
//!         name: "flight",
//!         keys: [
//!             (time: 0, eye: (0, 1500, 0), look_at: (0, 900, -9000)),
//!             (time: 5, eye: (0, 1400, -4000), look_at: (0, 900, -9000), ease: Linear),
//!             (time: 6, eye: (90000, 1400, 0), look_at: (0, 900, 0), cut: true),
//!         ],
//!     )],
//! )
//! "#;
//! let scene = keyleaf_scene::Scene::from_ron(text, "hills.ron".as_ref())?;
//! assert_eq!(scene.settings.base_grid, 2);
//! assert_eq!(keyleaf_scene::Scene::from_ron(&scene.to_ron()?, "hills.ron".as_ref())?, scene);
//! # Ok::<(), keyleaf_scene::SceneError>(())
//! ```

mod camera;
mod control_point;
mod error;
mod light;
mod locate;
mod motion;
mod patches;
#[cfg(test)]
mod patches_tests;
mod settings;
mod shape_name;
mod subdivision;
#[cfg(test)]
mod subdivision_tests;
mod surface;
#[cfg(test)]
mod tests;
mod validate;
mod validate_patches;
mod validate_shape;

use std::path::Path;

use ron::extensions::Extensions;
use serde::{Deserialize, Serialize};

pub use camera::{CameraPath, DEFAULT_FOV, Ease, NamedCamera, PathKey};
pub use control_point::ControlPoint;
pub use error::SceneError;
pub(crate) use error::{Problem, reference};
pub use light::{Effect, Fog, Light};
pub use motion::{BlendTrack, GroupTrack, Motion, Track, TransformKey, WeightKey};
pub(crate) use patches::bezier_surface;
pub use patches::{Basis, BezierSource, NurbsPatch, NurbsSource, PatchesSource};
pub use settings::{BackFaces, Culling, GuardBand, Metric, Morph, Pairs, Settings, SettingsOverrides, Threshold};
pub use shape_name::{ShapeName, UnknownShape};
pub use subdivision::{
    Boundary, Covariances, CreaseMethod, GaussianScheme, GaussianShape, LoopShape, LoopWeights, NormalCovariances,
    QasShape, QasVariant, Sharpness, Solver, SubdivisionShape,
};
pub use surface::{
    Colouring, DisplacedSource, DisplacementHeight, HeightFieldSource, Interpolation, Material, NoiseHeight, Shape,
    Source, SurfaceEntry, TerrainColours, TerrainSource, TextureHeight, Transform,
};

/// A scene file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// What is drawn; at least one surface.
    pub surfaces: Vec<SurfaceEntry>,
    /// How finely, and within which limits.
    #[serde(default)]
    pub settings: Settings,
    /// The sun and the light of the sky.
    #[serde(default)]
    pub light: Light,
    /// What is drawn besides the surfaces, or over them. Default: `[Sky]`. What is not named costs nothing.
    #[serde(default = "Scene::default_effects")]
    pub effects: Vec<Effect>,
    /// Named views. The first is the one that is shown; default: one that sees all of the scene.
    #[serde(default)]
    pub cameras: Vec<NamedCamera>,
    /// Camera paths. The first is the one that is flown; default: one with a fly-in, a fast turn and a teleport.
    #[serde(default)]
    pub paths: Vec<CameraPath>,
}

impl Scene {
    /// The effects of a scene that names none.
    pub fn default_effects() -> Vec<Effect> {
        vec![Effect::Sky]
    }

    /// Reads a scene file and checks it, but not yet the files that it refers to.
    ///
    /// # Errors
    /// [`SceneError`]: the file cannot be read, is no scene, or holds a value out of range.
    pub fn read(file: &Path) -> Result<Self, SceneError> {
        let text = std::fs::read_to_string(file).map_err(|source| SceneError::Read {
            file: file.to_path_buf(),
            source,
        })?;
        Self::from_ron(&text, file)
    }

    /// Reads a scene from its text; `file` names it in errors.
    ///
    /// # Errors
    /// [`SceneError`]: the text is no scene, or holds a value out of range.
    pub fn from_ron(text: &str, file: &Path) -> Result<Self, SceneError> {
        let scene: Self = options()
            .from_str(text)
            .map_err(|error| error::syntax(file, text, &error))?;
        validate::validate(&scene).map_err(|problem| problem.at(file, text))?;
        Ok(scene)
    }

    /// The scene as the text of a scene file, with every field.
    ///
    /// # Errors
    /// [`SceneError::Write`] if a number has no RON form; not for a scene that was read or opened.
    pub fn to_ron(&self) -> Result<String, SceneError> {
        let pretty = ron::ser::PrettyConfig::new().struct_names(false).compact_arrays(false);
        options()
            .to_string_pretty(self, pretty)
            .map_err(|error| SceneError::Write {
                reason: error.to_string(),
            })
    }

    /// Checks a scene that was made in code, as [`Scene::from_ron`] checks one from a file.
    ///
    /// # Errors
    /// [`SceneError::Invalid`] names the field and what was expected.
    pub fn validate(&self, file: &Path) -> Result<(), SceneError> {
        validate::validate(self).map_err(|problem| problem.at(file, ""))
    }
}

impl CameraPath {
    /// Reads a path from the text of a path file: what a scene has in its list of paths.
    ///
    /// # Errors
    /// [`SceneError`]: the text is no path, or holds a value out of range.
    pub fn from_ron(text: &str, file: &Path) -> Result<Self, SceneError> {
        let path: Self = options()
            .from_str(text)
            .map_err(|error| error::syntax(file, text, &error))?;
        validate::validate_path(&path).map_err(|problem| problem.at(file, text))?;
        Ok(path)
    }

    /// The path as the text of a path file, with every field.
    ///
    /// # Errors
    /// [`SceneError::Write`] if a number has no RON form.
    pub fn to_ron(&self) -> Result<String, SceneError> {
        let pretty = ron::ser::PrettyConfig::new().struct_names(false).compact_arrays(true);
        let text = options().to_string_pretty(self, pretty);
        text.map_err(|error| SceneError::Write {
            reason: error.to_string(),
        })
    }
}

/// `Some` may be left out, and an enum's struct needs no second pair of parentheses.
fn options() -> ron::Options {
    ron::Options::default()
        .with_default_extension(Extensions::IMPLICIT_SOME)
        .with_default_extension(Extensions::UNWRAP_VARIANT_NEWTYPES)
}
