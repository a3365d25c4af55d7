//! The bar above: scenes, cameras, switches.

use crate::action::Action;
use crate::camera::Mode;
use crate::library;
use crate::viewer::Viewer;
use egui::{Align, Layout, RichText, Ui};
use keyleaf::shading::Tint;

/// The width of the switches on the right, in points.
const PARTS: f32 = 190.0;

/// Shows the bar.
pub fn show(viewer: &mut Viewer, ui: &mut Ui) {
    ui.horizontal_wrapped(|ui| {
        scenes(viewer, ui);
        cameras(viewer, ui);
        ui.separator();
        modes(viewer, ui);
        ui.separator();
        looks(viewer, ui);
        ui.separator();
        freeze(viewer, ui);
        if ui.max_rect().right() - ui.cursor().left() < PARTS {
            ui.end_row();
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| parts(viewer, ui));
    });
}

/// Switches of the window's parts, from the right.
fn parts(viewer: &mut Viewer, ui: &mut Ui) {
    let theme = if viewer.shown.light { "Dark" } else { "Light" };
    let all = [
        (viewer.shown.help, "?", "keys and gestures  (?)", Action::Help),
        (false, theme, "the other theme  (T)", Action::Theme),
        (viewer.shown.panel, "Panel", "figures and settings  (I)", Action::Panel),
        (
            viewer.shown.minimap,
            "Map",
            "all leaves from above  (M)",
            Action::Minimap,
        ),
    ];
    for (is_on, label, tip, action) in all {
        if switch(ui, is_on, label, tip) {
            viewer.actions.push(action);
        }
    }
}

fn switch(ui: &mut Ui, is_on: bool, label: &str, tip: &str) -> bool {
    ui.selectable_label(is_on, label).on_hover_text(tip).clicked()
}

fn scenes(viewer: &mut Viewer, ui: &mut Ui) {
    let title = match &viewer.document {
        Some(document) => RichText::new(document.name()).strong(),
        None => RichText::new("Open…").strong(),
    };
    ui.menu_button(title, |ui| {
        ui.set_min_width(180.0);
        if viewer.library.is_empty() {
            ui.label("Drop a scene, a model or a height map on the window.");
        }
        egui::ScrollArea::vertical().max_height(420.0).show(ui, |ui| {
            for scene in &viewer.library {
                if ui.button(library::title(scene)).clicked() {
                    viewer.actions.push(Action::Open(scene.clone()));
                    ui.close();
                }
            }
        });
        ui.separator();
        if ui.button("Open again  (F5)").clicked() {
            viewer.actions.push(Action::Reload);
            ui.close();
        }
        if ui.button("Picture  (P)").clicked() {
            viewer.actions.push(Action::Screenshot { whole: true });
            ui.close();
        }
        if ui.button("Export the triangles seen  (X)").clicked() {
            viewer.actions.push(Action::Export);
            ui.close();
        }
    })
    .response
    .on_hover_text("scenes that are shipped; or drop a file on the window");
}

fn cameras(viewer: &mut Viewer, ui: &mut Ui) {
    ui.menu_button("Camera", |ui| {
        ui.set_min_width(150.0);
        if ui.button("Frame all  (F)").clicked() {
            viewer.actions.push(Action::Frame);
            ui.close();
        }
        let cameras = viewer.document.iter().flat_map(|d| &d.loaded.scene.cameras);
        for (number, camera) in cameras.enumerate() {
            if ui.button(&camera.name).clicked() {
                viewer.actions.push(Action::GoTo(number));
                ui.close();
            }
        }
        ui.separator();
        if ui.button("Copy as scene camera").clicked() {
            viewer.actions.push(Action::CopyCamera);
            ui.close();
        }
    })
    .response
    .on_hover_text("cameras of the scene");
}

fn modes(viewer: &mut Viewer, ui: &mut Ui) {
    let modes = [
        (
            Mode::Orbit,
            "Orbit",
            "drag turns about the pivot, double click sets it  (O)",
        ),
        (Mode::Fly, "Fly", "W A S D, E, Q; the wheel sets the speed  (G)"),
    ];
    for (mode, label, tip) in modes {
        let is_on = viewer.camera.mode == mode;
        if switch(ui, is_on, label, tip) {
            viewer.actions.push(Action::SetMode(mode));
        }
    }
}

fn looks(viewer: &mut Viewer, ui: &mut Ui) {
    let look = viewer.document.as_ref().map(|d| d.look).unwrap_or_default();
    let mut add = |is_on: bool, label: &str, tip: &str, action: Action| {
        if switch(ui, is_on, label, tip) {
            viewer.actions.push(action);
        }
    };
    add(
        look.wireframe,
        "Wireframe",
        "edges of the drawn triangles  (1)",
        Action::Wireframe,
    );
    let tints = [
        (
            Tint::Level,
            "Levels",
            "a colour for each level; each level halves the edges  (2)",
        ),
        (
            Tint::Pairs,
            "Pairs",
            "leaves beside coarser ones, drawn as one triangle: no T-junction  (3)",
        ),
        (
            Tint::Wish,
            "Changes",
            "how near each leaf is to its next split or merge  (4)",
        ),
        (
            Tint::Morph,
            "Morph",
            "how far new vertices have come to the surface, where they morph  (8)",
        ),
        (Tint::Normal, "Normals", "directions of the surface  (5)"),
        (
            Tint::Error,
            "Error",
            "distance of the triangles from the surface in pixels  (6)",
        ),
    ];
    for (tint, label, tip) in tints {
        add(look.tint == tint && !look.overdraw, label, tip, Action::Tint(tint));
    }
    add(
        look.overdraw,
        "Overdraw",
        "how often each pixel is drawn  (7)",
        Action::Overdraw,
    );
}

fn freeze(viewer: &mut Viewer, ui: &mut Ui) {
    let is_on = viewer.document.as_ref().is_some_and(|d| d.frozen.is_some());
    let tip = "stop refining and look at the leaves from elsewhere  (Z)";
    if switch(ui, is_on, "Freeze", tip) {
        viewer.actions.push(Action::Freeze);
    }
}
