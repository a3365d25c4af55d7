//! `keyleaf check`: a camera path, frame by frame, by what the GPU holds.

use crate::arguments::{SceneArguments, parse_seconds, parse_size};
use crate::output::{self, thousands};
use crate::session::{self, DeviceReport};
use crate::{Outcome, progress};
use anyhow::ensure;
use clap::Args;
use glam::UVec2;
use keyleaf::headless::Headless;
use keyleaf::{BackFaces, Balance, BaseGrid, KeyleafError, View};
use keyleaf_report::table;
use keyleaf_stage::check::{Checker, Finding, FindingKind, Findings, PictureCheck, Sight};
use keyleaf_stage::{Canvas, Show, Stage, StageLook, view_of};
use serde_json::json;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

/// Fly a camera path and check every frame for cracks and whatever else must not be
///
/// Every frame is updated, read back and checked as the GPU holds it: cracks and T-junctions (edges matched by integer identity and by
/// the bits of the vertices that the shader computes), overlaps, lost and double leaves, the invariants I1 and I2, flags, the leaf
/// table, vertices that are not finite, leaves in view that are not drawn. In one frame the positions of some hundred pixels of a
/// rendered picture are compared with the triangles. Exit code 1 if anything is found. Starved frames are told, they are no finding.
#[derive(Args)]
#[command(after_help = "Examples:
  keyleaf check scenes/fox.ron
  keyleaf check cow.obj --step 0.02 --capacity 3000 --json")]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// A camera path of the scene by its name; default: the first one
    #[arg(long, value_name = "NAME")]
    path: Option<String>,
    /// Time from frame to frame
    #[arg(long, value_name = "SECONDS", value_parser = parse_seconds, default_value = "0.1")]
    step: f64,
    /// Check every N-th frame; all are updated
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    every: u32,
    /// Size of the picture in pixels
    #[arg(long, value_name = "WxH", value_parser = parse_size, default_value = "1280x720")]
    size: UVec2,
    /// Switch off what keeps neighbours from cracking, to see that the cracks are found
    #[arg(long)]
    no_neighbours: bool,
    /// Print a report as JSON
    #[arg(long)]
    json: bool,
}

/// Pixels of the one picture that are compared.
const PIXELS: u32 = 400;
/// Findings that are printed.
const PRINTED: usize = 20;

/// A finding with where it was.
struct Found {
    frame: usize,
    time: f64,
    object: String,
    finding: Finding,
}

/// What came out of a flight.
#[derive(Default)]
struct Flight {
    frames: usize,
    checked: usize,
    counts: BTreeMap<FindingKind, u64>,
    first: Vec<Found>,
    starved: Vec<usize>,
    leaves: u32,
    pixels: u32,
}

impl Flight {
    fn add(&mut self, frame: usize, time: f64, object: &str, findings: Findings) {
        for (kind, count) in &findings.counts {
            *self.counts.entry(*kind).or_default() += count;
        }
        let found = |finding| Found {
            frame,
            time,
            object: object.to_owned(),
            finding,
        };
        let room = PRINTED.saturating_sub(self.first.len());
        self.first.extend(findings.first.into_iter().take(room).map(found));
    }

    fn total(&self) -> u64 {
        self.counts.values().sum()
    }
}

/// Runs the command.
pub fn run(arguments: &Arguments, quiet: bool) -> anyhow::Result<Outcome> {
    let start = Instant::now();
    let mut loaded = arguments.scene.load(quiet)?;
    if arguments.no_neighbours {
        loaded
            .objects
            .iter_mut()
            .for_each(|object| object.settings.balance = Balance::Off);
    }
    let path = loaded.path(arguments.path.as_deref())?;
    let frames: Vec<_> = path
        .frames(arguments.step)
        .map(|f| (f.time, view_of(&f.view, arguments.size)))
        .collect();
    ensure!(!frames.is_empty(), "the camera path '{}' has no keys", path.name);
    let gpu = session::device()?;
    let look = StageLook {
        show: Show::Position,
        ..StageLook::default()
    };
    let mut stage = session::stage(&gpu, &loaded, look)?;
    let canvas = Canvas::new(&gpu.device, arguments.size, stage.target())?;
    let checker = Checker::new(&gpu, &stage)?;

    let mut flight = Flight {
        frames: frames.len(),
        ..Flight::default()
    };
    let bar = progress::bar(frames.len() as u64, &format!("checking {}", path.name), quiet);
    for (frame, (time, view)) in frames.iter().enumerate() {
        stage.set_time(*time)?;
        let statistics = session::update(&gpu, &mut stage, view)?;
        flight.leaves = flight.leaves.max(statistics.leaves);
        if statistics.starved > 0 {
            flight.starved.push(frame);
        }
        if frame % arguments.every as usize == 0 || frame + 1 == frames.len() {
            flight.checked += 1;
            for report in checker.frame(&gpu, &stage, view)? {
                flight.add(frame, *time, &report.object, report.findings);
            }
        }
        if frame == frames.len() / 2 {
            let findings = picture(&gpu, &mut stage, &canvas, &checker, view)?;
            flight.pixels = PIXELS.min(arguments.size.x * arguments.size.y);
            flight.add(frame, *time, "all", findings);
        }
        bar.inc(1);
    }
    bar.finish_and_clear();

    let seconds = start.elapsed().as_secs_f64();
    let scene = &arguments.scene.scene;
    if arguments.json {
        report_json(&flight, scene, &path.name, arguments, &DeviceReport::new(&gpu), seconds)?;
    } else {
        output::print(&text(&flight, scene, &path.name, seconds))?;
    }
    Ok(if flight.total() == 0 {
        Outcome::Done
    } else {
        Outcome::Failed
    })
}

