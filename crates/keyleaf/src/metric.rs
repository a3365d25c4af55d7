//! When leaves split, and by which shader that is found.

use keyleaf_surface::MetricSize;

/// When a leaf is too coarse.
///
/// Of a metric that is not [nested](Metric::is_nested), the settled leaves can depend on what the camera saw before; there is no crack
/// with any.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Metric {
    /// Screen space: no drawn edge of more than so many pixels (ARCHITECTURE section 3). Measured at the surface's largest stretch and
    /// face on, so that the mean edge is shorter.
    Edge {
        /// The target, in pixels of the drawn edge (a leaf's is 2^base_grid times it).
        pixels: f32,
    },
    /// Khoury 2.1: level = -log2(distance tan(fovy / 2) / (sqrt 2 factor)), whatever the length of the edge.
    Distance {
        /// The factor, in world units: doubling it adds a level.
        factor: f32,
    },
    /// Screen space: no drawn triangle farther from the surface than so many pixels, by bounds of second derivatives, and of first ones
    /// where those are large. Flat parts stay coarse. Surfaces without such bounds (height fields, noise) count with their edges.
    Deviation {
        /// The target in pixels.
        pixels: f32,
    },
    /// [`Metric::Edge`] with another target at open boundaries (Concheiro 6.10, boundary region).
    Boundary {
        /// The target in pixels elsewhere.
        pixels: f32,
        /// The target at open boundaries.
        boundary_pixels: f32,
    },
    /// The size of the face on the screen, evenly divided (Concheiro 6.8, local area average).
    LocalArea {
        /// The target in pixels of the drawn edge.
        pixels: f32,
    },
    /// The sampled distance between the surface and the drawn triangle (Concheiro 6.9, linear approximation).
    LinearApproximation {
        /// The target in pixels.
        pixels: f32,
    },
    /// The distance of the vertices that a split would insert from the triangle (Concheiro 3.2.2).
    DistanceTest(Threshold),
    /// The angle between an edge and the surface beside it (Concheiro 3.2.2, vector deviation flat test, with two samples an edge).
    /// In units: the least cosine that is flat, below 1.
    FlatTest(Threshold),
    /// Half the length of an edge (Concheiro 3.2.2).
    LengthTest(Threshold),
}

/// The threshold of a sampled test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Threshold {
    /// In the unit of the test, whatever the view: an object-space length, or a cosine.
    Units(f32),
    /// In pixels.
    Pixels(f32),
}

/// How the size of a metric becomes a wish.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Scale {
    /// A world length that is so many pixels at the threshold.
    Pixels(f64),
    /// What it is at the threshold, whatever the view.
    Absolute(f64),
    /// Khoury's factor.
    Factor(f64),
}

