//! The scene, and the pointer over it.

use crate::action::Action;
use crate::camera::{Keys, Mode};
use crate::panels::{minimap, overlays};
use crate::viewer::Viewer;
use egui::{Color32, CursorIcon, Key, PointerButton, Rect, Response, Sense, Ui, pos2};
use glam::{DVec2, DVec3, UVec2};

/// Shows the scene in what is left of the window.
pub fn show(viewer: &mut Viewer, ui: &mut Ui, seconds: f64) {
    let rect = ui.available_rect_before_wrap();
    let response = ui.allocate_rect(rect, Sense::click_and_drag());
    viewer.viewport = rect;
    let pixels = rect.size() * ui.ctx().pixels_per_point();
    viewer.pixels = UVec2::new(pixels.x.round().max(1.0) as u32, pixels.y.round().max(1.0) as u32);
    if viewer.document.is_some() {
        pointer(viewer, ui, &response);
        fly(viewer, ui, seconds);
    }
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    match viewer.picture {
        Some(picture) if viewer.document.is_some() => ui.painter().image(picture, rect, whole, Color32::WHITE),
        _ => ui.painter().rect_filled(rect, 0, Color32::from_rgb(15, 17, 21)),
    };
    overlays::show(viewer, ui);
    minimap::show(viewer, ui);
}

/// Gestures: all motions in parts of the picture's height, so that they do not depend on the window.
fn pointer(viewer: &mut Viewer, ui: &Ui, response: &Response) {
    let height = f64::from(viewer.viewport.height().max(1.0));
    let drag = response.drag_delta();
    let drag = DVec2::new(drag.x.into(), drag.y.into()) / height;
    let (is_shift, scroll, zoom) = ui.input(|i| (i.modifiers.shift, i.smooth_scroll_delta(), i.zoom_delta()));
    let is_sideways = response.dragged_by(PointerButton::Secondary)
        || response.dragged_by(PointerButton::Middle)
        || (response.dragged_by(PointerButton::Primary) && is_shift && viewer.camera.mode == Mode::Orbit);
    let before = viewer.camera;
    if is_sideways {
        viewer.camera.pan(drag);
    } else if response.dragged_by(PointerButton::Primary) {
        viewer.camera.turn(drag);
    }
    if response.hovered() {
        const POINTS_A_NOTCH: f32 = 50.0;
        let notches = scroll.y / POINTS_A_NOTCH + zoom.ln() / 1.1f32.ln();
        if notches != 0.0 {
            viewer.camera.wheel(notches.into());
        }
        if response.dragged() {
            ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
        }
    }
    if viewer.camera != before {
        viewer.let_go_of_path();
    }
    let at = response.interact_pointer_pos();
    if response.double_clicked() {
        viewer.actions.extend(at.map(Action::Pivot));
    } else if response.clicked() {
        viewer.actions.push(Action::Pick(at));
    }
}

/// Keys that are held move the camera in flight.
fn fly(viewer: &mut Viewer, ui: &Ui, seconds: f64) {
    if viewer.camera.mode != Mode::Fly || ui.ctx().text_edit_focused() {
        return;
    }
    let keys = ui.input(|input| {
        if input.modifiers.command {
            return Keys::default();
        }
        let axis = |more: Key, less: Key| f64::from(input.key_down(more)) - f64::from(input.key_down(less));
        let towards = DVec3::new(axis(Key::D, Key::A), axis(Key::E, Key::Q), axis(Key::W, Key::S));
        Keys {
            towards,
            fast: input.modifiers.shift,
        }
    });
    if keys.towards == DVec3::ZERO {
        return;
    }
    let height = viewer
        .document
        .as_ref()
        .map_or(1.0, |d| crate::ground::height_above(d, viewer.camera.eye));
    if viewer.camera.fly(keys, height, seconds) {
        viewer.let_go_of_path();
        viewer.is_moving = true;
    }
}
