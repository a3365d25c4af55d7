//! `keyleaf bench`: camera paths, measured.

use crate::arguments::{Overrides, ReadingArguments, load_scene, parse_seconds, parse_size};
use crate::output::{self, thousands};
use crate::timing::{self, TimedFrame};
use crate::variant::{Sweep, Variant, described, parse_sweep};
use crate::{Outcome, progress, record, session};
use anyhow::{Context, ensure};
use clap::Args;
use glam::UVec2;
use keyleaf::View;
use keyleaf::headless::Headless;
use keyleaf_report::run::{Clock, RunRecord, SceneRun};
use keyleaf_report::table;
use keyleaf_scene::scene::CameraPath;
use keyleaf_stage::{Canvas, Loaded, Show, Stage, StageLook, Timer, view_of};
use std::path::{Path, PathBuf};

/// Fly the camera paths of scenes and measure every frame
///
/// Every frame is waited for, so that what it cost can be told: milliseconds of the update and of the draw by the timestamps of the
/// device, and the CPU time of this process over all threads. On a software device the latter is the cost; its times are not GPU
/// times. --sweep measures a setting at several values, one after another, or, with --interleave, in turn frame by frame, so that all see
/// the same machine. `keyleaf compare` tells two runs, or two variants of a run, apart.
///
/// Settings to sweep: edge, deviation (pixels), distance (a factor), base-grid, max-level, settle, guard, back-faces, morph, neighbours (on or
/// off: the test that keeps neighbours from cracking). Several sweeps are combined.
#[derive(Args)]
#[command(after_help = "Examples:
  keyleaf bench scenes/terrain_real.ron --out run.json
  keyleaf bench scenes/torus.ron --out edges.json --csv edges.csv --sweep edge=1,2,4,8,16
  keyleaf bench scenes/cube.ron --out gate.json --sweep neighbours=on,off --interleave --no-draw --from 1.5 --step 0.002 --pixels 1")]
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
    /// Measure a setting at several values; may be given several times
    #[arg(long, value_name = "NAME=V,V…", value_parser = parse_sweep)]
    sweep: Vec<Sweep>,
    /// Variants take turns frame by frame
    #[arg(long)]
    interleave: bool,
    /// The figures of all passes as a table as well
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
}

/// A variant that takes part in a flight.
struct Run {
    variant: Variant,
    stage: Stage,
    timer: Option<Timer>,
    frames: Vec<TimedFrame>,
}

/// Runs the command.
pub fn run(arguments: &Arguments, quiet: bool) -> anyhow::Result<Outcome> {
    let files = std::iter::once(&arguments.out).chain(&arguments.csv);
    files.clone().try_for_each(|file| output::ensure_writable(file))?;
    let gpu = session::device()?;
    let size = arguments.size.to_array();
    let mut report = RunRecord::new(record::tool(), record::device(&gpu), size, arguments.warm_up);
    for scene in &arguments.scenes {
        let loaded = load_scene(scene, &arguments.reading, &arguments.overrides, quiet)?;
        let runs = fly(&gpu, scene, &loaded, arguments, quiet).with_context(|| scene.display().to_string())?;
        report.runs.extend(runs);
    }
    output::write(&arguments.out, report.to_json()?.as_bytes())?;
    if let Some(file) = &arguments.csv {
        output::write(file, csv(&report).as_bytes())?;
    }
    output::print(&text(&report, &arguments.out))?;
    Ok(Outcome::Done)
}

