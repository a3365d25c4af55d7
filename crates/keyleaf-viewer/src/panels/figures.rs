//! Counts, leaves by level, milliseconds, the device.

use crate::costs::{self, Costs, ROWS, Sample};
use crate::palette;
use crate::panels::thousands;
use crate::viewer::Viewer;
use egui::{Align2, Color32, FontId, Grid, ProgressBar, Rect, RichText, Sense, Ui, pos2, vec2};
use egui_plot::{GridInput, GridMark, HLine, Line, LineStyle, Plot, PlotPoints};

/// How many leaves, triangles and changes.
pub fn counts(viewer: &mut Viewer, ui: &mut Ui) {
    let Some(s) = viewer.document.as_ref().and_then(|d| d.statistics()) else {
        ui.weak("no figures yet");
        return;
    };
    Grid::new("counts").num_columns(2).spacing([10.0, 3.0]).show(ui, |ui| {
        let mut row = |name: &str, tip: &str, value: String| {
            ui.label(RichText::new(name).weak()).on_hover_text(tip);
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                ui.label(RichText::new(value).monospace());
            });
            ui.end_row();
        };
        row("leaves", "alive, in view or not", thousands(s.leaves.into()));
        row(
            "drawn",
            "leaves in view; a pair counts once",
            thousands(s.visible.into()),
        );
        row("triangles", "drawn: each leaf is 4^k of them", thousands(s.triangles));
        row(
            "splits a frame",
            "halves of diamonds, in the last pass",
            thousands(s.splits.into()),
        );
        row(
            "merges a frame",
            "halves of diamonds, in the last pass",
            thousands(s.merges.into()),
        );
        row(
            "starved",
            "leaves that wish to split and do not fit the capacity",
            thousands(s.starved.into()),
        );
        let raised = format!("× {:.2}", s.threshold_factor);
        row(
            "threshold",
            "factor by which starvation or the target count have raised it",
            raised,
        );
        row(
            "table in use",
            "entries of the leaf table, tombstones included",
            format!("{:.0} %", s.table_load * 100.0),
        );
    });
    let part = s.leaves as f32 / s.capacity.max(1) as f32;
    let text = format!("{:.0} % of {} leaves", part * 100.0, thousands(s.capacity.into()));
    ui.add(
        ProgressBar::new(part)
            .desired_height(15.0)
            .text(RichText::new(text).small()),
    )
    .on_hover_text("leaves over the capacity of the buffers");
}

/// A bar for each level.
pub fn levels(viewer: &mut Viewer, ui: &mut Ui) {
    let counts = &viewer.levels.counts;
    let Some(first) = counts.iter().position(|n| *n > 0) else {
        ui.weak("counted when the leaves have settled");
        return;
    };
    let counts = &counts[first..];
    let most = counts.iter().copied().max().unwrap_or(1).max(1) as f32;
    let (response, painter) = ui.allocate_painter(vec2(ui.available_width(), 76.0), Sense::hover());
    let rect = response.rect;
    let step = rect.width() / counts.len() as f32;
    let ink = ui.visuals().text_color();
    for (i, &count) in counts.iter().enumerate() {
        let level = (first + i) as u32;
        let x = rect.left() + i as f32 * step;
        let height = (count as f32 / most) * (rect.height() - 16.0);
        let base = rect.bottom() - 14.0;
        let bar = Rect::from_min_max(pos2(x + 1.0, base - height.max(1.0)), pos2(x + step - 1.0, base));
        painter.rect_filled(bar, 2, palette::level(level));
        let at = pos2(x + step / 2.0, rect.bottom());
        painter.text(at, Align2::CENTER_BOTTOM, level, FontId::proportional(10.0), ink);
    }
    if let Some(at) = response.hover_pos() {
        let i = (((at.x - rect.left()) / step) as usize).min(counts.len() - 1);
        let text = format!("level {}: {} leaves", first + i, thousands(counts[i].into()));
        response.on_hover_text_at_pointer(text);
    }
}

