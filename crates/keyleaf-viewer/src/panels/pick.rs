//! The picked leaf: its key, where it is, what it wishes, what is beside it.

use crate::palette;
use crate::panels::metres;
use crate::viewer::Viewer;
use egui::{Grid, RichText, Ui};

/// Shows it.
pub fn show(viewer: &mut Viewer, ui: &mut Ui) {
    let Some(picked) = &viewer.picked else { return };
    let colour = palette::picked(ui.visuals().dark_mode);
    Grid::new("picked").num_columns(2).spacing([10.0, 3.0]).show(ui, |ui| {
        let mut row = |name: &str, tip: &str, value: RichText| {
            ui.label(RichText::new(name).weak()).on_hover_text(tip);
            ui.add(egui::Label::new(value).wrap());
            ui.end_row();
        };
        row("surface", "its name in the scene", RichText::new(&picked.surface));
        let digits = RichText::new(picked.digits()).monospace().color(colour).strong();
        row(
            "key",
            "the digits of the key, a child 0 to 3 for each level, root first",
            digits,
        );
        let level = picked.place.level;
        row(
            "level",
            "how often the root was split",
            RichText::new(level.to_string()),
        );
        let place = format!("{}, root {}", picked.place.face, picked.place.root);
        row(
            "face",
            "of the control mesh, and the corner of its fan",
            RichText::new(place),
        );
        let pair = if picked.is_pair { "yes" } else { "no" };
        row(
            "pair",
            "drawn as one triangle with its other half: beside a coarser leaf, or where the threshold allows",
            RichText::new(pair),
        );
        row(
            "metric",
            "bound of the metric and its threshold",
            RichText::new(&picked.metric),
        );
        row(
            "wish",
            "metric over threshold; above 1 it splits",
            RichText::new(format!("{:.3}", picked.wish)),
        );
        let [x, y, z] = picked.position.to_array();
        row(
            "at",
            "world position in metres",
            RichText::new(format!("{x:.3}, {y:.3}, {z:.3} m")),
        );
        row("distance", "from the eye", RichText::new(metres(picked.distance)));
        for (side, leaf) in &picked.neighbours {
            row(side, "the leaf across this side", RichText::new(leaf));
        }
    });
}
