//! Light and effects.

use glam::DVec3;
use serde::{Deserialize, Serialize};

/// The sun and the light of the sky. Colours are linear RGB.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Light {
    /// Where the sun stands, in degrees clockwise from north (-Z) towards east (+X), seen from above; default 140.
    pub azimuth: f64,
    /// How high it stands above the horizon, in degrees; -90..=90, default 35.
    pub elevation: f64,
    /// Colour and strength of the sun, each at least 0; default (2.6, 2.4, 2.1).
    pub colour: [f32; 3],
    /// Light from the whole sky, each at least 0; default (0.22, 0.27, 0.36).
    pub ambient: [f32; 3],
    /// Factor on all light before tone mapping, above 0; default 1.
    pub exposure: f32,
}

impl Default for Light {
    fn default() -> Self {
        Self {
            azimuth: 140.0,
            elevation: 35.0,
            colour: [2.6, 2.4, 2.1],
            ambient: [0.22, 0.27, 0.36],
            exposure: 1.0,
        }
    }
}

impl Light {
    /// Unit vector towards the sun (right-handed, Y up, north is -Z, east is +X).
    pub fn direction(&self) -> DVec3 {
        let (sin_azimuth, cos_azimuth) = self.azimuth.to_radians().sin_cos();
        let (sin_elevation, cos_elevation) = self.elevation.to_radians().sin_cos();
        DVec3::new(sin_azimuth * cos_elevation, sin_elevation, -cos_azimuth * cos_elevation)
    }
}

/// What is drawn besides the surfaces, or over them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Effect {
    /// A sky with the sun in it.
    Sky,
    /// Air that hides what is far.
    Fog(Fog),
    /// The edges of the drawn triangles.
    Wireframe,
    /// Leaves tinted by their level.
    LevelTint,
}

/// Air that hides what is far.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Fog {
    /// Distance in metres at which half of the colour is the fog's, above 0; default 50000.
    pub distance: f64,
    /// Linear RGB, each at least 0; default (0.55, 0.66, 0.82).
    pub colour: [f32; 3],
}

impl Default for Fog {
    fn default() -> Self {
        Self {
            distance: 50_000.0,
            colour: [0.55, 0.66, 0.82],
        }
    }
}