/// Milliseconds of the last frames, as a plot and by pass.
pub fn times(viewer: &mut Viewer, ui: &mut Ui) {
    let costs = &viewer.costs;
    if costs.samples.is_empty() {
        ui.weak("no frame yet");
        return;
    }
    plot(costs, ui);
    Grid::new("passes")
        .num_columns(4)
        .spacing([10.0, 2.0])
        .striped(true)
        .show(ui, |ui| {
            for (text, tip) in [
                ("", ""),
                ("ms", "by the clock named below"),
                ("median", "of the frames of the plot"),
                ("p99", "99 % of these frames took less"),
            ] {
                ui.label(RichText::new(text).small().weak()).on_hover_text(tip);
            }
            ui.end_row();
            for (row, name) in costs::names().into_iter().enumerate() {
                passes_row(ui, name, palette::pass(row), costs, move |s| s.device.map(|d| d[row]));
            }
            passes_row(ui, "all passes", ui.visuals().text_color(), costs, Sample::total);
            passes_row(ui, "CPU, recording", Color32::GRAY, costs, |s| Some(s.record));
        });
    let clock = match (costs.samples.back().and_then(|s| s.device), viewer.device.is_software) {
        (None, _) => "the device has no timestamps",
        (Some(_), true) => "timestamps of a software device: not GPU times",
        (Some(_), false) => "timestamps of the device",
    };
    ui.label(RichText::new(clock).small().weak());
}

fn plot(costs: &Costs, ui: &mut Ui) {
    let median = costs.spread(Sample::total);
    Plot::new("times")
        .height(92.0)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .show_x(false)
        .show_grid([false, true])
        .show_axes([false, true])
        .include_y(0.0)
        .include_x(0.0)
        .include_x(costs::FRAMES as f64)
        .y_axis_formatter(|mark, _| format!("{} ms", mark.value))
        .y_axis_min_width(44.0)
        .y_grid_spacer(few_marks)
        .grid_spacing(egui::Rangef::new(8.0, 24.0))
        .set_margin_fraction(vec2(0.0, 0.08))
        .show(ui, |plot| {
            let offset = costs::FRAMES - costs.samples.len();
            let series = |of: &dyn Fn(&Sample) -> Option<f32>| -> PlotPoints<'static> {
                let all = costs.samples.iter().enumerate();
                all.filter_map(|(i, s)| Some([(offset + i) as f64, of(s)?.into()]))
                    .collect()
            };
            for row in 0..ROWS {
                let points = series(&|s: &Sample| s.device.map(|d| d[row]));
                plot.line(
                    Line::new(costs::names()[row], points)
                        .color(palette::pass(row))
                        .width(1.0),
                );
            }
            let all = series(&Sample::total);
            plot.line(Line::new("all passes", all).color(palette::ACCENT).width(1.8));
            if let Some((median, p99)) = median {
                let line = |name, at: f32| {
                    HLine::new(name, at)
                        .color(Color32::GRAY)
                        .style(LineStyle::dashed_dense())
                        .width(1.0)
                };
                plot.hline(line("median", median));
                plot.hline(line("p99", p99));
            }
        });
}

/// Two or three marks between the bounds, at a number that is easy to read.
pub(super) fn few_marks(input: GridInput) -> Vec<GridMark> {
    let (low, high) = input.bounds;
    let third = ((high - low) / 2.2).max(1e-9);
    let power = 10f64.powf(third.log10().floor());
    let step = [5.0, 2.0, 1.0]
        .map(|n| n * power)
        .into_iter()
        .find(|s| *s <= third)
        .unwrap_or(power);
    let first = (low / step).ceil() as i64;
    (first..=first + 4)
        .map(|i| i as f64 * step)
        .filter(|value| *value <= high)
        .map(|value| GridMark { value, step_size: step })
        .collect()
}

fn passes_row(ui: &mut Ui, name: &str, colour: Color32, costs: &Costs, of: impl Fn(&Sample) -> Option<f32>) {
    ui.horizontal(|ui| {
        let (rect, _) = ui.allocate_exact_size(vec2(8.0, 8.0), Sense::hover());
        ui.painter().rect_filled(rect, 2, colour);
        ui.label(RichText::new(name).small());
    });
    let mut cell = |ms: Option<f32>| {
        let text = ms.map_or("–".to_owned(), |ms| format!("{ms:7.2}"));
        ui.label(RichText::new(text).small().monospace());
    };
    cell(costs.samples.back().and_then(&of));
    let spread = costs.spread(&of);
    cell(spread.map(|(median, _)| median));
    cell(spread.map(|(_, p99)| p99));
    ui.end_row();
}

/// What draws, and how it presents.
pub fn device(viewer: &mut Viewer, ui: &mut Ui) {
    let device = &viewer.device;
    let bytes: u64 = viewer
        .document
        .iter()
        .flat_map(|d| d.stage.memory())
        .map(|(_, _, bytes)| bytes)
        .sum();
    for text in [
        device.name.clone(),
        device.driver.clone(),
        format!("present: {}", device.present),
        format!("scene: {:.1} MiB on the device", bytes as f64 / f64::from(1 << 20)),
        format!("picture: {} × {} px", viewer.pixels.x, viewer.pixels.y),
    ] {
        ui.add(egui::Label::new(RichText::new(text).small()).wrap());
    }
}
