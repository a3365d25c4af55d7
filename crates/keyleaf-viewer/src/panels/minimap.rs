//! The map in the corner: all leaves from above by level, with the camera.

use crate::minimap::view;
use crate::palette;
use crate::projection::Screen;
use crate::viewer::Viewer;
use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, Ui, pos2, vec2};
use keyleaf::View;

/// Shows it, in the lower right corner of the scene.
pub fn show(viewer: &mut Viewer, ui: &mut Ui) {
    let area = viewer.viewport;
    let side = (area.height() * 0.32).clamp(90.0, 220.0);
    let Some(document) = &viewer.document else { return };
    let Some(picture) = viewer.minimap.picture else { return };
    if !viewer.shown.minimap || area.width() < 3.0 * side || area.height() < 1.6 * side {
        return;
    }
    let rect = Rect::from_min_size(area.right_bottom() - vec2(side + 10.0, side + 10.0), vec2(side, side));
    let painter = ui.painter_at(rect.expand(2.0));
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    painter.rect_filled(rect, 6, Color32::from_rgb(18, 20, 25));
    painter.image(picture, rect, whole, Color32::WHITE);
    let map = Screen {
        view: view(document.loaded.bounds),
        rect,
    };
    let inside = painter.with_clip_rect(rect);
    if let Some(frozen) = &document.frozen {
        camera(&inside, &map, frozen, palette::FROZEN);
    }
    camera(&inside, &map, &viewer.view(), Color32::WHITE);
    painter.rect_stroke(rect, 6, Stroke::new(1.0, Color32::from_gray(70)), StrokeKind::Outside);
    let font = FontId::proportional(11.0);
    painter.text(
        rect.center_top() + vec2(0.0, 3.0),
        Align2::CENTER_TOP,
        "N",
        font,
        Color32::WHITE,
    );
}

/// The eye, and what it sees, from above.
fn camera(painter: &Painter, map: &Screen, view: &View, colour: Color32) {
    // The map looks along the vertical: points above its near plane are seen as well.
    let place = |p: glam::DVec3| map.point(glam::DVec3::new(p.x, map.view.eye.y - 1e-6, p.z));
    let reach = 0.3 * map.view_height();
    let [left, right, ..] = Screen::corners(view, reach);
    let (Some(eye), Some(left), Some(right)) = (place(view.eye), place(left), place(right)) else {
        return;
    };
    let keep = |p: Pos2| pos2(p.x.clamp(-4000.0, 4000.0), p.y.clamp(-4000.0, 4000.0));
    let corners = vec![keep(eye), keep(left), keep(right)];
    painter.add(Shape::convex_polygon(
        corners.clone(),
        colour.gamma_multiply(0.22),
        Stroke::NONE,
    ));
    painter.add(Shape::line(
        vec![corners[1], corners[0], corners[2]],
        Stroke::new(1.2, colour),
    ));
    painter.circle_filled(corners[0], 3.5, Color32::BLACK);
    painter.circle_filled(corners[0], 2.5, colour);
}
