//! Accuracy against time: the last seconds as points, by the measured distance of triangles from the surface and by milliseconds.

use crate::costs::Costs;
use crate::document::Document;
use crate::palette;
use crate::panels::figures::few_marks;
use crate::viewer::Viewer;
use egui::{RichText, Ui, vec2};
use egui_plot::{MarkerShape, Plot, Points};
use keyleaf::headless::Headless;
use keyleaf::{View, wgpu};
use keyleaf_stage::{ErrorProbe, Pipelines};
use std::collections::VecDeque;

/// Points that are kept.
const KEPT: usize = 80;

/// One measurement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Mean distance of the drawn triangles from the surface over the picture, in pixels.
    pub mean: f32,
    /// What 99 % of the picture is below, in pixels.
    pub p99: f32,
    /// Milliseconds of all passes of the frame.
    pub ms: f32,
}

/// The strip.
#[derive(Debug, Default)]
pub struct Strip {
    /// Whether anybody looks: measuring costs a small picture.
    pub is_open: bool,
    /// Oldest first.
    pub points: VecDeque<Point>,
    measured_at: f64,
}

impl Strip {
    /// Adds a point.
    pub fn push(&mut self, point: Point) {
        if self.points.len() == KEPT {
            self.points.pop_front();
        }
        self.points.push_back(point);
    }
}

/// Seconds between measurements.
const PERIOD: f64 = 0.25;

impl Strip {
    /// Records a measurement of what was just drawn, if somebody looks and the last one is old enough.
    ///
    /// # Errors
    /// The pipelines cannot be made.
    pub fn record(
        &mut self,
        gpu: &Headless,
        encoder: &mut wgpu::CommandEncoder,
        (document, pipelines): (&mut Document, &mut Pipelines),
        view: &View,
        time: f64,
    ) -> anyhow::Result<()> {
        if !self.is_open || time < self.measured_at + PERIOD {
            return Ok(());
        }
        let probe = match &mut document.probe {
            Some(probe) => probe,
            none => none.insert(ErrorProbe::new(gpu, &document.stage, &document.loaded, pipelines)?),
        };
        if probe.record(gpu, encoder, &document.stage, view) {
            self.measured_at = time;
        }
        Ok(())
    }

    /// Takes the measurement that has arrived; what frames cost is that of the last one.
    pub fn collect(&mut self, document: &mut Document, costs: &Costs) {
        let Some(measured) = document.probe.as_mut().and_then(ErrorProbe::take) else {
            return;
        };
        let ms = costs
            .samples
            .back()
            .map(|sample| sample.total().unwrap_or(sample.record));
        self.push(Point {
            mean: measured.mean,
            p99: measured.p99,
            ms: ms.unwrap_or(0.0),
        });
    }
}

/// Shows it.
pub fn show(viewer: &mut Viewer, ui: &mut Ui) {
    viewer.strip.is_open = true;
    let points = &viewer.strip.points;
    Plot::new("strip")
        .height(120.0)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .include_x(0.0)
        .include_y(0.0)
        .include_x(0.25)
        .x_axis_formatter(|mark, _| format!("{} px", mark.value))
        .y_axis_formatter(|mark, _| format!("{} ms", mark.value))
        .y_axis_min_width(44.0)
        .x_grid_spacer(few_marks)
        .y_grid_spacer(few_marks)
        .grid_spacing(egui::Rangef::new(8.0, 24.0))
        .set_margin_fraction(vec2(0.06, 0.08))
        .show(ui, |plot| {
            for (i, point) in points.iter().enumerate() {
                let age = (i + 1) as f32 / points.len() as f32;
                let at = [f64::from(point.mean), f64::from(point.ms)];
                let is_last = i + 1 == points.len();
                let colour = if is_last {
                    palette::PICKED
                } else {
                    palette::ACCENT.gamma_multiply(0.15 + 0.75 * age)
                };
                let marker = Points::new(format!("measurement {i}"), vec![at])
                    .shape(MarkerShape::Circle)
                    .radius(if is_last { 4.5 } else { 2.5 })
                    .color(colour);
                plot.points(marker);
            }
        });
    let text = match points.back() {
        Some(p) => format!("mean {:.3} px, 99 % below {:.3} px, {:.2} ms", p.mean, p.p99, p.ms),
        None => "measured while the scene is drawn".to_owned(),
    };
    ui.label(RichText::new(text).small());
    let tip =
        "mean distance of the drawn triangles from the surface, of a small picture of what is seen; ms of all passes";
    ui.label(
        RichText::new("across: error in pixels; up: milliseconds")
            .small()
            .weak(),
    )
    .on_hover_text(tip);
}
