//! Control meshes that move: keyed transforms of groups of vertices, and blend shapes.
//!
//! ```
//! # let text = r#"(surfaces: [(
//! #   name: "figure", source: Mesh("figure.obj"), surface: CatmullClark(),
//! motion: Keys([
//!     Blend(path: "breath.obj", looped: true, keys: [(time: 0), (time: 1, weight: 1), (time: 2)]),
//!     Group(name: "thigh", vertices: [(8, 15)], pivot: (0, 1, 0), looped: true, keys: [
//!         (time: 0, rotation: (-25, 0, 0)),
//!         (time: 1, rotation: (25, 0, 0)),
//!         (time: 2, rotation: (-25, 0, 0)),
//!     ]),
//!     Group(name: "shin", parent: "thigh", vertices: [(16, 31)], pivot: (0, 0.5, 0)),
//! ]),
//! # )])"#;
//! # assert!(keyleaf_scene::Scene::from_ron(text, "figure.ron".as_ref()).is_ok());
//! ```

use serde::{Deserialize, Serialize};

use super::camera::Ease;

/// How a control mesh moves.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub enum Motion {
    /// It does not.
    #[default]
    Still,
    /// By tracks of keys. First all blend shapes are added, then the groups are transformed.
    Keys(Vec<Track>),
}

/// What moves vertices.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Track {
    /// A transform of some vertices.
    Group(GroupTrack),
    /// A blend towards another shape of all vertices.
    Blend(BlendTrack),
}

/// A transform of some vertices, over time. A vertex of several groups goes to the mean of where they move it, so that a vertex of
/// a joint can belong to both sides of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GroupTrack {
    /// Unique among the groups of the surface.
    pub name: String,
    /// A group that carries this one along, named before it; default `None`.
    #[serde(default)]
    pub parent: Option<String>,
    /// Ranges of vertices, counted from 0: first and last of each. Default: none, a joint for others to hang on.
    #[serde(default)]
    pub vertices: Vec<(u32, u32)>,
    /// The point that rotation and scale leave where it is, at rest; default (0, 0, 0).
    #[serde(default)]
    pub pivot: [f64; 3],
    /// Times increase. Default: none, at rest but for the parent.
    #[serde(default)]
    pub keys: Vec<TransformKey>,
    /// Whether it begins again after its last key; smoothly if that is as the first key, or a whole turn further. Default false: it stays
    /// at the last key.
    #[serde(default)]
    pub looped: bool,
}

/// A transform at a time: scaled and turned about the pivot, then moved; all relative to the parent.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TransformKey {
    /// Seconds; later than the key before.
    pub time: f64,
    /// Default (0, 0, 0).
    #[serde(default)]
    pub translation: [f64; 3],
    /// Degrees about X, then about Y, then about Z, all fixed axes; default (0, 0, 0). The numbers run from key to key: from 0 to 360 is
    /// a whole turn.
    #[serde(default)]
    pub rotation: [f64; 3],
    /// Factor of all directions, above 0; default 1.
    #[serde(default = "one")]
    pub scale: f64,
    /// How the time runs from this key to the next. Default `Linear`.
    #[serde(default)]
    pub ease: Ease,
}

/// A blend towards another shape, over time: weight times the way from rest to there is added to each vertex.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BlendTrack {
    /// A model with the same vertices in the same order, elsewhere; relative to the scene's folder. Its faces are not read.
    pub path: String,
    /// At least one; times increase.
    pub keys: Vec<WeightKey>,
    /// Whether it begins again after its last key. Default false: it stays at the last key.
    #[serde(default)]
    pub looped: bool,
}

/// A weight at a time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WeightKey {
    /// Seconds; later than the key before.
    pub time: f64,
    /// 0 is at rest, 1 is there; any number, default 0.
    #[serde(default)]
    pub weight: f64,
    /// How the time runs from this key to the next. Default `Linear`.
    #[serde(default)]
    pub ease: Ease,
}

fn one() -> f64 {
    1.0
}
