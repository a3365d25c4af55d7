//! Over the scene: what the colours mean, the frozen view, the picked leaf, and what is said.

use crate::palette;
use crate::panels::{metres, thousands};
use crate::projection::Screen;
use crate::viewer::Viewer;
use egui::{Align2, Area, Color32, FontId, Frame, Id, Margin, Painter, Pos2, Rect, Shape, Stroke, Ui, pos2, vec2};
use keyleaf::Morph;
use keyleaf::shading::Tint;

/// What is written over the scene stands on this.
const BACK: Color32 = Color32::from_rgba_premultiplied(10, 12, 15, 205);
const INK: Color32 = Color32::from_rgb(232, 236, 241);
const FAINT: Color32 = Color32::from_rgb(160, 168, 178);
const MARGIN: f32 = 10.0;

/// Shows all of it.
pub fn show(viewer: &mut Viewer, ui: &mut Ui) {
    let painter = ui.painter_at(viewer.viewport);
    let screen = Screen {
        view: viewer.view(),
        rect: viewer.viewport,
    };
    frozen(viewer, &painter, &screen);
    picked(viewer, &painter, &screen);
    if viewer.viewport.width() > 260.0 && viewer.viewport.height() > 150.0 {
        legend(viewer, &painter);
        state(viewer, &painter);
    }
    message(viewer, ui);
}

/// The pyramid of the frozen view.
fn frozen(viewer: &Viewer, painter: &Painter, screen: &Screen) {
    let Some(document) = &viewer.document else { return };
    let Some(view) = document.frozen else { return };
    if view == screen.view {
        return;
    }
    let (low, high) = document.loaded.bounds;
    let far = (view.eye.distance((low + high) / 2.0) + 0.1 * (high - low).length()).min((high - low).length());
    let corners = Screen::corners(&view, far);
    let line = |from, to, width: f32, alpha: f32| {
        if let Some(points) = screen.segment(from, to) {
            let outside = Stroke::new(width + 2.0, Color32::from_black_alpha(110));
            painter.line_segment(points, outside);
            painter.line_segment(points, Stroke::new(width, palette::FROZEN.gamma_multiply(alpha)));
        }
    };
    for i in 0..4 {
        line(view.eye, corners[i], 1.6, 1.0);
        line(corners[i], corners[(i + 1) % 4], 1.2, 0.7);
    }
    if let Some(eye) = screen.point(view.eye) {
        painter.circle_filled(eye, 5.0, Color32::BLACK);
        painter.circle_filled(eye, 3.5, palette::FROZEN);
    }
}

fn picked(viewer: &Viewer, painter: &Painter, screen: &Screen) {
    let Some(picked) = &viewer.picked else { return };
    for pair in picked.outline.windows(2) {
        if let Some(points) = screen.segment(pair[0], pair[1]) {
            painter.line_segment(points, Stroke::new(4.0, Color32::from_black_alpha(160)));
            painter.line_segment(points, Stroke::new(2.0, palette::PICKED));
        }
    }
    if let Some(at) = screen.point(picked.position) {
        painter.circle_stroke(at, 4.0, Stroke::new(1.5, palette::PICKED));
        let text = format!("level {}", picked.place.level);
        label(painter, at + vec2(9.0, -18.0), Align2::LEFT_TOP, &text, palette::PICKED);
    }
}

/// Text on a dark plate; its rectangle.
fn label(painter: &Painter, at: Pos2, anchor: Align2, text: &str, colour: Color32) -> Rect {
    let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(12.0), colour);
    let rect = anchor.anchor_size(at, galley.size() + vec2(12.0, 6.0));
    painter.rect_filled(rect, 5, BACK);
    painter.galley(rect.min + vec2(6.0, 3.0), galley, colour);
    rect
}

