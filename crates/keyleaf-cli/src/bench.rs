//! `keyleaf bench`: camera paths, measured.

use crate::arguments::{Overrides, ReadingArguments, load_scene, parse_seconds, parse_size};
use crate::output::{self, thousands};
use crate::session::{self, DeviceReport};
use crate::timing::{self, Part, TimedFrame};
use crate::{Outcome, progress, table};
use anyhow::{Context, ensure};
use clap::{Args, ValueEnum};
use glam::UVec2;
use keyleaf::headless::Headless;
use keyleaf::{Balance, Phase, View, wgpu};
use keyleaf_scene::scene::CameraPath;
use keyleaf_stage::{Canvas, Loaded, Show, Stage, StageLook, Timer, view_of};
use serde::Serialize;
use serde_json::json;
use std::path::{Path, PathBuf};

/// Fly the camera paths of scenes and measure every frame
///
/// Every frame is waited for, so that what it cost can be told: milliseconds of the update and of the draw by the timestamps of the
/// device, and the CPU time of this process over all threads. On a software device the latter is the cost; its times are not GPU
/// times. With --neighbours both, two copies of the scene, with and without the test that keeps neighbours from cracking, take turns
/// frame by frame, so that both see the same machine.
#[derive(Args)]
#[command(after_help = "Examples:
  keyleaf bench scenes/terrain_real.ron --out run.json
  keyleaf bench scenes/cube.ron --out gate.json --neighbours both --no-draw --from 1.5 --step 0.002 --pixels 1")]
pub struct Arguments {
    /// Scene files, models or height maps
    #[arg(value_name = "SCENE", required = true)]
    scenes: Vec<PathBuf>,
    #[command(flatten)]
    reading: ReadingArguments,
    #[command(flatten)]
    overrides: Overrides,
    /// The report: JSON
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// A camera path by its name; default: the first one of each scene
    #[arg(long, value_name = "NAME")]
    path: Option<String>,
    /// Frames that are measured
    #[arg(long, value_name = "N", default_value_t = 120, value_parser = clap::value_parser!(u32).range(1..))]
    frames: u32,
    /// Frames before, all of the first view
    #[arg(long, value_name = "N", default_value_t = 30)]
    warm_up: u32,
    /// Time from frame to frame [default: so that the frames cover the path]
    #[arg(long, value_name = "SECONDS", value_parser = parse_seconds)]
    step: Option<f64>,
    /// Time on the path at which the frames begin [default: its first key]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    from: Option<f64>,
    /// Size of the picture in pixels
    #[arg(long, value_name = "WxH", value_parser = parse_size, default_value = "1280x720")]
    size: UVec2,
    /// Update only
    #[arg(long)]
    no_draw: bool,
    /// With the test that keeps neighbours from cracking, without it, or one frame of each in turn
    #[arg(long, value_enum, default_value = "on")]
    neighbours: Neighbours,
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq)]
enum Neighbours {
    On,
    Off,
    Both,
}

/// Percentiles of a quantity over the frames.
#[derive(Serialize, Debug, PartialEq)]
struct Spread {
    median: f64,
    p95: f64,
    p99: f64,
    max: f64,
    mean: f64,
}

impl Spread {
    fn of(values: impl Iterator<Item = f64>) -> Self {
        let mut sorted: Vec<f64> = values.collect();
        sorted.sort_by(f64::total_cmp);
        // Nearest rank.
        let at = |part: f64| {
            let rank = (part * sorted.len() as f64).ceil() as usize;
            sorted.get(rank.saturating_sub(1)).copied().unwrap_or(0.0)
        };
        let mean = sorted.iter().sum::<f64>() / sorted.len().max(1) as f64;
        Self {
            median: at(0.5),
            p95: at(0.95),
            p99: at(0.99),
            max: at(1.0),
            mean,
        }
    }
}

/// One pass over the frames.
#[derive(Serialize)]
struct Pass {
    name: &'static str,
    median_ms: f64,
    p95_ms: f64,
    p99_ms: f64,
    max_ms: f64,
    /// CPU time of the process, all threads, a frame.
    cpu_ms: Spread,
    /// CPU time of recording the commands, a frame.
    record_ms: Spread,
    /// Milliseconds of its phases, where the device has timestamps.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    phases: Vec<PhaseSpread>,
}

