//! Quality levels, methods, and the thresholds that belong to them.

use crate::{BaselineError, Sampler, Settings, Tessellation, Test, View, dabt, semi_adaptive, uniform};
use std::fmt;

/// The levels of tables 3.1 and 4.1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Quality {
    /// Nearly every candidate is inserted.
    High,
    /// About half of them.
    Medium,
    /// About a quarter.
    Low,
}

/// One of the three tests of thesis 3.2.2, without its threshold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TestKind {
    /// See [`Test::Distance`].
    Distance,
    /// See [`Test::Flat`].
    Flat,
    /// See [`Test::Length`].
    Length,
}

/// What is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Method {
    /// [`uniform::per_surface`].
    UniformPerSurface,
    /// [`uniform::per_ks_quad`].
    UniformPerKsQuad,
    /// [`semi_adaptive::tessellate`].
    SemiAdaptive(TestKind),
    /// [`dabt::tessellate`].
    Dabt(TestKind),
}

impl Quality {
    /// All three, from high to low.
    pub const ALL: [Quality; 3] = [Quality::High, Quality::Medium, Quality::Low];

    /// The deviation in pixels that the distance test and uniform levels allow.
    ///
    /// Departure: tables 3.1 and 4.1 give triangles, not thresholds; these are chosen so that a pixel is visible from
    /// medium on. [`threshold_for_share`](crate::threshold_for_share) finds the thresholds of the tables instead.
    pub fn deviation_pixels(self) -> f64 {
        [0.25, 1.0, 4.0][self as usize]
    }

    /// The length in pixels of dices (µ of equation 6.8) and of the length test. The thesis has µ from 1 to 16.
    pub fn length_pixels(self) -> f64 {
        [4.0, 8.0, 16.0][self as usize]
    }

    /// The cosine below which the flat test inserts: of 1, 2 and 4 degrees.
    pub fn flat_cosine(self) -> f64 {
        let degrees: f64 = [1.0, 2.0, 4.0][self as usize];
        degrees.to_radians().cos()
    }

    /// The settings of the adaptive methods: L_max = 3 as in the tables, so at most 288 triangles a patch however near
    /// it is. To follow the surface closer, raise [`Settings::max_resolution`].
    pub fn settings(self, test: TestKind) -> Settings {
        let test = match test {
            TestKind::Distance => Test::Distance {
                pixels: self.deviation_pixels(),
            },
            TestKind::Flat => Test::Flat {
                cosine: self.flat_cosine(),
            },
            TestKind::Length => Test::Length {
                pixels: self.length_pixels(),
            },
        };
        Settings {
            segment_pixels: SEGMENT_PIXELS,
            ..Settings::new(test)
        }
    }

    /// Triangles relative to the full pattern of L_max = 3, as table 4.1 has them on the mean of its three scenes;
    /// `None` for uniform methods.
    pub fn share(self, method: Method) -> Option<f64> {
        let shares = match method {
            Method::SemiAdaptive(_) => [
                [0.9762, 0.9362, 0.8510],
                [0.5530, 0.5196, 0.5068],
                [0.2507, 0.2705, 0.3646],
            ],
            Method::Dabt(_) => [
                [0.9450, 0.9301, 0.9262],
                [0.5286, 0.5266, 0.5080],
                [0.2213, 0.2441, 0.2273],
            ],
            Method::UniformPerSurface | Method::UniformPerKsQuad => return None,
        };
        let scenes: [f64; 3] = shares[self as usize];
        Some(scenes.into_iter().sum::<f64>() / 3.0)
    }
}

impl Method {
    /// Both uniform methods, and both adaptive ones with each of the tests.
    pub const ALL: [Method; 8] = [
        Method::UniformPerSurface,
        Method::UniformPerKsQuad,
        Method::SemiAdaptive(TestKind::Distance),
        Method::SemiAdaptive(TestKind::Flat),
        Method::SemiAdaptive(TestKind::Length),
        Method::Dabt(TestKind::Distance),
        Method::Dabt(TestKind::Flat),
        Method::Dabt(TestKind::Length),
    ];

    /// Tessellates a model for a view at a quality.
    ///
    /// # Errors
    /// [`BaselineError`] if the model or the view is at fault.
    pub fn tessellate(
        self,
        sampler: &dyn Sampler,
        view: &View,
        quality: Quality,
    ) -> Result<Tessellation, BaselineError> {
        match self {
            Self::UniformPerSurface => uniform::per_surface(sampler, view, quality.deviation_pixels(), UNIFORM_LEVEL),
            Self::UniformPerKsQuad => uniform::per_ks_quad(sampler, view, quality.length_pixels()),
            Self::SemiAdaptive(test) => semi_adaptive::tessellate(sampler, view, &quality.settings(test)),
            Self::Dabt(test) => dabt::tessellate(sampler, view, &quality.settings(test)),
        }
    }
}

/// The size of segments that resolutions are chosen by, alike at all qualities, so that coarser ones insert fewer of
/// the same candidates.
const SEGMENT_PIXELS: f64 = 4.0;
/// The finest level of uniform surfaces in comparisons, as in table 2.1: 127 segments.
const UNIFORM_LEVEL: u32 = 6;

impl fmt::Display for Quality {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(["high", "medium", "low"][*self as usize])
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = |test: &TestKind| ["distance", "flat", "length"][*test as usize];
        match self {
            Self::UniformPerSurface => f.pad("uniform per surface"),
            Self::UniformPerKsQuad => f.pad("uniform per KSQuad"),
            Self::SemiAdaptive(test) => f.pad(&format!("semi-adaptive, {} test", name(test))),
            Self::Dabt(test) => f.pad(&format!("DABT, {} test", name(test))),
        }
    }
}
