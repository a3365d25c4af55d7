//! Curves on a surface along straight lines of its parameters: edges of cells and of coarse triangles.

use crate::cells::position;
use crate::{BaselineError, Sampler, View};
use glam::{DVec2, DVec3};

/// Chords that the length of a curve is measured by.
const CHORDS: u32 = 8;

/// A curve from one parameter to another. Its ends are what decisions on it may depend on, and nothing else.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Curve {
    pub surface: usize,
    pub from: DVec2,
    pub to: DVec2,
}

impl Curve {
    /// The point at `t` from 0 to 1.
    pub fn point(&self, sampler: &dyn Sampler, t: f64) -> Result<DVec3, BaselineError> {
        position(
            sampler,
            self.surface,
            if t >= 1.0 { self.to } else { self.from.lerp(self.to, t) },
        )
    }

    /// Its length in pixels, seen side-on.
    pub fn pixels(&self, sampler: &dyn Sampler, view: &View) -> Result<f64, BaselineError> {
        let mut before = self.point(sampler, 0.0)?;
        let mut pixels = 0.0;
        for k in 1..=CHORDS {
            let after = self.point(sampler, f64::from(k) / f64::from(CHORDS))?;
            pixels += view.pixels(before.distance(after), before.midpoint(after));
            before = after;
        }
        Ok(pixels)
    }
}