/// One phase of the update over the frames.
#[derive(Serialize)]
struct PhaseSpread {
    name: &'static str,
    ms: Spread,
}

impl Pass {
    fn of(name: &'static str, parts: &[Part]) -> Self {
        let ms = Spread::of(parts.iter().map(|p| p.ms));
        Self {
            name,
            median_ms: ms.median,
            p95_ms: ms.p95,
            p99_ms: ms.p99,
            max_ms: ms.max,
            cpu_ms: Spread::of(parts.iter().map(|p| p.cpu.as_secs_f64() * 1e3)),
            record_ms: Spread::of(parts.iter().map(|p| p.record.as_secs_f64() * 1e3)),
            phases: Vec::new(),
        }
    }
}

/// What is measured together: a stage that takes part in a flight.
struct Run {
    stage: Stage,
    timer: Option<Timer>,
    frames: Vec<TimedFrame>,
}

/// Runs the command.
pub fn run(arguments: &Arguments, quiet: bool) -> anyhow::Result<Outcome> {
    output::ensure_writable(&arguments.out)?;
    let gpu = session::device()?;
    let mut scenes = Vec::new();
    for scene in &arguments.scenes {
        let loaded = load_scene(scene, &arguments.reading, &arguments.overrides, quiet)?;
        scenes.push(fly(&gpu, scene, loaded, arguments, quiet).with_context(|| scene.display().to_string())?);
    }
    let device = DeviceReport::new(&gpu);
    let report = json!({
        "keyleaf": env!("CARGO_PKG_VERSION"),
        "device": device.device, "driver": device.driver, "backend": device.backend, "software": device.software,
        "times": device.times,
        "profile": if cfg!(debug_assertions) { "debug" } else { "release" },
        "indirect_validation": wgpu::InstanceFlags::from_env_or_default().contains(wgpu::InstanceFlags::VALIDATION_INDIRECT_CALL),
        "cores": std::thread::available_parallelism().map_or(1, usize::from),
        "size": arguments.size.to_array(), "warm_up": arguments.warm_up,
        "scenes": scenes,
    });
    output::write(&arguments.out, serde_json::to_string_pretty(&report)?.as_bytes())?;
    output::print(&text(&scenes, &device, &arguments.out))?;
    Ok(Outcome::Done)
}

/// Flies one scene; its part of the report.
fn fly(
    gpu: &Headless,
    scene: &Path,
    mut loaded: Loaded,
    arguments: &Arguments,
    quiet: bool,
) -> anyhow::Result<serde_json::Value> {
    let path = loaded.path(arguments.path.as_deref())?.clone();
    let views = views(&path, arguments)?;
    let balances: &[Balance] = match arguments.neighbours {
        Neighbours::On => &[Balance::Table],
        Neighbours::Off => &[Balance::Off],
        Neighbours::Both => &[Balance::Table, Balance::Off],
    };
    let mut runs: Vec<Run> = balances
        .iter()
        .map(|balance| start(gpu, &mut loaded, *balance))
        .collect::<Result<_, _>>()?;
    let target = keyleaf_stage::target(Show::Colour);
    let canvas = if arguments.no_draw {
        None
    } else {
        Some(Canvas::new(&gpu.device, arguments.size, target)?)
    };

    let bar = progress::bar(
        u64::from(arguments.warm_up) + views.len() as u64,
        &scene.display().to_string(),
        quiet,
    );
    for _ in 0..arguments.warm_up {
        for run in &mut runs {
            run.stage.set_time(views[0].0)?;
            timing::frame(gpu, &mut run.stage, canvas.as_ref(), &views[0].1, run.timer.as_ref())?;
        }
        bar.inc(1);
    }
    for (time, view) in &views {
        for run in &mut runs {
            run.stage.set_time(*time)?;
            run.frames.push(timing::frame(
                gpu,
                &mut run.stage,
                canvas.as_ref(),
                view,
                run.timer.as_ref(),
            )?);
        }
        bar.inc(1);
    }
    bar.finish_and_clear();

    let [first, others @ ..] = &runs[..] else {
        unreachable!("there is one run at least")
    };
    let mut report = report(scene, &path, first);
    report["neighbours"] = json!(arguments.neighbours != Neighbours::Off);
    if let [other] = others {
        let without = self::report(scene, &path, other);
        report["ratio"] = json!({
            "what": "with the neighbour test over without, CPU time of the update: of all frames, and a leaf",
            "cpu": cpu_ms(first) / cpu_ms(other),
            "cpu_a_leaf": cpu_us_a_leaf(first) / cpu_us_a_leaf(other),
            "ms": mean_ms(first) / mean_ms(other),
        });
        report["without_neighbours"] = without;
    }
    Ok(report)
}

