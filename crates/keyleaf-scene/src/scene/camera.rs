//! Named cameras and camera paths, as a file has them. How a path is flown: [`crate::path`].

use serde::{Deserialize, Serialize};

/// A view with a name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename = "Camera", deny_unknown_fields)]
pub struct NamedCamera {
    /// Unique among the cameras.
    pub name: String,
    /// Position in metres.
    pub eye: [f64; 3],
    /// The point in the middle of the picture; not the eye.
    pub look_at: [f64; 3],
    /// Vertical angle of view in degrees; above 0 and below 180, default 50.
    #[serde(default = "default_fov")]
    pub fov: f64,
    /// Distance of the near plane in metres, above 0; default `None`: chosen by the distance to look_at.
    #[serde(default)]
    pub near: Option<f64>,
}

/// A camera path: keys in the order of their times.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename = "Path", deny_unknown_fields)]
pub struct CameraPath {
    /// Unique among the paths.
    pub name: String,
    /// At least one key; times increase.
    pub keys: Vec<PathKey>,
    /// Whether it begins again after its last key; if the first and the last key have the same view, smoothly.
    /// Default false: it stays at the last key.
    #[serde(default)]
    pub looped: bool,
    /// Distance of the near plane in metres, above 0; default `None`: chosen by the distance to look_at.
    #[serde(default)]
    pub near: Option<f64>,
}

/// A view at a time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename = "Key", deny_unknown_fields)]
pub struct PathKey {
    /// Seconds; later than the key before.
    pub time: f64,
    /// Position in metres.
    pub eye: [f64; 3],
    /// The point in the middle of the picture; not the eye.
    pub look_at: [f64; 3],
    /// Vertical angle of view in degrees; above 0 and below 180, default 50.
    #[serde(default = "default_fov")]
    pub fov: f64,
    /// How the time runs from this key to the next. Default `Linear`.
    #[serde(default)]
    pub ease: Ease,
    /// Whether the camera jumps here at `time`, from the view of the key before. Default false.
    #[serde(default)]
    pub cut: bool,
}

/// How the time runs between two keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Ease {
    /// Evenly: the camera passes through the keys along a smooth curve (Catmull-Rom).
    #[default]
    Linear,
    /// Slowly at both ends: the camera comes to rest at both keys.
    Smooth,
}

/// Vertical angle of view where a file gives none, in degrees.
pub const DEFAULT_FOV: f64 = 50.0;

fn default_fov() -> f64 {
    DEFAULT_FOV
}
