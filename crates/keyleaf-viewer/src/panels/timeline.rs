//! Camera paths: choose, play, scrub, record.

use crate::action::Action;
use crate::camera::path::Motion;
use crate::palette;
use crate::viewer::Viewer;
use egui::{ComboBox, RichText, Slider, Ui};

/// Shows the time line.
pub fn show(viewer: &mut Viewer, ui: &mut Ui) {
    ui.horizontal(|ui| {
        let motion = viewer.timeline.motion;
        let label = if motion == Motion::Playing { "Pause" } else { "Play" };
        let has_path = viewer.path().is_some();
        let play = ui.add_enabled(has_path && motion != Motion::Recording, egui::Button::new(label));
        if play.on_hover_text("play or pause the camera path  (Space)").clicked() {
            viewer.actions.push(Action::Play);
        }
        let is_recording = motion == Motion::Recording;
        let dot = RichText::new(if is_recording { "Stop" } else { "Record" }).color(palette::ALARM);
        let tip = "record a camera path while you move; again to end it and save it as a file  (R)";
        if ui
            .add_enabled(viewer.document.is_some(), egui::Button::new(dot))
            .on_hover_text(tip)
            .clicked()
        {
            viewer.actions.push(Action::Record);
        }
        if is_recording {
            ui.label(RichText::new(format!("recording  {:.1} s", viewer.timeline.time)).color(palette::ALARM));
            return;
        }
        paths(viewer, ui);
        scrub(viewer, ui);
    });
}

fn paths(viewer: &mut Viewer, ui: &mut Ui) {
    let names: Vec<String> = viewer
        .document
        .iter()
        .flat_map(|d| &d.loaded.scene.paths)
        .map(|path| path.name.clone())
        .collect();
    let now = names.get(viewer.timeline.chosen).cloned().unwrap_or_default();
    ComboBox::from_id_salt("path")
        .selected_text(now)
        .width(110.0)
        .show_ui(ui, |ui| {
            for (number, name) in names.iter().enumerate() {
                if ui.selectable_label(number == viewer.timeline.chosen, name).clicked() {
                    viewer.actions.push(Action::ChoosePath(number));
                }
            }
        })
        .response
        .on_hover_text("the camera path");
}

fn scrub(viewer: &mut Viewer, ui: &mut Ui) {
    let Some(path) = viewer.path() else { return };
    let duration = path.duration();
    let mut time = viewer.timeline.time.min(duration);
    let text = format!("{time:.2} / {duration:.2} s");
    ui.label(RichText::new(text).monospace().small());
    ui.spacing_mut().slider_width = (ui.available_width() - 12.0).max(40.0);
    let slider = Slider::new(&mut time, 0.0..=duration.max(1e-9))
        .show_value(false)
        .trailing_fill(true);
    if ui.add(slider).on_hover_text("time on the path, in seconds").changed() {
        viewer.actions.push(Action::Scrub(time));
    }
}
