//! How finely a scene is drawn, and within which limits.

use serde::{Deserialize, Serialize};

/// The settings of a scene. All surfaces share them, but for what [`SettingsOverrides`] of a surface say.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// When a leaf splits. Default `Edge(pixels: 8.0)`.
    pub metric: Metric,
    /// k: every leaf is drawn as 4^k triangles; 0..=6, default 2.
    pub base_grid: u32,
    /// The most leaves of each surface, at least the number of its roots; default 262144. What does not fit is drawn
    /// coarser, never left out.
    pub capacity: u32,
    /// Update passes a frame; 1..=64, default 1. More follow a fast camera sooner, at their cost.
    pub settle: u32,
    /// A number of leaves a surface that a controller aims at by changing the threshold, 1..=capacity; default `None`: the
    /// threshold is as the metric says.
    pub target_leaves: Option<u32>,
    /// The deepest level of a leaf; 0..=31 - base_grid, default `None`: 31 - base_grid.
    pub max_level: Option<u32>,
    /// What lies outside the view.
    pub guard_band: GuardBand,
    /// Which leaves are not drawn. Default `Frustum`.
    pub culling: Culling,
    /// What is done with triangles that are seen from behind. Default `Drawn`.
    pub back_faces: BackFaces,
    /// Where the vertices that a split adds are drawn. Default `None`.
    pub morph: Morph,
    /// Which leaves are drawn as pairs, two as one triangle. Default `Forced`.
    pub pairs: Pairs,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            metric: Metric::default(),
            base_grid: 2,
            capacity: 1 << 18,
            settle: 1,
            target_leaves: None,
            max_level: None,
            guard_band: GuardBand::default(),
            culling: Culling::default(),
            back_faces: BackFaces::default(),
            morph: Morph::default(),
            pairs: Pairs::default(),
        }
    }
}

impl Settings {
    /// The settings of one surface.
    pub fn with(&self, overrides: &SettingsOverrides) -> Self {
        Self {
            metric: overrides.metric.unwrap_or(self.metric),
            max_level: overrides.max_level.or(self.max_level),
            culling: overrides.culling.unwrap_or(self.culling),
            back_faces: overrides.back_faces.unwrap_or(self.back_faces),
            ..self.clone()
        }
    }

    /// The deepest level of a leaf: level and base grid together have at most 31 digits.
    pub fn deepest_level(&self) -> u32 {
        let possible = keyleaf_key::MAX_LEVEL - self.base_grid.min(keyleaf_key::MAX_LEVEL);
        self.max_level.unwrap_or(possible).min(possible)
    }
}

/// When a leaf splits.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Metric {
    /// When the bound of a drawn edge is longer than this on the screen.
    Edge {
        /// Length of a drawn edge in pixels, above 0; default 8.
        #[serde(default = "Metric::default_pixels")]
        pixels: f64,
    },
    /// By distance alone, whatever the length of the edge and the picture's size (Khoury 2.1): the level of a leaf is to be
    /// -log2(distance tan(fov / 2) / (sqrt 2 factor)).
    Distance {
        /// Metres, above 0; doubling it adds a level. Default 10: of the size of the faces times how many levels one wants at
        /// arm's length.
        #[serde(default = "Metric::default_factor")]
        factor: f64,
    },
    /// When the surface is farther than this from the drawn triangles, by bounds of its second derivatives, and of first ones where those
    /// are large: flat parts stay coarse.
    /// For Bézier and NURBS surfaces and flat meshes; height fields and noise count with the length of their edges.
    Deviation {
        /// Pixels, above 0; default 1.
        #[serde(default = "one_pixel")]
        pixels: f64,
    },
    /// As `Edge`, but finer at open boundaries (Concheiro 6.10).
    Boundary {
        /// Length of a drawn edge in pixels, above 0; default 8.
        #[serde(default = "Metric::default_pixels")]
        pixels: f64,
        /// The same at open boundaries, above 0 and at most `pixels`; default 1.
        #[serde(default = "one_pixel")]
        boundary_pixels: f64,
    },
    /// By the size of the face on the screen, evenly divided (Concheiro 6.8).
    LocalArea {
        /// Length of a drawn edge in pixels, above 0; default 8.
        #[serde(default = "Metric::default_pixels")]
        pixels: f64,
    },
    /// When the surface is farther than this from a triangle at some samples (Concheiro 6.9). Like the tests below, it sees the
    /// surface at samples only, and what has settled can depend on what the camera saw before.
    LinearApproximation {
        /// Pixels, above 0; default 1.
        #[serde(default = "one_pixel")]
        pixels: f64,
    },
    /// When the vertices that a split would insert are farther than this from the triangle (Concheiro 3.2.2).
    DistanceTest(Threshold),
    /// When the surface turns away from an edge (Concheiro 3.2.2). `Units`: the least cosine that counts as flat.
    FlatTest(Threshold),
    /// When half an edge is longer than this (Concheiro 3.2.2).
    LengthTest(Threshold),
}