/// The views at a fixed step, with the times on the path.
fn views(path: &CameraPath, arguments: &Arguments) -> anyhow::Result<Vec<(f64, View)>> {
    let from = arguments.from.unwrap_or(path.start()) - path.start();
    let duration = path.duration();
    ensure!(
        (0.0..=duration).contains(&from),
        "--from: expected a time on the path, whose keys last {duration} s"
    );
    let step = arguments
        .step
        .unwrap_or((duration - from) / f64::from(arguments.frames.max(2) - 1));
    // Beyond the end the camera comes back: a slow flight forth and back has no jump.
    let turn = duration.max(f64::MIN_POSITIVE);
    let time = |frame: u32| {
        let time = (from + f64::from(frame) * step).rem_euclid(2.0 * turn);
        path.start() + if time > turn { 2.0 * turn - time } else { time }
    };
    let view = |frame| Some((time(frame), view_of(&path.view_at(time(frame))?, arguments.size)));
    let views: Option<Vec<_>> = (0..arguments.frames).map(view).collect();
    views.with_context(|| format!("the camera path '{}' has no keys", path.name))
}

fn start(gpu: &Headless, loaded: &mut Loaded, balance: Balance) -> anyhow::Result<Run> {
    for object in &mut loaded.objects {
        object.settings.balance = balance;
    }
    let stage = session::stage(gpu, loaded, StageLook::default())?;
    let timer = Timer::new(gpu, &stage);
    Ok(Run {
        stage,
        timer,
        frames: Vec::new(),
    })
}

fn cpu_ms(run: &Run) -> f64 {
    run.frames.iter().map(|f| f.update.cpu.as_secs_f64() * 1e3).sum()
}

fn mean_ms(run: &Run) -> f64 {
    run.frames.iter().map(|f| f.update.ms).sum::<f64>() / run.frames.len().max(1) as f64
}

/// CPU time of update, cull and table over all frames, by the leaves that there were.
fn cpu_us_a_leaf(run: &Run) -> f64 {
    let leaves: f64 = run.frames.iter().map(|f| f64::from(f.statistics.leaves)).sum();
    cpu_ms(run) * 1e3 / leaves.max(1.0)
}

