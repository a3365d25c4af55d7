//! The report: error against time for every setting of a scene.

use super::series::{self, Series};
use super::studio::{Setup, Studio, screen_of};
use crate::{progress, record};
use anyhow::Context;
use keyleaf::{Metric, View};
use keyleaf_report::error::{DrawnTriangle, DrawnVertex, ErrorSettings, MeshError, measure};
use keyleaf_report::picture::{Mask, Picture, PictureError, picture_error};
use keyleaf_report::report::{Errors, GrowthPoint, Point, Report, SceneReport};
use keyleaf_report::run::{Clock, SceneRun};
use keyleaf_report::scaling::{CostModel, device_classes, scaling};
use keyleaf_stage::{Drawn, Loaded, LoadedObject, Pipelines, drawn};
use std::time::{Duration, Instant};

/// How thorough a report is.
#[derive(Clone, Copy)]
pub struct Effort {
    /// Fewer values and samples.
    pub quick: bool,
}

impl Effort {
    /// Samples of the error of a setting, at most.
    fn samples(self) -> usize {
        if self.quick { 30_000 } else { 400_000 }
    }

    /// Room for the finest settings: leaves of a surface, at least.
    fn capacity(self) -> u32 {
        if self.quick { 1 << 16 } else { 1 << 18 }
    }

    /// Room for the reference picture.
    fn reference_capacity(self) -> u32 {
        if self.quick { 1 << 17 } else { 1 << 20 }
    }

    /// How long settings of a scene are measured: no more are begun after this.
    fn time_of_scene(self) -> Duration {
        if self.quick {
            Duration::from_secs(30)
        } else {
            Duration::MAX
        }
    }

    /// How long frames of a setting are timed at most.
    pub fn timed(self) -> Duration {
        Duration::from_millis(if self.quick { 500 } else { 2000 })
    }

    /// Edges of the reference picture, pixels.
    fn reference_pixels(self) -> f32 {
        if self.quick { 2.0 } else { 0.5 }
    }
}

/// What a leaf moves in a frame, bytes: the pass `update` reads 56 and writes 4, the list of visible leaves has 4, and the draw reads the
/// leaf's 32.
const MOVED_PER_LEAF: f64 = 96.0;
/// Dispatches and the draw.
const PASSES: f64 = 14.0;
/// What each takes to start on a discrete GPU, microseconds; an assumption, printed with the table.
const START_US: f64 = 6.0;
/// The part of the peak bandwidth that streaming passes reach; an assumption, printed with the table.
const EFFICIENCY: f64 = 0.6;

/// A report without scenes.
pub fn empty(setup: &Setup<'_>, effort: Effort) -> Report {
    let device = record::device(setup.gpu);
    let mut notes = vec![
        "Every point is a setting, settled for one view. Milliseconds are the median of frames that update and draw; errors are those of \
         the triangles drawn, against the surface in 64-bit numbers."
            .to_owned(),
    ];
    if device.software {
        notes.push(
            "This is a software device: its times are CPU times, not GPU times. Ratios tell, absolute times do not."
                .to_owned(),
        );
    }
    if effort.quick {
        notes.push("A quick report: few settings, few samples of the error, a coarse reference picture.".to_owned());
    }
    Report {
        title: "What accuracy costs in time".to_owned(),
        tool: record::tool(),
        device,
        notes,
        scenes: Vec::new(),
        scaling: None,
    }
}

/// Adds what scaling on paper says, from the growth of all scenes.
pub fn add_scaling(report: &mut Report) {
    let growth = || report.scenes.iter().flat_map(|scene| &scene.growth);
    if growth().next().is_none() {
        return;
    }
    let model = CostModel {
        moved_per_leaf: MOVED_PER_LEAF,
        kept_per_leaf: 120.0,
        kept_fixed: 1e6,
        passes: PASSES,
        start_us: START_US,
        efficiency: EFFICIENCY,
    };
    let measured: Vec<(f64, f64)> = growth().map(|point| (point.leaves, point.ms)).collect();
    report.scaling = Some(scaling(&model, &device_classes(), &measured, None));
}

