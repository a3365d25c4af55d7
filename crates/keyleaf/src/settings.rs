//! What a user chooses for one quadtree.

use crate::KeyleafError;
use crate::metric::Metric;
use keyleaf_key::MAX_LEVEL;

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
    /// What is done with triangles that are seen from behind.
    pub back_faces: BackFaces,
    /// Where the vertices that a split adds are drawn. May change from frame to frame, with another
    /// [`LeafPipeline`](crate::draw::LeafPipeline).
    pub morph: Morph,
    /// Which leaves are drawn as pairs.
    pub pairs: Pairs,
    /// Whether the control mesh of the surface moves, see [`Quadtree::set_cage`](crate::Quadtree::set_cage).
    pub moving: bool,
}

/// What is done with triangles that are seen from behind. All but [`BackFaces::Drawn`] are for closed surfaces, whose objects are
/// not mirrored; of open ones the inside vanishes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum BackFaces {
    /// They are drawn.
    #[default]
    Drawn,
    /// They are not drawn.
    Hidden,
    /// As [`Hidden`](Self::Hidden), and leaves none of whose triangles faces the eye are left out (Concheiro 6.4.1, dice culling): never
    /// changes a pixel. Takes 16 bytes a leaf, and the surface is asked for all vertices of a leaf once in its life.
    Leaves,
    /// As [`Hidden`](Self::Hidden), and whole faces are left out whose corners face away (Concheiro 6.11, LQC). Approximate: a face that
    /// bulges towards the eye may be missing. For Bézier and NURBS surfaces, as are those below.
    Light,
    /// The same by all squares of the control net, as printed (Concheiro 6.12, SQC). Not conservative either.
    Strong,
    /// The same by a cone of all normals that the face can have: never changes a pixel.
    Conservative,
}

impl BackFaces {
    /// All, from the plainest on.
    pub const ALL: [Self; 6] = [
        Self::Drawn,
        Self::Hidden,
        Self::Leaves,
        Self::Light,
        Self::Strong,
        Self::Conservative,
    ];

    /// The WGSL file that defines `face_is_back`, where faces are culled.
    pub fn shader(self) -> Option<&'static str> {
        match self {
            Self::Drawn | Self::Hidden | Self::Leaves => None,
            Self::Light => Some("culling/light.wgsl"),
            Self::Strong => Some("culling/strong.wgsl"),
            Self::Conservative => Some("culling/conservative.wgsl"),
        }
    }

    /// The name that `plan` and the program use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Drawn => "drawn",
            Self::Hidden => "hidden",
            Self::Leaves => "leaves",
            Self::Light => "light",
            Self::Strong => "strong",
            Self::Conservative => "conservative",
        }
    }

    /// Whether leaves keep a cone of their normals.
    pub fn has_leaf_cones(self) -> bool {
        self == Self::Leaves
    }

    /// Whether something that can be seen may be missing.
    pub fn is_approximate(self) -> bool {
        matches!(self, Self::Light | Self::Strong)
    }
}

/// Where the vertices that a split adds are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Morph {
    /// On the surface. Where the metric allows pixels, splits and merges are seen as small jumps.
    #[default]
    None,
    /// First on the edge that they divide; then they slide to the surface while the wish goes on growing by half of the threshold. For
    /// metrics that [halve](Metric::halves) from level to level. A vertex that slides takes three evaluations of the surface instead of
    /// one, and the metric of the split leaves; [`BackFaces::Leaves`] and [`BackFaces::Conservative`] leave nothing out, as [`BackFaces::Hidden`].
    Geomorph,
}

impl Morph {
    /// All.
    pub const ALL: [Self; 2] = [Self::None, Self::Geomorph];

    /// The WGSL file that defines `drawn_frame`.
    pub fn shader(self) -> &'static str {
        match self {
            Self::None => "morph/none.wgsl",
            Self::Geomorph => "morph/geomorph.wgsl",
        }
    }

    /// The name that `plan` and the program use.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Geomorph => "geomorph",
        }
    }
}

/// Which leaves are drawn as pairs: two as one triangle, half a level between them and their parent.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Pairs {
    /// Those beside a leaf that has no vertex between them.
    #[default]
    Forced,
    /// Also those with which the metric is satisfied, on both sides of a leg: triangles come in powers of two, not of four. A face with four
    /// corners may be two triangles, where vertices do not morph. Takes 16 bytes a leaf, and the surface is asked more of new leaves.
    Wished,
}

impl Pairs {
    /// All.
    pub const ALL: [Self; 2] = [Self::Forced, Self::Wished];

    /// The name that `plan` and the program use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Forced => "forced",
            Self::Wished => "wished",
        }
    }
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
            back_faces: BackFaces::Drawn,
            morph: Morph::None,
            pairs: Pairs::default(),
            moving: false,
        }
    }
}

impl Settings {
    /// The largest base grid.
    pub const MAX_BASE_GRID: u32 = 6;
    /// The most passes a frame.
    pub const MAX_SETTLE: u32 = 64;

    /// What is done with triangles that are seen from behind: normal cones know nothing of vertices on their way.
    pub fn drawn_faces(&self) -> BackFaces {
        match (self.morph, self.back_faces) {
            (Morph::Geomorph, BackFaces::Leaves | BackFaces::Conservative) => BackFaces::Hidden,
            (_, back_faces) => back_faces,
        }
    }

    /// Takes another metric. With one that does not halve, vertices do not morph.
    pub fn set_metric(&mut self, metric: Metric) {
        self.metric = metric;
        if !metric.halves() {
            self.morph = Morph::None;
        }
    }

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
        for (name, value, expected, holds) in self.metric.numbers() {
            check(holds, name, value, expected)?;
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
            self.morph == Morph::None || self.metric.halves(),
            "morph",
            format!("{} with the metric {}", self.morph.name(), self.metric.name()),
            "expected none, or one of the metrics edge, boundary and local-area, lengths that halve from level to level",
        )?;
        check(
            positive(self.guard_factor) && self.guard_factor <= 1.0,
            "guard_factor",
            self.guard_factor,
            "expected above 0, at most 1",
        )
    }
}
