//! Which candidate vertices are inserted: the three tests of thesis 3.2.2.

use crate::curve::Curve;
use crate::view::positive;
use crate::{BaselineError, Sampler, View};
use glam::DVec3;

/// When a candidate vertex V_B on the surface is inserted. V_S is the point of the coarse triangle below it.
///
/// Departure: the thesis gives thresholds of lengths in object units, one set a scene. Here they are in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Test {
    /// |V_S − V_B| is above a number of pixels. Asked for every candidate.
    Distance {
        /// The threshold.
        pixels: f64,
    },
    /// The cosine between the edge and the line from either of its ends to V_B is below a threshold. Asked for
    /// candidates on edges; their rows follow.
    ///
    /// Departure: V_B itself lies on the chord of an S-shaped edge. So two samples are tested, half a step before and
    /// half a step after the candidate.
    Flat {
        /// The threshold, from 0 to 1; nearer to 1 inserts more.
        cosine: f64,
    },
    /// V_S is farther than a number of pixels from both ends of the edge. Asked for candidates on edges; their rows
    /// follow.
    Length {
        /// The threshold.
        pixels: f64,
    },
}

impl Test {
    pub(crate) fn check(&self) -> Result<(), BaselineError> {
        match *self {
            Self::Distance { pixels } => not_negative("distance test", pixels),
            Self::Length { pixels } => not_negative("length test", pixels),
            Self::Flat { cosine } if (0.0..=1.0).contains(&cosine) => Ok(()),
            Self::Flat { cosine } => Err(BaselineError::Setting {
                name: "flat test",
                value: cosine,
                expected: "a cosine from 0 to 1",
            }),
        }
    }
}

/// How the adaptive methods refine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Which candidates are inserted.
    pub test: Test,
    /// The resolution of an edge is such that a segment has about this many pixels. 0: always the greatest.
    pub segment_pixels: f64,
    /// The greatest resolution L: an edge of a coarse triangle has at most L candidates. Up to [`MAX_RESOLUTION`].
    pub max_resolution: u32,
    /// Coarse cells a direction of a KSQuad, of two triangles each; the thesis has 3 (section 3.3). Up to 64.
    pub coarse_cells: u32,
}

/// The greatest resolution: the unified pattern then has lcm(1..=16) = 720,720 rows, and triangles hold at most 105
/// candidates inside.
pub const MAX_RESOLUTION: u32 = 15;

impl Settings {
    /// The pattern of the thesis, L_max = 3 on 3 × 3 cells: at most 16 × 18 triangles a patch (table 4.1).
    pub fn new(test: Test) -> Self {
        Self {
            test,
            segment_pixels: 0.0,
            max_resolution: 3,
            coarse_cells: 3,
        }
    }

    pub(crate) fn check(&self) -> Result<(), BaselineError> {
        self.test.check()?;
        not_negative("segment_pixels", self.segment_pixels)?;
        crate::view::within(
            "max_resolution",
            self.max_resolution,
            0..=MAX_RESOLUTION,
            "a resolution from 0 to 15",
        )?;
        crate::view::within("coarse_cells", self.coarse_cells, 1..=64, "1 to 64 cells")
    }

    /// The resolution L of an edge, from 0.
    pub(crate) fn resolution(&self, sampler: &dyn Sampler, view: &View, edge: &Curve) -> Result<u32, BaselineError> {
        if self.segment_pixels <= 0.0 {
            return Ok(self.max_resolution);
        }
        let segments = (edge.pixels(sampler, view)? / self.segment_pixels).ceil();
        Ok((segments as u32).saturating_sub(1).min(self.max_resolution))
    }
}

/// The candidates 1..=L of an edge that are inserted, of L + 1 segments. Depends on the edge alone.
pub(crate) fn inserted_on_edge(
    sampler: &dyn Sampler,
    view: &View,
    test: Test,
    edge: &Curve,
    resolution: u32,
) -> Result<Vec<u32>, BaselineError> {
    let step = 1.0 / f64::from(resolution + 1);
    let ends = [edge.point(sampler, 0.0)?, edge.point(sampler, 1.0)?];
    let radius = ends[0].distance(ends[1]) / 2.0;
    let mut inserted = Vec::new();
    for candidate in 1..=resolution {
        let t = f64::from(candidate) * step;
        let on_chord = ends[0].lerp(ends[1], t);
        let insert = match test {
            Test::Distance { pixels } => {
                let distance = on_chord.distance(edge.point(sampler, t)?);
                view.pixels_within(distance, on_chord, radius) > pixels
            }
            Test::Flat { cosine } => {
                let samples = [
                    edge.point(sampler, t - step / 2.0)?,
                    edge.point(sampler, t + step / 2.0)?,
                ];
                samples.into_iter().any(|sample| deviates(ends, sample, cosine))
            }
            Test::Length { pixels } => ends
                .into_iter()
                .all(|end| view.pixels_within(end.distance(on_chord), on_chord, radius) > pixels),
        };
        if insert {
            inserted.push(candidate);
        }
    }
    Ok(inserted)
}

/// The vector deviation test of thesis 3.2.2 for one sample. An edge whose ends coincide is not flat unless the sample
/// does too.
fn deviates([v1, v2]: [DVec3; 2], sample: DVec3, cosine: f64) -> bool {
    let along = (v1 - v2).normalize_or_zero();
    [sample - v1, sample - v2].into_iter().any(|to| {
        let to = to.normalize_or_zero();
        to != DVec3::ZERO && to.dot(along).abs() < cosine
    })
}

fn not_negative(name: &'static str, value: f64) -> Result<(), BaselineError> {
    if value == 0.0 { Ok(()) } else { positive(name, value) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flat_test_compares_both_ends() {
        let ends = [DVec3::ZERO, DVec3::X];
        assert!(!deviates(ends, DVec3::new(0.4, 0.0, 0.0), 0.999));
        assert!(deviates(ends, DVec3::new(0.4, 0.1, 0.0), 0.999));
        // Near one end the angle is small there but large at the other.
        assert!(deviates(ends, DVec3::new(0.99, 0.01, 0.0), 0.8));
        assert!(deviates([DVec3::X, DVec3::X], DVec3::Y, 0.5));
        assert!(!deviates([DVec3::X, DVec3::X], DVec3::X, 0.5));
    }
}