fn report(scene: &Path, path: &CameraPath, run: &Run) -> serde_json::Value {
    let frames = &run.frames;
    let of = |value: fn(&TimedFrame) -> f64| Spread::of(frames.iter().map(value));
    let updates: Vec<Part> = frames.iter().map(|f| f.update).collect();
    let draws: Vec<Part> = frames.iter().filter_map(|f| f.draw).collect();
    let mut update = Pass::of("update", &updates);
    let phases: Vec<_> = frames.iter().filter_map(|f| f.phases).collect();
    if !phases.is_empty() {
        update.phases = Phase::ALL
            .map(|phase| PhaseSpread {
                name: phase.name(),
                ms: Spread::of(phases.iter().map(|ms| ms[phase as usize])),
            })
            .into();
    }
    let mut passes = vec![update];
    if !draws.is_empty() {
        passes.push(Pass::of("draw", &draws));
    }
    let cpu = |f: &TimedFrame| (f.update.cpu + f.draw.unwrap_or_default().cpu).as_secs_f64() * 1e3;
    let memory: Vec<_> = run
        .stage
        .memory()
        .into_iter()
        .map(|(surface, buffer, bytes)| json!({ "surface": surface, "buffer": buffer, "bytes": bytes }))
        .collect();
    let bytes: u64 = run.stage.memory().iter().map(|(_, _, bytes)| bytes).sum();
    json!({
        "name": scene.file_stem().unwrap_or_default().to_string_lossy(), "file": scene, "path": path.name,
        "frames": frames.len(), "clock": timing::clock(run.timer.as_ref()), "passes": passes,
        "leaves": of(|f| f.statistics.leaves.into()),
        "visible": of(|f| f.statistics.visible.into()),
        "triangles": of(|f| f.statistics.triangles as f64),
        "splits": of(|f| f.statistics.splits.into()),
        "merges": of(|f| f.statistics.merges.into()),
        "starved": of(|f| f.statistics.starved.into()),
        "starved_frames": frames.iter().filter(|f| f.statistics.starved > 0).count(),
        "threshold_factor": of(|f| f.statistics.threshold_factor.into()),
        "table_rebuilds": frames.last().map_or(0, |f| f.statistics.rebuilds),
        "lost": frames.iter().map(|f| f.statistics.lost).max(),
        "wall_ms": of(|f| f.wall.as_secs_f64() * 1e3),
        "cpu_ms": of(cpu),
        "cpu_us_a_leaf": cpu_us_a_leaf(run),
        "bytes": bytes, "memory": memory,
    })
}

fn text(scenes: &[serde_json::Value], device: &DeviceReport, out: &Path) -> String {
    let number = |value: Option<&serde_json::Value>| value.and_then(serde_json::Value::as_f64).unwrap_or(0.0);
    let mut rows = Vec::new();
    let mut ratios = String::new();
    for scene in scenes {
        let name = scene["name"].as_str().unwrap_or_default();
        for (run, label) in [
            (Some(scene), ""),
            (scene.get("without_neighbours"), " without neighbours"),
        ] {
            let Some(run) = run else { continue };
            for pass in run["passes"].as_array().into_iter().flatten() {
                let ms = |key: &str| format!("{:.2}", number(pass.get(key)));
                rows.push(vec![
                    format!("{name}{label}"),
                    pass["name"].as_str().unwrap_or_default().to_owned(),
                    thousands(number(run.pointer("/leaves/median")) as u64),
                    ms("median_ms"),
                    ms("p95_ms"),
                    ms("p99_ms"),
                    ms("max_ms"),
                    format!("{:.2}", number(pass.pointer("/cpu_ms/median"))),
                ]);
                for phase in pass["phases"].as_array().into_iter().flatten() {
                    let ms = |key: &str| format!("{:.2}", number(phase["ms"].get(key)));
                    let name = format!("  {}", phase["name"].as_str().unwrap_or_default());
                    let figures = ["median", "p95", "p99", "max"].map(ms);
                    rows.push(
                        [
                            vec![String::new(), name, String::new()],
                            figures.into(),
                            vec![String::new()],
                        ]
                        .concat(),
                    );
                }
            }
            ratios += &format!(
                "\n{name}{label}: {:.3} µs of CPU time a leaf for the update",
                number(run.get("cpu_us_a_leaf"))
            );
        }
        if let Some(ratio) = scene.get("ratio") {
            let [all, leaf] = ["cpu", "cpu_a_leaf"].map(|key| number(ratio.get(key)));
            ratios +=
                &format!("\n{name}: the neighbour test takes {all:.2} times the CPU time, {leaf:.2} times a leaf");
        }
    }
    let head = ["scene", "pass", "leaves", "ms p50", "p95", "p99", "max", "CPU ms p50"];
    format!(
        "{} ({})\n{}{ratios}\n{}",
        device.device,
        device.times,
        table::format(&head, &rows),
        out.display()
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_are_values_that_were_measured() {
        let spread = Spread::of((1..=100).rev().map(f64::from));
        assert_eq!(
            spread,
            Spread {
                median: 50.0,
                p95: 95.0,
                p99: 99.0,
                max: 100.0,
                mean: 50.5
            }
        );
        assert_eq!(Spread::of([7.0].into_iter()).p99, 7.0);
        assert_eq!(Spread::of(std::iter::empty()).max, 0.0);
    }
}
