//! From measured frames to the records of `keyleaf-report`.

use crate::session::DeviceReport;
use crate::timing::{Part, TimedFrame};
use keyleaf::headless::Headless;
use keyleaf::{Phase, wgpu};
use keyleaf_report::run::{BufferBytes, Clock, Device, PassRecord, SceneRun, Series, Tool};
use keyleaf_stage::Stage;
use std::path::Path;

/// This program.
pub fn tool() -> Tool {
    Tool {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        commit: env!("KEYLEAF_COMMIT").to_owned(),
        profile: if cfg!(debug_assertions) { "debug" } else { "release" }.to_owned(),
    }
}

/// The device and how it is used.
pub fn device(gpu: &Headless) -> Device {
    let report = DeviceReport::new(gpu);
    let flags = wgpu::InstanceFlags::from_env_or_default();
    let names = |flags: wgpu::InstanceFlags| flags.iter_names().map(|(name, _)| name.to_owned()).collect();
    Device {
        name: report.device,
        driver: report.driver,
        backend: report.backend,
        kind: format!("{:?}", gpu.adapter.get_info().device_type).to_lowercase(),
        software: report.software,
        features: gpu
            .device
            .features()
            .iter_names()
            .map(|(name, _)| name.to_owned())
            .collect(),
        flags: names(flags),
        indirect_validation: flags.contains(wgpu::InstanceFlags::VALIDATION_INDIRECT_CALL),
        cores: std::thread::available_parallelism().map_or(1, |cores| cores.get() as u32),
    }
}

/// The name of a scene in records: that of its file.
pub fn scene_name(file: &Path) -> String {
    file.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// The frames of a stage as a record; scene, path, variant and settings are the caller's.
pub fn scene_run(mut run: SceneRun, stage: &Stage, frames: &[TimedFrame], has_timestamps: bool) -> SceneRun {
    let of = |value: fn(&TimedFrame) -> f64| Series::new(frames.iter().map(value));
    run.frames = frames.len();
    run.clock = if has_timestamps { Clock::Timestamps } else { Clock::Wall };
    run.passes = passes(frames);
    run.leaves = of(|f| f.statistics.leaves.into());
    run.visible = of(|f| f.statistics.visible.into());
    run.triangles = of(|f| f.statistics.triangles as f64);
    run.splits = of(|f| f.statistics.splits.into());
    run.merges = of(|f| f.statistics.merges.into());
    run.starved = of(|f| f.statistics.starved.into());
    run.record_ms = of(|f| ms(f.update.record) + ms(f.draw.unwrap_or_default().record));
    run.cpu_ms = of(|f| ms(f.update.cpu) + ms(f.draw.unwrap_or_default().cpu));
    run.wall_ms = of(|f| ms(f.wall));
    let memory = stage.memory().into_iter();
    run.memory = memory
        .map(|(surface, buffer, bytes)| BufferBytes {
            surface,
            buffer: buffer.to_owned(),
            bytes,
        })
        .collect();
    let starved = frames.iter().filter(|f| f.statistics.starved > 0).count();
    let factors = frames.iter().map(|f| f64::from(f.statistics.threshold_factor));
    run.figures = [
        ("starved_frames", starved as f64),
        ("threshold_factor_max", factors.fold(0.0, f64::max)),
        (
            "table_rebuilds",
            frames.last().map_or(0.0, |f| f.statistics.rebuilds.into()),
        ),
        (
            "lost",
            frames.iter().map(|f| f64::from(f.statistics.lost)).fold(0.0, f64::max),
        ),
        ("update_cpu_us_a_leaf", cpu_us_a_leaf(frames)),
    ]
    .map(|(name, value)| (name.to_owned(), value))
    .into();
    run
}

fn ms(duration: std::time::Duration) -> f64 {
    duration.as_secs_f64() * 1e3
}

/// CPU time of update, cull and table over all frames, by the leaves that there were; microseconds.
pub fn cpu_us_a_leaf(frames: &[TimedFrame]) -> f64 {
    let leaves: f64 = frames.iter().map(|f| f64::from(f.statistics.leaves)).sum();
    let cpu: f64 = frames.iter().map(|f| ms(f.update.cpu)).sum();
    cpu * 1e3 / leaves.max(1.0)
}

fn passes(frames: &[TimedFrame]) -> Vec<PassRecord> {
    let updates: Vec<Part> = frames.iter().map(|f| f.update).collect();
    let draws: Vec<Part> = frames.iter().filter_map(|f| f.draw).collect();
    let mut update = pass("update", &updates);
    let phases: Vec<_> = frames.iter().filter_map(|f| f.phases).collect();
    if !phases.is_empty() {
        let of = |phase: Phase| Series::new(phases.iter().map(|ms| ms[phase as usize]));
        update.phases = Phase::ALL.map(|phase| PassRecord::new(phase.name(), of(phase))).into();
    }
    let draw = (!draws.is_empty()).then(|| pass("draw", &draws));
    std::iter::once(update).chain(draw).collect()
}

fn pass(name: &str, parts: &[Part]) -> PassRecord {
    PassRecord {
        cpu_ms: Some(Series::new(parts.iter().map(|part| ms(part.cpu)))),
        record_ms: Some(Series::new(parts.iter().map(|part| ms(part.record)))),
        ..PassRecord::new(name, Series::new(parts.iter().map(|part| part.ms)))
    }
}
