//! The window's parts.
//!
//! | module | shows |
//! |---|---|
//! | [`top`] | scenes, cameras, switches |
//! | [`viewport`] | the scene, and takes the pointer over it |
//! | [`overlays`] | over the scene: legend, frozen view, picked leaf, messages |
//! | [`figures`] | counts, leaves by level, milliseconds |
//! | [`strip`] | accuracy against time |
//! | [`tuning`], [`tuning_surface`] | settings, live |
//! | [`pick`] | the picked leaf |
//! | [`timeline`] | camera paths |
//! | [`minimap`] | the leaves from above |
//! | [`help`] | keys |

pub mod figures;
pub mod help;
pub mod minimap;
pub mod overlays;
pub mod pick;
pub mod strip;
pub mod timeline;
pub mod top;
pub mod tuning;
pub mod tuning_surface;
pub mod viewport;

use crate::viewer::Viewer;
use egui::{CentralPanel, Frame, Margin, Panel, ScrollArea, Ui};

/// The width of the side panel, in points.
const SIDE: f32 = 308.0;

/// Shows all parts.
pub fn show(viewer: &mut Viewer, ui: &mut Ui, seconds: f64) {
    let fill = ui.visuals().panel_fill;
    let bar = Frame::new().fill(fill).inner_margin(Margin::symmetric(8, 5));
    Panel::top("top")
        .frame(bar)
        .show_separator_line(false)
        .show(ui, |ui| top::show(viewer, ui));
    // A window of a few pixels has room for the scene alone.
    let roomy = ui.ctx().content_rect().size();
    if viewer.shown.timeline && roomy.y > 240.0 {
        Panel::bottom("timeline")
            .frame(bar)
            .show_separator_line(false)
            .show(ui, |ui| timeline::show(viewer, ui));
    }
    if viewer.shown.panel && roomy.x > SIDE + 160.0 {
        let side = Frame::new().fill(fill).inner_margin(Margin {
            left: 10,
            right: 6,
            top: 4,
            bottom: 4,
        });
        Panel::right("side")
            .frame(side)
            .resizable(false)
            .exact_size(SIDE)
            .show_separator_line(false)
            .show(ui, |ui| {
                ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                    ui.set_width(SIDE - 24.0);
                    ui.spacing_mut().slider_width = 84.0;
                    side_panel(viewer, ui);
                });
            });
    }
    CentralPanel::default()
        .frame(Frame::NONE)
        .show(ui, |ui| viewport::show(viewer, ui, seconds));
    help::show(viewer, ui);
}

fn side_panel(viewer: &mut Viewer, ui: &mut Ui) {
    viewer.strip.is_open = false;
    if viewer.picked.is_some() {
        section(ui, "Picked leaf", true, |ui| pick::show(viewer, ui));
    }
    section(ui, "Figures", true, |ui| figures::counts(viewer, ui));
    section(ui, "Leaves by level", true, |ui| figures::levels(viewer, ui));
    section(ui, "Time", true, |ui| figures::times(viewer, ui));
    section(ui, "Accuracy and time", false, |ui| strip::show(viewer, ui));
    section(ui, "Settings", false, |ui| tuning::show(viewer, ui));
    section(ui, "Surface", false, |ui| tuning_surface::show(viewer, ui));
    section(ui, "Light and effects", false, |ui| tuning::light(viewer, ui));
    section(ui, "Device", false, |ui| figures::device(viewer, ui));
}

fn section(ui: &mut Ui, title: &str, open: bool, contents: impl FnOnce(&mut Ui)) {
    let text = egui::RichText::new(title).strong();
    egui::CollapsingHeader::new(text)
        .default_open(open)
        .show_unindented(ui, |ui| {
            contents(ui);
            ui.add_space(6.0);
        });
}

/// A whole number with commas between thousands.
pub fn thousands(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// A length in metres, with the unit that fits it.
pub fn metres(length: f64) -> String {
    match length.abs() {
        l if l >= 10_000.0 => format!("{:.1} km", length / 1000.0),
        l if l >= 100.0 => format!("{length:.0} m"),
        l if l >= 1.0 => format!("{length:.2} m"),
        l if l >= 0.01 => format!("{:.1} cm", length * 100.0),
        _ => format!("{:.3} mm", length * 1000.0),
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn lengths_have_units() {
        let texts = [0.0, 0.0123, 2.5, 523.4, 12_345.0].map(super::metres);
        assert_eq!(texts, ["0.000 mm", "1.2 cm", "2.50 m", "523 m", "12.3 km"]);
    }
}
