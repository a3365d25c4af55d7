//! One scene with one variant of settings, flown along one camera path.

use super::Series;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What milliseconds are measured by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Clock {
    /// Timestamps that the device wrote.
    Timestamps,
    /// The wall's clock, from submission to completion: the device has no timestamps.
    Wall,
}

impl Clock {
    /// In words.
    pub fn text(self) -> &'static str {
        match self {
            Self::Timestamps => "timestamps of the device",
            Self::Wall => "wall time from submission to completion: the device has no timestamps",
        }
    }
}

/// A scene, flown.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SceneRun {
    /// Name of the scene.
    pub scene: String,
    /// Its file, as it was given.
    #[serde(default)]
    pub file: String,
    /// Name of the camera path.
    pub path: String,
    /// Name of the variant; empty for the scene as it is.
    #[serde(default)]
    pub variant: String,
    /// Settings by name, such as `metric`: `edge 4 px`. Two runs are compared only if these are equal.
    #[serde(default)]
    pub settings: BTreeMap<String, String>,
    /// Frames that were measured.
    pub frames: usize,
    /// What the milliseconds of passes are measured by.
    pub clock: Clock,
    /// Passes in the order in which a frame has them: `update`, and `draw` if there was one.
    pub passes: Vec<PassRecord>,
    /// Leaves alive.
    pub leaves: Series,
    /// Leaves drawn.
    pub visible: Series,
    /// Triangles drawn.
    pub triangles: Series,
    /// Halves of diamonds split.
    pub splits: Series,
    /// Halves of diamonds merged.
    pub merges: Series,
    /// Splits for which the buffers had no room.
    pub starved: Series,
    /// Milliseconds of recording commands.
    pub record_ms: Series,
    /// CPU milliseconds of the process, over all threads.
    pub cpu_ms: Series,
    /// Milliseconds from the begin of a frame to its end.
    pub wall_ms: Series,
    /// Bytes by buffer.
    pub memory: Vec<BufferBytes>,
    /// Other figures by name, such as `table_rebuilds`.
    #[serde(default)]
    pub figures: BTreeMap<String, f64>,
}

/// One pass over the frames.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PassRecord {
    /// Its name.
    pub name: String,
    /// Milliseconds.
    pub ms: Series,
    /// CPU milliseconds of the process while it ran.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cpu_ms: Option<Series>,
    /// Milliseconds of recording its commands.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub record_ms: Option<Series>,
    /// Parts of it that have timestamps of their own.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub phases: Vec<PassRecord>,
}

impl PassRecord {
    /// A pass of which only the milliseconds are known.
    pub fn new(name: &str, ms: Series) -> Self {
        Self {
            name: name.to_owned(),
            ms,
            cpu_ms: None,
            record_ms: None,
            phases: Vec::new(),
        }
    }
}

/// A buffer of a surface.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct BufferBytes {
    /// Name of the surface.
    pub surface: String,
    /// Name of the buffer.
    pub buffer: String,
    /// Its size.
    pub bytes: u64,
}

impl SceneRun {
    /// A run without figures, of a scene as it is.
    pub fn new(scene: &str, path: &str, clock: Clock, frames: usize) -> Self {
        let none = Series::default;
        Self {
            scene: scene.to_owned(),
            file: String::new(),
            path: path.to_owned(),
            variant: String::new(),
            settings: BTreeMap::new(),
            frames,
            clock,
            passes: Vec::new(),
            leaves: none(),
            visible: none(),
            triangles: none(),
            splits: none(),
            merges: none(),
            starved: none(),
            record_ms: none(),
            cpu_ms: none(),
            wall_ms: none(),
            memory: Vec::new(),
            figures: BTreeMap::new(),
        }
    }

    /// What makes two runs the same measurement: scene, path and variant.
    pub fn key(&self) -> (&str, &str, &str) {
        (&self.scene, &self.path, &self.variant)
    }

    /// Milliseconds of all passes together, frame by frame.
    pub fn frame_ms(&self) -> Series {
        let mut passes = self.passes.iter().map(|pass| &pass.ms);
        let Some(first) = passes.next() else {
            return Series::default();
        };
        passes.fold(first.clone(), |sum, pass| sum.plus(pass))
    }

    /// Bytes of all buffers.
    pub fn bytes(&self) -> u64 {
        self.memory.iter().map(|buffer| buffer.bytes).sum()
    }

    /// A name for tables: scene and variant.
    pub fn name(&self) -> String {
        if self.variant.is_empty() {
            self.scene.clone()
        } else {
            format!("{} {}", self.scene, self.variant)
        }
    }

    /// All series with their names.
    pub(super) fn series(&self) -> Vec<(String, &Series)> {
        let own = [
            ("leaves", &self.leaves),
            ("visible", &self.visible),
            ("triangles", &self.triangles),
            ("splits", &self.splits),
            ("merges", &self.merges),
            ("starved", &self.starved),
            ("record_ms", &self.record_ms),
            ("cpu_ms", &self.cpu_ms),
            ("wall_ms", &self.wall_ms),
        ];
        let mut all: Vec<_> = own.map(|(name, series)| (name.to_owned(), series)).into();
        for pass in &self.passes {
            all.push((format!("{}.ms", pass.name), &pass.ms));
            all.extend(pass.cpu_ms.iter().map(|cpu| (format!("{}.cpu_ms", pass.name), cpu)));
            all.extend(
                pass.record_ms
                    .iter()
                    .map(|record| (format!("{}.record_ms", pass.name), record)),
            );
            let phases = pass.phases.iter();
            all.extend(phases.map(|phase| (format!("{}.{}.ms", pass.name, phase.name), &phase.ms)));
        }
        all
    }
}