/// Renders positions as the last update left the stage, and compares pixels with the triangles.
fn picture(
    gpu: &Headless,
    stage: &mut Stage,
    canvas: &Canvas,
    checker: &Checker,
    view: &View,
) -> Result<Findings, KeyleafError> {
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    canvas.draw(&mut encoder, stage, view, None);
    gpu.queue.submit([encoder.finish()]);
    let pixels: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&canvas.read(gpu)?);
    let mut check = PictureCheck::new(view);
    for (i, object) in stage.objects.iter().enumerate() {
        let (quadtree, Some(inspector)) = (&object.quadtree, checker.inspector(i)) else {
            continue;
        };
        let snapshot = quadtree.read_back(&gpu.device, &gpu.queue)?;
        let sight = Sight::new(view, quadtree.world_from_object(), quadtree.origin());
        let is_two_sided = quadtree.settings().back_faces == BackFaces::Drawn;
        let grid = BaseGrid::of(quadtree.settings());
        let indices = Arc::from(grid.indices);
        let emitted = inspector.emit(&gpu.device, &gpu.queue, quadtree, &snapshot.visible)?;
        for (slot, vertices) in snapshot
            .visible
            .iter()
            .zip(emitted.positions.chunks(grid.vertices.len()))
        {
            let key = snapshot.leaves[*slot as usize].key;
            check.add(key, vertices, &indices, &sight, is_two_sided);
        }
    }
    let mut findings = Findings::default();
    check.check(canvas.size(), &pixels, PIXELS, &mut findings);
    Ok(findings)
}

fn report_json(
    flight: &Flight,
    scene: &Path,
    path: &str,
    arguments: &Arguments,
    device: &DeviceReport,
    seconds: f64,
) -> anyhow::Result<()> {
    let first: Vec<_> = flight
        .first
        .iter()
        .map(|f| {
            json!({
                "frame": f.frame, "time": f.time, "object": f.object, "kind": f.finding.kind,
                "keys": f.finding.key_texts(), "detail": f.finding.detail,
            })
        })
        .collect();
    output::print_json(&json!({
        "device": device.device, "software": device.software, "scene": scene, "path": path,
        "size": arguments.size.to_array(), "step": arguments.step, "frames": flight.frames, "checked": flight.checked,
        "findings": flight.total(), "kinds": flight.counts, "first": first,
        "leaves": { "max": flight.leaves }, "starved_frames": flight.starved, "pixels": flight.pixels, "seconds": seconds,
    }))
}

fn text(flight: &Flight, scene: &Path, path: &str, seconds: f64) -> String {
    let mut text = format!(
        "{}: path {path}, {} of {} frames checked, up to {} leaves, {} pixels, {seconds:.1} s: {} findings",
        scene.display(),
        flight.checked,
        flight.frames,
        thousands(flight.leaves.into()),
        flight.pixels,
        thousands(flight.total()),
    );
    if let (Some(first), n) = (flight.starved.first(), flight.starved.len()) {
        text += &format!(
            "\nstarved in {n} frames, first in frame {first}: the capacity was used up, and what was drawn was coarser"
        );
    }
    if flight.total() > 0 {
        let counts: Vec<String> = flight
            .counts
            .iter()
            .map(|(kind, n)| format!("{} {}", thousands(*n), kind.name()))
            .collect();
        let rows: Vec<Vec<String>> = flight
            .first
            .iter()
            .map(|f| {
                let keys = f.finding.key_texts().join(" ");
                vec![
                    f.frame.to_string(),
                    f.object.clone(),
                    f.finding.kind.name().into(),
                    keys,
                    f.finding.detail.clone(),
                ]
            })
            .collect();
        let table = table::format(
            &["frame", "object", "finding", "keys (face:root:digits)", "what"],
            &rows,
        );
        text += &format!("\n{}\nthe first ones:\n{table}", counts.join(", "));
    }
    text
}