/// Whether the leaves have settled, and how many there are.
fn state(viewer: &Viewer, painter: &Painter) {
    let Some(document) = &viewer.document else { return };
    let Some(statistics) = document.statistics() else {
        return;
    };
    let (word, colour) = match (document.frozen.is_some(), document.is_settled()) {
        (true, _) => ("frozen: the camera moves, the leaves stay", palette::FROZEN),
        (_, true) if statistics.starved > 0 => ("settled, short of capacity", palette::PICKED),
        (_, true) => ("settled", Color32::from_rgb(120, 210, 130)),
        (_, false) => ("refining", Color32::from_rgb(255, 190, 90)),
    };
    let text = format!("{word}  ·  {} leaves", thousands(statistics.leaves.into()));
    let at = viewer.viewport.left_top() + vec2(MARGIN, MARGIN);
    let galley = painter.layout_no_wrap(text, FontId::proportional(12.0), INK);
    let rect = Rect::from_min_size(at, galley.size() + vec2(28.0, 8.0));
    painter.rect_filled(rect, 5, BACK);
    painter.circle_filled(rect.left_center() + vec2(11.0, 0.0), 4.0, colour);
    painter.galley(rect.min + vec2(21.0, 4.0), galley, INK);
}

/// What the colours mean.
fn legend(viewer: &Viewer, painter: &Painter) {
    let Some(document) = &viewer.document else { return };
    let at = viewer.viewport.left_bottom() + vec2(MARGIN, -MARGIN);
    if document.look.overdraw {
        let text = "overdraw: each triangle adds light";
        label(painter, at, Align2::LEFT_BOTTOM, text, INK);
        return;
    }
    match document.look.tint {
        Tint::None => {
            let (eye, pivot) = (viewer.camera.eye, viewer.camera.pivot);
            let text = format!("eye {} from the pivot", metres(eye.distance(pivot)));
            label(painter, at, Align2::LEFT_BOTTOM, &text, FAINT);
        }
        Tint::Level => level_legend(viewer, painter, at),
        Tint::Pairs => {
            let text = "red: pairs, two leaves drawn as one triangle";
            label(painter, at, Align2::LEFT_BOTTOM, text, INK);
        }
        Tint::Wish => {
            let ticks = [(0.0, "1/4 may merge"), (2.0 / 3.0, "1"), (1.0, "2 splits")];
            scale_legend(painter, at, "metric over threshold", &ticks);
        }
        Tint::Morph => {
            let morphs = document.loaded.objects.iter().any(|o| o.settings.morph != Morph::None);
            if morphs {
                let ticks = [(0.0, "on the edge"), (1.0, "arrived")];
                scale_legend(painter, at, "vertices on their way to the surface", &ticks);
            } else {
                let text = "no vertex morphs: see \"morph\" among the settings";
                label(painter, at, Align2::LEFT_BOTTOM, text, INK);
            }
        }
        Tint::Normal => {
            let text = "normals: red east, green up, blue south";
            label(painter, at, Align2::LEFT_BOTTOM, text, INK);
        }
        Tint::Error => {
            let ticks = [(0.0, "1/16"), (1.0 / 3.0, "1/4"), (2.0 / 3.0, "1"), (1.0, "4 px")];
            scale_legend(painter, at, "distance of triangles from the surface, pixels", &ticks);
        }
    }
}

/// A chip for each level that there is.
fn level_legend(viewer: &Viewer, painter: &Painter, at: Pos2) {
    let counts = &viewer.levels.counts;
    let levels: Vec<u32> = (0..counts.len() as u32).filter(|l| counts[*l as usize] > 0).collect();
    if levels.is_empty() {
        label(painter, at, Align2::LEFT_BOTTOM, "a colour for each level", INK);
        return;
    }
    const CHIP: f32 = 22.0;
    let title = painter.layout_no_wrap("level, coarse to fine".to_owned(), FontId::proportional(12.0), INK);
    let width = (levels.len() as f32 * CHIP).max(title.size().x) + 14.0;
    let rect = Rect::from_min_size(at - vec2(0.0, 46.0), vec2(width, 46.0));
    painter.rect_filled(rect, 5, BACK);
    painter.galley(rect.min + vec2(7.0, 4.0), title, INK);
    for (i, &level) in levels.iter().enumerate() {
        let chip = Rect::from_min_size(rect.min + vec2(7.0 + i as f32 * CHIP, 22.0), vec2(CHIP - 2.0, 18.0));
        painter.rect_filled(chip, 3, palette::level(level));
        let font = FontId::proportional(11.0);
        painter.text(
            chip.center(),
            Align2::CENTER_CENTER,
            level,
            font,
            Color32::from_gray(25),
        );
    }
}