/// The threshold of a sampled test.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Threshold {
    /// In the unit of the test, whatever the view: a length of the model, above 0, or a cosine, 0 to below 1.
    Units(f64),
    /// In pixels, above 0.
    Pixels(f64),
}

fn one_pixel() -> f64 {
    1.0
}

impl Metric {
    fn default_pixels() -> f64 {
        8.0
    }

    fn default_factor() -> f64 {
        10.0
    }

    /// Whether its sizes are lengths that halve from level to level, as [`Morph::Geomorph`] needs.
    pub fn halves(&self) -> bool {
        matches!(self, Self::Edge { .. } | Self::Boundary { .. } | Self::LocalArea { .. })
    }
}

impl Default for Metric {
    fn default() -> Self {
        Self::Edge {
            pixels: Self::default_pixels(),
        }
    }
}

/// What lies outside the view, but near it, stays fine, so that a turn of the camera finds it ready.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct GuardBand {
    /// Width of the band on every side, as a fraction of the picture's width and height; 0..=10, default 0.25.
    pub margin: f64,
    /// How many times coarser leaves beyond it may become; at least 1 (as fine as in view), default 8.
    pub coarsen: f64,
}

impl Default for GuardBand {
    fn default() -> Self {
        Self {
            margin: 0.25,
            coarsen: 8.0,
        }
    }
}

/// Which leaves are not drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Culling {
    /// Those whose bound lies outside the view.
    #[default]
    Frustum,
    /// None: all are drawn.
    Off,
}

/// What is done with triangles that are seen from behind. All but `Drawn` are for closed surfaces: of open ones the inside vanishes.
/// The last three leave out whole faces of Bézier and NURBS surfaces, for other surfaces they are refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum BackFaces {
    /// They are drawn.
    #[default]
    Drawn,
    /// They are not drawn.
    Hidden,
    /// Leaves none of whose triangles faces the eye are left out (Concheiro 6.4.1, dice culling). Changes no pixel.
    Leaves,
    /// Faces whose four corners face away are left out (Concheiro 6.11, LQC). Approximate: what bulges may be missing.
    Light,
    /// Faces of whose control net all squares face away are left out (Concheiro 6.12, SQC as printed). Approximate as well.
    Strong,
    /// Faces that cannot face the eye are left out, by a cone of their normals. Changes no pixel.
    Conservative,
}

/// Where the vertices that a split adds are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Morph {
    /// On the surface at once.
    #[default]
    None,
    /// First on the edge that they divide, from where they slide to the surface as the camera comes nearer: nothing jumps. For the metrics
    /// `Edge`, `Boundary` and `LocalArea`.
    Geomorph,
}

/// Which leaves are drawn as pairs, two as one triangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Pairs {
    /// Where they must be, beside larger ones.
    #[default]
    Forced,
    /// Also where the metric is satisfied with triangles twice as large.
    Wished,
}

/// Settings that a surface has for itself; what is `None` is as in the scene.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SettingsOverrides {
    /// See [`Settings::metric`].
    pub metric: Option<Metric>,
    /// See [`Settings::max_level`].
    pub max_level: Option<u32>,
    /// See [`Settings::culling`].
    pub culling: Option<Culling>,
    /// See [`Settings::back_faces`].
    pub back_faces: Option<BackFaces>,
}