/// All settings of a scene, measured.
pub fn scene(
    setup: &Setup<'_>,
    loaded: &Loaded,
    camera: &str,
    view: &View,
    effort: Effort,
) -> anyhow::Result<SceneReport> {
    let all = series::all(loaded, effort.quick);
    let points = all.iter().map(|series| series.points.len()).sum::<usize>() as u64;
    let name = record::scene_name(&loaded.file);
    let bar = progress::bar(1 + points, &name, setup.quiet);
    let quiet = Setup { quiet: true, ..*setup };
    let mut measuring = Measuring {
        setup: &quiet,
        truth: loaded,
        view,
        effort,
        reference: Vec::new(),
        pipelines: Pipelines::default(),
        clock: Clock::Wall,
    };
    measuring.reference = measuring.reference()?;
    bar.inc(1);
    let mut found = Vec::new();
    let mut notes = loaded.notes.clone();
    let mut left_out = Vec::new();
    let mut starved = vec![false; all.len()];
    let begin = Instant::now();
    for (p, s) in turns(&all) {
        let Series { name, points, .. } = &all[s];
        let (label, changed) = &points[p];
        bar.inc(1);
        if starved[s] {
            continue;
        }
        if begin.elapsed() > effort.time_of_scene() {
            left_out.push(format!("{name} {label}"));
            continue;
        }
        let point = measuring
            .point(name, label, changed)
            .with_context(|| format!("{name} {label}"))?;
        // Then finer ones are as well.
        starved[s] = all[s].is_refining && point.threshold_factor > 1.0;
        found.push(((s, p), point));
    }
    bar.finish_and_clear();
    found.sort_by_key(|(place, _)| *place);
    let found: Vec<Point> = found.into_iter().map(|(_, point)| point).collect();
    if !left_out.is_empty() {
        let seconds = effort.time_of_scene().as_secs();
        notes.push(format!(
            "Left out, as a quick report takes {seconds} s for the settings of a scene: {}.",
            left_out.join("; ")
        ));
    }
    let edges = found.iter().filter(|point| point.series == "edge");
    let growth = edges.map(|point| GrowthPoint {
        leaves: point.leaves,
        ms: point.ms,
        bytes: point.bytes,
    });
    Ok(SceneReport {
        name,
        camera: camera.to_owned(),
        size: setup.size.to_array(),
        clock: measuring.clock,
        growth: growth.collect(),
        points: found,
        notes,
    })
}

/// Numbers of all points and their series, in the order in which they are measured: the first ones of all series, then the second ones.
fn turns(all: &[Series]) -> Vec<(usize, usize)> {
    let of = |(s, series): (usize, &Series)| (0..series.points.len()).map(move |p| (p, s)).collect::<Vec<_>>();
    let mut turns: Vec<(usize, usize)> = all.iter().enumerate().flat_map(of).collect();
    turns.sort_unstable();
    turns
}

/// A scene that is measured.
struct Measuring<'a> {
    setup: &'a Setup<'a>,
    /// The scene as it is: what errors are against.
    truth: &'a Loaded,
    view: &'a View,
    effort: Effort,
    /// The picture that others are compared with.
    reference: Vec<u8>,
    pipelines: Pipelines,
    clock: Clock,
}

impl Measuring<'_> {
    fn reference(&mut self) -> anyhow::Result<Vec<u8>> {
        let mut fine = self.truth.clone();
        for object in &mut fine.objects {
            object.settings.metric = Metric::Edge {
                pixels: self.effort.reference_pixels(),
            };
            object.settings.target_leaves = 0;
            object.settings.capacity = object.settings.capacity.max(self.effort.reference_capacity());
        }
        let mut studio = Studio::with_pipelines(self.setup, &fine, self.view, &mut self.pipelines)?;
        Ok(studio.look()?.pixels)
    }

    fn point(&mut self, series: &str, label: &str, changed: &Loaded) -> anyhow::Result<Point> {
        let mut roomy = changed.clone();
        for object in &mut roomy.objects {
            object.settings.capacity = object.settings.capacity.max(self.effort.capacity());
        }
        let mut studio = Studio::with_pipelines(self.setup, &roomy, self.view, &mut self.pipelines)?;
        let film = studio.film()?;
        let run = SceneRun::new(series, label, Clock::Wall, 0);
        let run = record::scene_run(run, studio.stage(), &film.frames, studio.has_timestamps());
        self.clock = run.clock;
        let mut mesh: Option<MeshError> = None;
        for (shown, truth) in studio.stage().objects.iter().zip(&self.truth.objects) {
            let triangles = drawn(self.setup.gpu, &shown.quadtree)?;
            if let Some(error) = self.mesh_error(truth, &triangles)? {
                mesh = Some(mesh.map_or(error, |other| greater(other, error)));
            }
        }
        Ok(Point {
            errors: Errors::new(mesh.as_ref(), Some(self.picture_error(&film.pixels)?)),
            ..Point::of_run(series, label, &run)
        })
    }

    /// `None` where nothing of the object is drawn.
    fn mesh_error(&self, truth: &LoadedObject, drawn: &Drawn) -> anyhow::Result<Option<MeshError>> {
        if drawn.triangles.is_empty() {
            return Ok(None);
        }
        let vertex = |index: u32| {
            let keyleaf_stage::DrawnVertex { at, position, normal } = drawn.vertices[index as usize];
            DrawnVertex { at, position, normal }
        };
        let triangles: Vec<DrawnTriangle> = drawn
            .triangles
            .iter()
            .map(|t| DrawnTriangle { corners: t.map(vertex) })
            .collect();
        let settings = ErrorSettings {
            most_samples: self.effort.samples(),
            ..ErrorSettings::default()
        };
        let screen = screen_of(self.setup, self.view, truth);
        Ok(Some(measure(
            truth.surface.as_ref(),
            &triangles,
            &settings,
            Some(&screen),
        )?))
    }

    fn picture_error(&self, pixels: &[u8]) -> anyhow::Result<PictureError> {
        let size = self.setup.size.to_array();
        let [picture, reference] = [Picture::new(pixels, size)?, Picture::new(&self.reference, size)?];
        Ok(picture_error(&picture, &reference, &Mask::everything(&reference))?)
    }
}

/// The greater error of two surfaces.
fn greater(a: MeshError, b: MeshError) -> MeshError {
    let worse = |a: &MeshError| a.both_ways().max;
    if worse(&a) >= worse(&b) { a } else { b }
}
