//! The viewer of keyleaf: a window in which a scene, its level of detail and what it costs can be seen and changed.
//!
//! | module | does |
//! |---|---|
//! | [`app`] | the event loop: window events, when to draw, when to rest |
//! | `shell`, `opened` | window and device, made and made again; files, shown when they are there |
//! | [`gpu`] | device and surface: made, resized, lost, made again |
//! | [`frame`] | one frame: the interface, the update, the draw |
//! | [`perform`] | what actions do |
//! | [`viewer`] | the state of the viewer |
//! | [`document`] | the scene that is open: look, settings, whether it has settled |
//! | [`camera`] | orbit, flight, paths |
//! | [`action`] | what can be asked for, and the keys |
//! | [`panels`] | the window's parts |
//! | [`costs`], [`levels`], [`minimap`], [`picking`] | what the panels show |
//! | [`opening`], [`reload`], [`library`] | files: opened aside, watched, shipped |
//! | [`script`] | steps that drive the viewer as a person would |
//! | [`screenshot`], [`remembered`], [`palette`], [`projection`], [`ground`] | pictures, window state, colours, geometry |
//!
//! Nothing is drawn while nothing changes: the loop waits for events, and frames follow each other only while the quadtrees settle,
//! the camera moves, or the interface asks.

#![deny(missing_docs)]

pub mod action;
pub mod app;
pub mod camera;
pub mod costs;
pub mod document;
pub mod frame;
pub mod gpu;
pub mod ground;
pub mod levels;
pub mod library;
pub mod minimap;
mod opened;
pub mod opening;
pub mod palette;
pub mod panels;
pub mod perform;
pub mod picking;
pub mod projection;
pub mod reload;
pub mod remembered;
pub mod screenshot;
pub mod script;
mod shell;
pub mod viewer;

use keyleaf_stage::LoadOptions;
use std::path::PathBuf;
use std::time::Instant;

/// How frames wait for the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Present {
    /// In step with the screen.
    #[default]
    Fifo,
    /// In step, but the newest frame replaces one that waits.
    Mailbox,
    /// At once; frames may tear.
    Immediate,
}

impl Present {
    fn mode(self) -> wgpu::PresentMode {
        match self {
            Self::Fifo => wgpu::PresentMode::Fifo,
            Self::Mailbox => wgpu::PresentMode::Mailbox,
            Self::Immediate => wgpu::PresentMode::Immediate,
        }
    }
}

/// What the viewer is started with.
#[derive(Debug, Clone)]
pub struct Options {
    /// What to open; nothing: a list of the scenes that are shipped.
    pub file: Option<PathBuf>,
    /// What the file cannot tell itself.
    pub reading: LoadOptions,
    /// A camera of the scene by its name.
    pub camera: Option<String>,
    /// Width and height of the window in points; `None`: as it was left.
    pub size: Option<[u32; 2]>,
    /// How frames wait for the screen.
    pub present: Present,
    /// A picture to write, and then to quit.
    pub screenshot: Option<PathBuf>,
    /// Frames before that picture; `None`: until nothing changes.
    pub frames: Option<u32>,
    /// Steps that drive the viewer.
    pub script: Option<PathBuf>,
    /// When the program was started.
    pub started: Instant,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            file: None,
            reading: LoadOptions::default(),
            camera: None,
            size: None,
            present: Present::default(),
            screenshot: None,
            frames: None,
            script: None,
            started: Instant::now(),
        }
    }
}

/// Opens the window, and returns when it is closed.
///
/// # Errors
/// There is no display or no device; a script is malformed or a step of it failed; the picture that was asked for cannot be written.
pub fn run(options: Options) -> anyhow::Result<()> {
    app::run(options)
}