/// Flies one scene in all variants; their records.
fn fly(
    gpu: &Headless,
    scene: &Path,
    loaded: &Loaded,
    arguments: &Arguments,
    quiet: bool,
) -> anyhow::Result<Vec<SceneRun>> {
    let path = loaded.path(arguments.path.as_deref())?;
    let views = views(path, arguments)?;
    let canvas = if arguments.no_draw {
        None
    } else {
        Some(Canvas::new(
            &gpu.device,
            arguments.size,
            keyleaf_stage::target(Show::Colour),
        )?)
    };
    let variants = Variant::all(&arguments.sweep);
    let frames = u64::from(arguments.warm_up) + views.len() as u64;
    let bar = progress::bar(frames * variants.len() as u64, &scene.display().to_string(), quiet);
    // Those that take turns are on the device together, others one at a time.
    let together = if arguments.interleave { variants.len() } else { 1 };
    let mut records = Vec::new();
    for variants in variants.chunks(together) {
        let runs: anyhow::Result<Vec<Run>> = variants.iter().map(|variant| start(gpu, loaded, variant)).collect();
        let mut runs = runs?;
        let warm_up = std::iter::repeat_n(&views[0], arguments.warm_up as usize);
        for (number, (time, view)) in warm_up.chain(&views).enumerate() {
            for run in &mut runs {
                run.stage.set_time(*time)?;
                let frame = timing::frame(gpu, &mut run.stage, canvas.as_ref(), view, run.timer.as_ref())?;
                if number >= arguments.warm_up as usize {
                    run.frames.push(frame);
                }
                bar.inc(1);
            }
        }
        records.extend(runs.iter().map(|run| recorded(scene, path, run)));
    }
    bar.finish_and_clear();
    Ok(records)
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

fn start(gpu: &Headless, loaded: &Loaded, variant: &Variant) -> anyhow::Result<Run> {
    let mut loaded = loaded.clone();
    for object in &mut loaded.objects {
        variant.apply(&mut object.settings)?;
    }
    let stage = session::stage(gpu, &loaded, StageLook::default())?;
    Ok(Run {
        variant: variant.clone(),
        timer: Timer::new(gpu, &stage),
        stage,
        frames: Vec::new(),
    })
}

fn recorded(scene: &Path, path: &CameraPath, run: &Run) -> SceneRun {
    let mut empty = SceneRun::new(&record::scene_name(scene), &path.name, Clock::Wall, 0);
    empty.file = scene.display().to_string();
    empty.variant = run.variant.name();
    for object in &run.stage.objects {
        let settings = described(object.quadtree.settings());
        let named = settings
            .into_iter()
            .map(|(name, value)| (format!("{}.{name}", object.name), value));
        empty.settings.extend(named);
    }
    record::scene_run(empty, &run.stage, &run.frames, run.timer.is_some())
}

/// A row a pass and phase: name, leaves, percentiles, CPU.
fn rows(report: &RunRecord) -> Vec<Vec<String>> {
    let mut rows = Vec::new();
    for run in &report.runs {
        for pass in &run.passes {
            let figures =
                |ms: &keyleaf_report::run::Series| [ms.p50, ms.p95, ms.p99, ms.max].map(|ms| format!("{ms:.2}"));
            let cpu = pass
                .cpu_ms
                .as_ref()
                .map_or(String::new(), |cpu| format!("{:.2}", cpu.p50));
            let first = [run.name(), pass.name.clone(), thousands(run.leaves.p50 as u64)];
            rows.push([&first[..], &figures(&pass.ms), &[cpu]].concat());
            for phase in &pass.phases {
                let first = [String::new(), format!("  {}", phase.name), String::new()];
                rows.push([&first[..], &figures(&phase.ms), &[String::new()]].concat());
            }
        }
    }
    rows
}

fn text(report: &RunRecord, out: &Path) -> String {
    let head = ["scene", "pass", "leaves", "ms p50", "p95", "p99", "max", "CPU ms p50"];
    let a_leaf: String = report
        .runs
        .iter()
        .map(|run| {
            let figure = run.figures.get("update_cpu_us_a_leaf").copied().unwrap_or(0.0);
            format!("\n{}: {figure:.3} µs of CPU time a leaf for the update", run.name())
        })
        .collect();
    format!(
        "{} ({})\n{}{a_leaf}\n{}",
        report.device.name,
        report.device.times(),
        table::format(&head, &rows(report)),
        out.display()
    )
}

/// One line a scene, variant, pass and phase.
fn csv(report: &RunRecord) -> String {
    let quoted = |text: &str| format!("\"{}\"", text.replace('"', "\"\""));
    let mut lines =
        "scene,path,variant,pass,phase,p50_ms,p95_ms,p99_ms,max_ms,mean_ms,leaves,triangles,starved,bytes\n".to_owned();
    for run in &report.runs {
        for pass in &run.passes {
            let phases = pass.phases.iter().map(|phase| (phase.name.as_str(), &phase.ms));
            for (phase, ms) in std::iter::once(("", &pass.ms)).chain(phases) {
                lines += &format!(
                    "{},{},{},{},{phase},{},{},{},{},{},{},{},{},{}\n",
                    quoted(&run.scene),
                    quoted(&run.path),
                    quoted(&run.variant),
                    pass.name,
                    ms.p50,
                    ms.p95,
                    ms.p99,
                    ms.max,
                    ms.mean,
                    run.leaves.p50,
                    run.triangles.p50,
                    run.starved.max,
                    run.bytes(),
                );
            }
        }
    }
    lines
}