fn scale_legend(painter: &Painter, at: Pos2, title: &str, ticks: &[(f32, &str)]) {
    const WIDTH: f32 = 240.0;
    let rect = Rect::from_min_size(at - vec2(0.0, 56.0), vec2(WIDTH + 44.0, 56.0));
    painter.rect_filled(rect, 5, BACK);
    let font = FontId::proportional(12.0);
    painter.text(rect.min + vec2(8.0, 4.0), Align2::LEFT_TOP, title, font, INK);
    let bar = Rect::from_min_size(rect.min + vec2(20.0, 23.0), vec2(WIDTH, 10.0));
    let mut mesh = egui::Mesh::default();
    const STEPS: u32 = 48;
    for i in 0..=STEPS {
        let t = i as f32 / STEPS as f32;
        let x = bar.left() + t * bar.width();
        mesh.colored_vertex(pos2(x, bar.top()), palette::scale(t));
        mesh.colored_vertex(pos2(x, bar.bottom()), palette::scale(t));
        if i > 0 {
            let n = 2 * i;
            mesh.add_triangle(n - 2, n - 1, n);
            mesh.add_triangle(n - 1, n + 1, n);
        }
    }
    painter.add(Shape::mesh(mesh));
    for (t, text) in ticks {
        let at = pos2(bar.left() + t * bar.width(), bar.bottom() + 2.0);
        painter.line_segment([at - vec2(0.0, 4.0), at + vec2(0.0, 2.0)], Stroke::new(1.0, INK));
        let anchor = match *t {
            t if t <= 0.0 => Align2::LEFT_TOP,
            t if t >= 1.0 => Align2::RIGHT_TOP,
            _ => Align2::CENTER_TOP,
        };
        let shift = if *t <= 0.0 {
            -12.0
        } else if *t >= 1.0 {
            12.0
        } else {
            0.0
        };
        painter.text(at + vec2(shift, 2.0), anchor, text, FontId::proportional(11.0), INK);
    }
}

/// What is said, above the scene; errors can be closed.
fn message(viewer: &mut Viewer, ui: &mut Ui) {
    if let Some(file) = &viewer.opening {
        let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let at = viewer.viewport.center();
        label(
            &ui.painter_at(viewer.viewport),
            at,
            Align2::CENTER_CENTER,
            &format!("Opening {name} …"),
            INK,
        );
    } else if viewer.document.is_none() && viewer.message.is_none() {
        let at = viewer.viewport.center();
        let text = "Drop a scene, a model or a height map here, or choose one above";
        label(&ui.painter_at(viewer.viewport), at, Align2::CENTER_CENTER, text, INK);
    }
    let Some(message) = viewer.message.clone() else { return };
    let colour = if message.is_error {
        palette::ALARM
    } else {
        palette::ACCENT
    };
    let width = (viewer.viewport.width() - 90.0).clamp(80.0, 620.0);
    let at = viewer.viewport.center_top() + vec2(0.0, 44.0);
    Area::new(Id::unique("message"))
        .fixed_pos(at)
        .pivot(Align2::CENTER_TOP)
        .constrain_to(viewer.viewport)
        .fade_in(false)
        .show(ui.ctx(), |ui| {
            Frame::new()
                .fill(Color32::from_rgb(27, 30, 36))
                .stroke(Stroke::new(1.0, colour))
                .corner_radius(6)
                .inner_margin(Margin::symmetric(12, 8))
                .show(ui, |ui| {
                    ui.set_max_width(width);
                    ui.horizontal_top(|ui| {
                        let text = egui::RichText::new(message.text.trim()).color(INK);
                        // What compilers say points at columns.
                        let is_code = message.text.contains('\n');
                        let text = if is_code { text.monospace() } else { text };
                        ui.add(egui::Label::new(text).wrap());
                        if message.is_error && ui.small_button("×").on_hover_text("close").clicked() {
                            viewer.message = None;
                        }
                    });
                });
        });
}
