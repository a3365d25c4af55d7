//! `keyleaf view`: the viewer.

use crate::Outcome;
use crate::arguments::{ReadingArguments, Up, parse_size};
use crate::output;
use clap::{Args, ValueEnum};
use glam::UVec2;
use keyleaf_stage::LoadOptions;
use std::path::PathBuf;
use std::time::Instant;

/// Open a window on a scene
///
/// Drag turns, the wheel comes nearer, a click says what leaf this is; ? lists all keys. Files can be dropped on the window, and are
/// read again when they change.
#[derive(Args)]
#[command(after_help = "Examples:
  keyleaf view scenes/terrain_real.ron
  keyleaf view cow.obj --surface loop
  keyleaf view scenes/fox.ron --screenshot fox.png --frames 60")]
pub struct Arguments {
    /// Scene file, model or height map; default: a list of the scenes that are shipped
    #[arg(value_name = "SCENE")]
    scene: Option<PathBuf>,
    #[command(flatten)]
    reading: ReadingArguments,
    /// A camera of the scene by its name; default: the first one
    #[arg(long, value_name = "NAME")]
    camera: Option<String>,
    /// Size of the window in points [default: as it was left]
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    size: Option<UVec2>,
    /// How frames wait for the screen; what the device lacks is fifo
    #[arg(long, value_enum, default_value = "fifo", value_name = "HOW")]
    present: Present,
    /// Write a picture of the window, and quit
    #[arg(long, value_name = "FILE", conflicts_with = "script")]
    screenshot: Option<PathBuf>,
    /// Frames before the picture [default: until nothing changes]
    #[arg(long, value_name = "N", requires = "screenshot", value_parser = clap::value_parser!(u32).range(1..))]
    frames: Option<u32>,
    /// Steps that drive the viewer as a person would: a RON list, see the module `script` of keyleaf-viewer
    #[arg(long, value_name = "FILE")]
    script: Option<PathBuf>,
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq)]
enum Present {
    /// In step with the screen
    Fifo,
    /// In step; the newest frame replaces one that waits
    Mailbox,
    /// At once; frames may tear
    Immediate,
}

/// Runs the command.
pub fn run(arguments: &Arguments, started: Instant) -> anyhow::Result<Outcome> {
    if let Some(picture) = &arguments.screenshot {
        output::ensure_writable(picture)?;
    }
    let reading = &arguments.reading;
    keyleaf_viewer::run(keyleaf_viewer::Options {
        file: arguments.scene.clone(),
        reading: LoadOptions {
            raw_size: reading.raw_size.map(|size| size.to_array()),
            ignore_trims: reading.ignore_trims,
            even_spans: reading.even_spans,
            z_up: reading.up == Up::Z,
            shape: reading.surface,
        },
        camera: arguments.camera.clone(),
        size: arguments.size.map(|size| size.to_array()),
        present: match arguments.present {
            Present::Fifo => keyleaf_viewer::Present::Fifo,
            Present::Mailbox => keyleaf_viewer::Present::Mailbox,
            Present::Immediate => keyleaf_viewer::Present::Immediate,
        },
        screenshot: arguments.screenshot.clone(),
        frames: arguments.frames,
        script: arguments.script.clone(),
        started,
    })?;
    Ok(Outcome::Done)
}
