//! From a scene to its quadtrees on a device, refined for a view.

use crate::progress;
use keyleaf::headless::Headless;
use keyleaf::{KeyleafError, Statistics, View, wgpu};
use keyleaf_stage::{Loaded, Settling, Stage, StageLook, target};
use serde::Serialize;
use std::sync::Arc;

/// A device. What the driver refuses later ends the program with its message instead of a panic.
pub fn device() -> anyhow::Result<Headless> {
    let gpu = pollster::block_on(Headless::request())?;
    gpu.device.on_uncaptured_error(Arc::new(|error: wgpu::Error| {
        eprintln!("error: the device refused: {}", one_line(&error.to_string()));
        std::process::exit(2);
    }));
    Ok(gpu)
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// What a report says about the device.
#[derive(Serialize, Clone, PartialEq, Debug)]
pub struct DeviceReport {
    /// Name of the adapter.
    pub device: String,
    /// Driver with its version.
    pub driver: String,
    /// API.
    pub backend: String,
    /// Whether it computes on the CPU.
    pub software: bool,
    /// What times mean.
    pub times: &'static str,
}

impl DeviceReport {
    /// About a device.
    pub fn new(gpu: &Headless) -> Self {
        let info = gpu.adapter.get_info();
        let software = gpu.is_software();
        Self {
            driver: format!("{} {}", info.driver, info.driver_info).trim().to_owned(),
            backend: info.backend.to_string(),
            device: info.name,
            software,
            times: if software {
                "of a software device on the CPU: not a GPU time"
            } else {
                "of a GPU"
            },
        }
    }
}

/// The stage of a scene.
pub fn stage(gpu: &Headless, loaded: &Loaded, look: StageLook) -> Result<Stage, KeyleafError> {
    Stage::new(gpu, loaded, look, target(look.show))
}

/// Submits one frame of updates and waits for it; the figures of all surfaces after it.
pub fn update(gpu: &Headless, stage: &mut Stage, view: &View) -> Result<Statistics, KeyleafError> {
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    stage.update(&mut encoder, view);
    gpu.queue.submit([encoder.finish()]);
    wait(gpu)?;
    statistics(stage)
}

/// Figures of the frame that was waited for.
pub fn statistics(stage: &mut Stage) -> Result<Statistics, KeyleafError> {
    stage
        .statistics()
        .ok_or_else(|| KeyleafError::ReadBack("statistics", "they did not arrive".to_owned()))
}

/// Waits until the device has done all that was submitted.
pub fn wait(gpu: &Headless) -> Result<(), KeyleafError> {
    let failed = |error: wgpu::PollError| KeyleafError::ReadBack("the frame", error.to_string());
    gpu.device
        .poll(wgpu::PollType::wait_indefinitely())
        .map(|_| ())
        .map_err(failed)
}

/// How far a stage was refined.
#[derive(Debug, Clone, Copy)]
pub struct Settled {
    /// Frames that it took.
    pub frames: u32,
    /// Whether nothing changed any more.
    pub is_settled: bool,
}

/// Updates for a view until nothing changes, or for as many frames as are given.
///
/// From the roots a settled result takes a pass a level to split and a few for requests, ARCHITECTURE section 3; a starved one takes
/// four more for each step of pressure.
pub fn settle(
    gpu: &Headless,
    stage: &mut Stage,
    view: &View,
    frames: Option<u32>,
    quiet: bool,
) -> anyhow::Result<Settled> {
    let deepest = stage
        .objects
        .iter()
        .map(|o| o.quadtree.settings().max_level)
        .max()
        .unwrap_or(0);
    let most = frames.unwrap_or(4 * (2 * deepest + 8)).max(1);
    let bar = progress::bar(most.into(), "refining", quiet);
    let mut settling = Settling::default();
    for frame in 1.. {
        let is_settled = settling.observe(&update(gpu, stage, view)?);
        bar.inc(1);
        if frame == most || (frames.is_none() && is_settled) {
            bar.finish_and_clear();
            return Ok(Settled {
                frames: frame,
                is_settled,
            });
        }
    }
    unreachable!("the loop has no other end")
}
