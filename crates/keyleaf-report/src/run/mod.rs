//! The record of a run: what was measured, where, and with what, so that it can be compared with another.
//!
//! | type | is |
//! |---|---|
//! | [`RunRecord`] | one file: the tool, the device, and the scenes that were flown |
//! | [`SceneRun`] | one scene with one variant of settings along one camera path |
//! | [`PassRecord`] | one pass of its frames, perhaps with phases |
//! | [`Series`] | one quantity over the frames, summed up and sample by sample |
//!
//! Files are JSON with `"schema": 1`. A reader refuses another number; fields that are added later must have defaults, and what changes
//! its meaning takes another number.

mod error;
mod read;
mod scene;
mod series;

pub use error::RunError;
pub use scene::{BufferBytes, Clock, PassRecord, SceneRun};
pub use series::Series;

use serde::{Deserialize, Serialize};

/// The number of this format.
pub const SCHEMA: u32 = 1;

/// One file of measurements.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunRecord {
    /// [`SCHEMA`].
    pub schema: u32,
    /// What measured.
    pub tool: Tool,
    /// What was measured on.
    pub device: Device,
    /// Pixels of the picture.
    pub size: [u32; 2],
    /// Frames before those that were measured, all of the first view.
    pub warm_up: u32,
    /// Scenes and variants in the order in which they were flown.
    pub runs: Vec<SceneRun>,
}

/// The program and how it was built.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tool {
    /// Its version.
    pub version: String,
    /// The commit that it was built from; empty if unknown.
    #[serde(default)]
    pub commit: String,
    /// The profile of the build: `release` or `debug`. Times of a debug build say nothing.
    pub profile: String,
}

/// The device and how it was used.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Device {
    /// Name of the adapter.
    pub name: String,
    /// Driver with its version.
    pub driver: String,
    /// API, such as `vulkan`.
    pub backend: String,
    /// Type of the adapter, such as `discrete GPU`.
    pub kind: String,
    /// Whether it computes on the CPU: then no time is a GPU time.
    pub software: bool,
    /// Features that were enabled.
    #[serde(default)]
    pub features: Vec<String>,
    /// Flags of the API that cost time, such as `VALIDATION`.
    #[serde(default)]
    pub flags: Vec<String>,
    /// Whether indirect calls were validated, which adds passes to every indirect dispatch and draw.
    pub indirect_validation: bool,
    /// Cores of the CPU that the process may use.
    pub cores: u32,
}

impl Device {
    /// What its times mean.
    pub fn times(&self) -> &'static str {
        if self.software {
            "of a software device on the CPU: not a GPU time"
        } else {
            "of a GPU"
        }
    }
}

impl RunRecord {
    /// A record without runs.
    pub fn new(tool: Tool, device: Device, size: [u32; 2], warm_up: u32) -> Self {
        Self {
            schema: SCHEMA,
            tool,
            device,
            size,
            warm_up,
            runs: Vec::new(),
        }
    }

    /// The run of a scene, variant and path.
    pub fn find(&self, like: &SceneRun) -> Option<&SceneRun> {
        self.runs.iter().find(|run| run.key() == like.key())
    }
}
