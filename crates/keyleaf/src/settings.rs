//! What a user chooses for one quadtree.

use crate::KeyleafError;
use keyleaf_key::MAX_LEVEL;

/// When a leaf is too coarse.
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
}

impl Metric {
    /// The WGSL file that defines `metric_size`.
    pub fn shader(&self) -> &'static str {
        match self {
            Self::Edge { .. } => "metrics/edge.wgsl",
            Self::Distance { .. } => "metrics/distance.wgsl",
        }
    }

    /// The name that scenes and `plan` use.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Edge { .. } => "edge",
            Self::Distance { .. } => "distance",
        }
    }
}

/// What a user chooses for one quadtree. All may change from frame to frame but `capacity`, `balance` and the kind of metric,
/// which need new buffers or pipelines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// When a leaf is too coarse.
    pub metric: Metric,
    /// k: a leaf is drawn as 4^k triangles, 0..=6.
    pub base_grid: u32,
    /// Slots for leaves: what the buffers can hold.
    pub capacity: u32,
    /// Passes a frame, 1..=64: more follow a fast camera sooner.
    pub settle: u32,
    /// If not 0, the threshold is steered so that about so many leaves result.
    pub target_leaves: u32,
    /// No leaf is deeper, 0..=31 - base_grid.
    pub max_level: u32,
    /// Width of the guard band around the view, as a part of its half width, 0..; leaves outside are coarser.
    pub guard_band: f32,
    /// Metric outside the guard band, as a part of the one inside, above 0 and at most 1; 1 switches it off.
    pub guard_factor: f32,
    /// Whether leaves outside the view are left out of the draw.
    pub cull: bool,
    /// How neighbours are kept from cracking.
    pub balance: Balance,
}

/// How neighbours are kept from cracking.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Balance {
    /// By the leaves that are there: no crack in any frame.
    #[default]
    Table,
    /// Not at all: every leaf follows its own metric, and the surface cracks. For measuring what [`Balance::Table`] costs.
    Off,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            metric: Metric::Edge { pixels: 8.0 },
            base_grid: 2,
            capacity: 1 << 18,
            settle: 1,
            target_leaves: 0,
            max_level: MAX_LEVEL - 6,
            guard_band: 0.25,
            guard_factor: 0.125,
            cull: true,
            balance: Balance::Table,
        }
    }
}

impl Settings {
    /// The largest base grid.
    pub const MAX_BASE_GRID: u32 = 6;
    /// The most passes a frame.
    pub const MAX_SETTLE: u32 = 64;

    /// Refuses what is outside the ranges given with the fields.
    ///
    /// # Errors
    /// [`KeyleafError::Setting`] names the first one.
    pub fn validate(&self) -> Result<(), KeyleafError> {
        fn check(
            holds: bool,
            setting: &'static str,
            value: impl ToString,
            expected: &'static str,
        ) -> Result<(), KeyleafError> {
            if holds {
                Ok(())
            } else {
                Err(KeyleafError::Setting {
                    setting,
                    value: value.to_string(),
                    expected,
                })
            }
        }
        let positive = |x: f32| x.is_finite() && x > 0.0;
        match self.metric {
            Metric::Edge { pixels } => check(
                positive(pixels),
                "metric.pixels",
                pixels,
                "expected a positive number of pixels",
            )?,
            Metric::Distance { factor } => {
                check(positive(factor), "metric.factor", factor, "expected a positive factor")?
            }
        }
        check(
            self.base_grid <= Self::MAX_BASE_GRID,
            "base_grid",
            self.base_grid,
            "expected 0 to 6",
        )?;
        check(
            self.capacity >= 1,
            "capacity",
            self.capacity,
            "expected at least 1 leaf",
        )?;
        check(
            self.capacity <= crate::layout::MAX_CAPACITY,
            "capacity",
            self.capacity,
            "expected at most 16777213 leaves",
        )?;
        check(
            (1..=Self::MAX_SETTLE).contains(&self.settle),
            "settle",
            self.settle,
            "expected 1 to 64 passes",
        )?;
        check(
            self.max_level + self.base_grid <= MAX_LEVEL,
            "max_level",
            self.max_level,
            "expected at most 31 - base_grid",
        )?;
        check(
            self.guard_band.is_finite() && self.guard_band >= 0.0,
            "guard_band",
            self.guard_band,
            "expected 0 or more",
        )?;
        check(
            positive(self.guard_factor) && self.guard_factor <= 1.0,
            "guard_factor",
            self.guard_factor,
            "expected above 0, at most 1",
        )
    }
}