impl Metric {
    /// The WGSL file that defines `metric_size`.
    pub fn shader(&self) -> &'static str {
        match self {
            Self::Edge { .. } => "metrics/edge.wgsl",
            Self::Distance { .. } => "metrics/distance.wgsl",
            Self::Deviation { .. } => "metrics/deviation.wgsl",
            Self::Boundary { .. } => "metrics/boundary.wgsl",
            Self::LocalArea { .. } => "metrics/local_area.wgsl",
            Self::LinearApproximation { .. } => "metrics/linear_approximation.wgsl",
            Self::DistanceTest(_) => "metrics/distance_test.wgsl",
            Self::FlatTest(Threshold::Units(_)) => "metrics/flat_test.wgsl",
            Self::FlatTest(Threshold::Pixels(_)) => "metrics/flat_test_pixels.wgsl",
            Self::LengthTest(_) => "metrics/length_test.wgsl",
        }
    }

    /// The WGSL file that defines `pair_size`.
    pub fn pair_shader(&self) -> &'static str {
        match self {
            Self::Edge { .. } | Self::Distance { .. } | Self::Boundary { .. } | Self::LocalArea { .. } => {
                "pairs/of_parent.wgsl"
            }
            Self::Deviation { .. } => "pairs/deviation.wgsl",
            Self::LinearApproximation { .. } | Self::DistanceTest(_) | Self::FlatTest(_) | Self::LengthTest(_) => {
                "pairs/sampled.wgsl"
            }
        }
    }

    /// The name that scenes and `plan` use.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Edge { .. } => "edge",
            Self::Distance { .. } => "distance",
            Self::Deviation { .. } => "deviation",
            Self::Boundary { .. } => "boundary",
            Self::LocalArea { .. } => "local-area",
            Self::LinearApproximation { .. } => "linear-approximation",
            Self::DistanceTest(_) => "distance-test",
            Self::FlatTest(_) => "flat-test",
            Self::LengthTest(_) => "length-test",
        }
    }

    /// Whether a node that should split has only ancestors that should: then the settled leaves depend on view and settings alone.
    pub fn is_nested(&self) -> bool {
        match self {
            Self::Edge { .. }
            | Self::Distance { .. }
            | Self::Deviation { .. }
            | Self::Boundary { .. }
            | Self::LocalArea { .. } => true,
            Self::LinearApproximation { .. } | Self::DistanceTest(_) | Self::FlatTest(_) | Self::LengthTest(_) => false,
        }
    }

    /// Whether the size of a node is a length that bounds its edges, and at least twice that of its children: then the vertices of one
    /// level have arrived where [`Morph::Geomorph`](crate::Morph::Geomorph) takes them before those of the next start.
    pub fn halves(&self) -> bool {
        matches!(self, Self::Edge { .. } | Self::Boundary { .. } | Self::LocalArea { .. })
    }

    /// The twin in f64 of what the shader computes of a leaf that is drawn as 4^`base_grid` triangles.
    pub fn size(&self, base_grid: u32) -> MetricSize {
        match self {
            Self::Edge { .. } => MetricSize::Edge,
            Self::Distance { .. } => MetricSize::Distance,
            Self::Deviation { .. } => MetricSize::Deviation { grid: base_grid },
            Self::Boundary { .. } => MetricSize::Boundary(self.parameter().into()),
            Self::LocalArea { .. } => MetricSize::LocalArea,
            Self::LinearApproximation { .. } => MetricSize::LinearApproximation,
            Self::DistanceTest(_) => MetricSize::DistanceTest,
            Self::FlatTest(Threshold::Units(_)) => MetricSize::FlatTest,
            Self::FlatTest(Threshold::Pixels(_)) => MetricSize::FlatTestPixels,
            Self::LengthTest(_) => MetricSize::LengthTest,
        }
    }

    /// The threshold of the size of a leaf that is drawn as 4^k triangles: a grid divides lengths by 2^k, deviations by 4^k.
    pub(crate) fn scale(&self, base_grid: u32) -> Scale {
        let pieces = f64::from(1u32 << base_grid);
        let length = |pixels: f32| Scale::Pixels(f64::from(pixels) * pieces);
        let deviation = |pixels: f32| Scale::Pixels(f64::from(pixels) * pieces * pieces);
        match *self {
            // The size is half a leaf's edge.
            Self::Edge { pixels } | Self::Boundary { pixels, .. } => length(pixels / 2.0),
            Self::Distance { factor } => Scale::Factor(f64::from(factor)),
            Self::LocalArea { pixels } | Self::LengthTest(Threshold::Pixels(pixels)) => length(pixels),
            Self::Deviation { pixels }
            | Self::LinearApproximation { pixels }
            | Self::DistanceTest(Threshold::Pixels(pixels))
            | Self::FlatTest(Threshold::Pixels(pixels)) => deviation(pixels),
            Self::DistanceTest(Threshold::Units(units)) => Scale::Absolute(f64::from(units) * pieces * pieces),
            // The size is one minus the cosine, about half the square of the angle.
            Self::FlatTest(Threshold::Units(cosine)) => Scale::Absolute((1.0 - f64::from(cosine)) * pieces * pieces),
            Self::LengthTest(Threshold::Units(units)) => Scale::Absolute(f64::from(units) * pieces),
        }
    }

    /// What the uniform holds as `metric_parameter`.
    pub(crate) fn parameter(&self) -> f32 {
        match self {
            Self::Boundary {
                pixels,
                boundary_pixels,
            } => (pixels / boundary_pixels).max(1.0),
            _ => 0.0,
        }
    }

    /// (name, value, what is expected, whether it holds) of every number.
    pub(crate) fn numbers(&self) -> Vec<(&'static str, f32, &'static str, bool)> {
        let positive = |x: f32| x.is_finite() && x > 0.0;
        let pixels = |name, value| (name, value, "expected a positive number of pixels", positive(value));
        match *self {
            Self::Edge { pixels: value }
            | Self::Deviation { pixels: value }
            | Self::LocalArea { pixels: value }
            | Self::LinearApproximation { pixels: value }
            | Self::DistanceTest(Threshold::Pixels(value))
            | Self::FlatTest(Threshold::Pixels(value))
            | Self::LengthTest(Threshold::Pixels(value)) => vec![pixels("metric.pixels", value)],
            Self::Boundary {
                pixels: value,
                boundary_pixels,
            } => vec![
                pixels("metric.pixels", value),
                pixels("metric.boundary_pixels", boundary_pixels),
            ],
            Self::Distance { factor } => {
                vec![("metric.factor", factor, "expected a positive factor", positive(factor))]
            }
            Self::FlatTest(Threshold::Units(cosine)) => {
                let holds = (0.0..1.0).contains(&cosine);
                vec![("metric.cosine", cosine, "expected a cosine from 0 to below 1", holds)]
            }
            Self::DistanceTest(Threshold::Units(value)) | Self::LengthTest(Threshold::Units(value)) => {
                vec![("metric.units", value, "expected a positive length", positive(value))]
            }
        }
    }
}
