//! Colours: of the window, and of the scales that shaders paint on surfaces.

use egui::{Color32, CornerRadius, Stroke, Theme, Visuals};

/// What is pressed, chosen, or to be looked at.
pub const ACCENT: Color32 = Color32::from_rgb(72, 168, 255);
/// What is recorded, or wrong.
pub const ALARM: Color32 = Color32::from_rgb(235, 87, 76);
/// What is held: the frozen view.
pub const FROZEN: Color32 = Color32::from_rgb(112, 214, 255);
/// The picked leaf.
pub const PICKED: Color32 = Color32::from_rgb(255, 214, 64);

/// The colour of the picked leaf as text.
pub fn picked(dark: bool) -> Color32 {
    if dark { PICKED } else { Color32::from_rgb(160, 96, 0) }
}

/// Colours of the phases of an update and of the draw, in the order of the plots; after these they come again.
const PASSES: [Color32; 7] = [
    Color32::from_rgb(255, 138, 101),
    Color32::from_rgb(255, 202, 88),
    Color32::from_rgb(129, 199, 132),
    Color32::from_rgb(149, 117, 205),
    Color32::from_rgb(79, 195, 247),
    Color32::from_rgb(240, 98, 146),
    Color32::from_rgb(188, 170, 164),
];

/// The colour of a row of the plots.
pub fn pass(row: usize) -> Color32 {
    PASSES[row % PASSES.len()]
}

/// Stops of the scale from 0 to 1, linear RGB. Twin: `shaders/shared/scale_colour.wgsl`.
pub const SCALE: [[f32; 3]; 5] = [
    [0.03, 0.07, 0.42],
    [0.02, 0.36, 0.42],
    [0.16, 0.62, 0.16],
    [0.95, 0.62, 0.03],
    [0.82, 0.05, 0.05],
];

/// A colour of the scale, `t` from 0 to 1.
pub fn scale(t: f32) -> Color32 {
    let at = t.clamp(0.0, 1.0) * 4.0;
    let i = (at as usize).min(3);
    let part = at - i as f32;
    encode(std::array::from_fn(|c| {
        SCALE[i][c] + (SCALE[i + 1][c] - SCALE[i][c]) * part
    }))
}

/// The colour of a level. Twin: `shaders/shared/level_colour.wgsl`.
pub fn level(level: u32) -> Color32 {
    let hue = (level as f32 * 0.416_666_67).fract();
    let dim = if level & 1 == 1 { 0.82 } else { 1.0 };
    encode([0.0, 0.666_666_7, 0.333_333_34].map(|shift: f32| {
        let ramp = (((hue + shift).fract() * 6.0 - 3.0).abs() - 1.0).clamp(0.0, 1.0);
        (1.0 + (ramp - 1.0) * 0.62) * dim
    }))
}

fn encode(linear: [f32; 3]) -> Color32 {
    let [r, g, b] = linear.map(|c| (c.clamp(0.0, 1.0).powf(1.0 / 2.2) * 255.0).round() as u8);
    Color32::from_rgb(r, g, b)
}

/// Sets both themes of the window.
pub fn set_themes(context: &egui::Context) {
    for theme in [Theme::Dark, Theme::Light] {
        context.set_visuals_of(theme, visuals(theme));
        context.style_mut_of(theme, |style| {
            style.spacing.item_spacing = egui::vec2(6.0, 4.0);
            style.spacing.button_padding = egui::vec2(7.0, 3.0);
            style.interaction.tooltip_delay = 0.35;
            style.animation_time = 0.08;
        });
    }
}

fn visuals(theme: Theme) -> Visuals {
    let (mut v, panel, deep, raised) = match theme {
        Theme::Dark => (
            Visuals::dark(),
            Color32::from_rgb(24, 27, 32),
            Color32::from_rgb(15, 17, 21),
            Color32::from_rgb(44, 49, 57),
        ),
        Theme::Light => (
            Visuals::light(),
            Color32::from_rgb(244, 246, 249),
            Color32::from_rgb(255, 255, 255),
            Color32::from_rgb(222, 227, 234),
        ),
    };
    v.weak_text_color = Some(match theme {
        Theme::Dark => Color32::from_rgb(148, 157, 168),
        Theme::Light => Color32::from_rgb(96, 104, 115),
    });
    v.override_text_color = Some(match theme {
        Theme::Dark => Color32::from_rgb(222, 227, 233),
        Theme::Light => Color32::from_rgb(28, 32, 38),
    });
    v.panel_fill = panel;
    v.window_fill = panel;
    v.extreme_bg_color = deep;
    v.widgets.inactive.weak_bg_fill = raised;
    v.widgets.inactive.bg_fill = raised;
    v.selection.bg_fill = ACCENT.gamma_multiply(if theme == Theme::Dark { 0.45 } else { 0.55 });
    v.selection.stroke = Stroke::new(
        1.0,
        if theme == Theme::Dark {
            Color32::WHITE
        } else {
            Color32::BLACK
        },
    );
    v.hyperlink_color = ACCENT;
    v.window_corner_radius = CornerRadius::same(8);
    for widget in [
        &mut v.widgets.inactive,
        &mut v.widgets.hovered,
        &mut v.widgets.active,
        &mut v.widgets.open,
    ] {
        widget.corner_radius = CornerRadius::same(4);
    }
    v
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_is_the_one_that_shaders_use() {
        let source = keyleaf_shaders::source("shared/scale_colour.wgsl").unwrap();
        for [r, g, b] in SCALE {
            assert!(
                source.contains(&format!("vec3f({r:.2}, {g:.2}, {b:.2})")),
                "{r} {g} {b}"
            );
        }
    }
}
