//! From lengths to pixels.

use crate::BaselineError;
use glam::DVec3;

/// From where, and how finely, a model is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Where the eye is.
    pub eye: DVec3,
    /// Pixels a radian at the middle of the image: half its height in pixels over the tangent of half the vertical
    /// field of view.
    pub pixels_per_radian: f64,
    /// Nothing counts as nearer than this.
    pub near: f64,
}

impl View {
    /// The size in pixels of a length that is seen side-on at a point: an upper bound of its projection.
    pub fn pixels(&self, length: f64, at: DVec3) -> f64 {
        self.pixels_within(length, at, 0.0)
    }

    /// The same anywhere in the ball of `radius` about the point: |V_S − V_B| / (d_v − r_v) of thesis 4.2, in pixels.
    pub fn pixels_within(&self, length: f64, at: DVec3, radius: f64) -> f64 {
        length * self.pixels_per_radian / (at.distance(self.eye) - radius).max(self.near)
    }

    pub(crate) fn check(&self) -> Result<(), BaselineError> {
        if !self.eye.is_finite() {
            return Err(BaselineError::Setting {
                name: "eye",
                value: f64::NAN,
                expected: "finite coordinates",
            });
        }
        positive("pixels_per_radian", self.pixels_per_radian)?;
        positive("near", self.near)
    }
}

/// Refuses what is not a finite number above 0.
pub(crate) fn positive(name: &'static str, value: f64) -> Result<(), BaselineError> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(BaselineError::Setting {
            name,
            value,
            expected: "a finite number above 0",
        })
    }
}

/// Refuses what is not in a range of whole numbers.
pub(crate) fn within(
    name: &'static str,
    value: u32,
    range: std::ops::RangeInclusive<u32>,
    expected: &'static str,
) -> Result<(), BaselineError> {
    if range.contains(&value) {
        Ok(())
    } else {
        Err(BaselineError::Setting {
            name,
            value: f64::from(value),
            expected,
        })
    }
}
