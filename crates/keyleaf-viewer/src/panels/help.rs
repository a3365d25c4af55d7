//! The list of keys and gestures.

use crate::action::{GESTURES, SHORTCUTS};
use crate::viewer::Viewer;
use egui::{Align2, Grid, RichText, Ui, Window};

/// Shows it, if it was asked for.
pub fn show(viewer: &mut Viewer, ui: &mut Ui) {
    let mut is_open = viewer.shown.help;
    Window::new("Keys and gestures")
        .open(&mut is_open)
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .collapsible(false)
        .resizable(false)
        .show(ui.ctx(), |ui| {
            ui.horizontal_top(|ui| {
                let (left, right) = SHORTCUTS.split_at(SHORTCUTS.len() / 2);
                for (name, part) in [("left", left), ("right", right)] {
                    Grid::new(name).num_columns(2).spacing([12.0, 4.0]).show(ui, |ui| {
                        part.iter().for_each(|s| row(ui, s.label, s.what));
                    });
                    ui.add_space(18.0);
                }
                Grid::new("gestures")
                    .num_columns(2)
                    .spacing([12.0, 4.0])
                    .show(ui, |ui| {
                        GESTURES.iter().for_each(|(input, what)| row(ui, input, what));
                    });
            });
        });
    viewer.shown.help = is_open;
}

fn row(ui: &mut Ui, input: &str, what: &str) {
    ui.label(RichText::new(input).monospace().strong());
    ui.label(what);
    ui.end_row();
}
