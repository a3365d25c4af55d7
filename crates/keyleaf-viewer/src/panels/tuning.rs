//! Settings, light and effects, live.

use crate::action::Action;
use crate::viewer::Viewer;
use egui::{ComboBox, DragValue, Grid, RichText, Slider, Ui};
use keyleaf_scene::scene::{BackFaces, Culling, Effect, Fog, Metric, Morph, Pairs, Settings, Threshold};

/// The settings of the scene: what changes, changes at once.
pub fn show(viewer: &mut Viewer, ui: &mut Ui) {
    let Some(document) = &viewer.document else { return };
    let mut scene = document.loaded.scene.clone();
    let has_nets = document.loaded.objects.iter().all(|o| o.surface.as_patches().is_some());
    let settings = &mut scene.settings;
    Grid::new("settings").num_columns(2).spacing([8.0, 4.0]).show(ui, |ui| {
        metric(ui, &mut settings.metric);
        pairs(ui, settings);
        morph(ui, settings);
        numbers(ui, settings);
        limits(ui, settings);
        faces(ui, settings, has_nets);
    });
    let overrides = scene.surfaces.iter().any(|s| s.settings != Default::default());
    if overrides {
        ui.label(RichText::new("some surfaces have settings of their own").small().weak());
    }
    let original = document.original.settings.clone();
    let is_original = scene.settings == original;
    ui.horizontal(|ui| {
        let reset = ui.add_enabled(!is_original, egui::Button::new("Reset"));
        if reset.on_hover_text("the settings of the file").clicked() {
            scene.settings = original;
        }
        if ui
            .button("Copy as scene")
            .on_hover_text("the RON of the scene as it is now, to the clipboard")
            .clicked()
        {
            viewer.actions.push(Action::CopyScene);
        }
    });
    if scene != document.loaded.scene {
        viewer.actions.push(Action::Tune(Box::new(scene)));
    }
}

fn name(ui: &mut Ui, text: &str, tip: &str) {
    ui.label(RichText::new(text).weak()).on_hover_text(tip);
}

/// (name, a metric of this kind, tip).
fn metrics(now: Metric) -> [(&'static str, Metric, &'static str); 9] {
    let pixels = pixels_of(now).unwrap_or(8.0);
    let fine = (pixels / 8.0).clamp(0.05, 4.0);
    [
        ("edge", Metric::Edge { pixels }, "length of a drawn edge on the screen"),
        (
            "deviation",
            Metric::Deviation { pixels: fine },
            "distance of the surface from the triangles, by bounds",
        ),
        (
            "distance",
            Metric::Distance { factor: 10.0 },
            "by distance alone (Khoury 2.1)",
        ),
        (
            "boundary",
            Metric::Boundary {
                pixels,
                boundary_pixels: fine,
            },
            "edge, finer at open boundaries",
        ),
        (
            "local area",
            Metric::LocalArea { pixels },
            "size of the face on the screen (Concheiro 6.8)",
        ),
        (
            "linear approximation",
            Metric::LinearApproximation { pixels: fine },
            "sampled distance (Concheiro 6.9)",
        ),
        (
            "distance test",
            Metric::DistanceTest(Threshold::Pixels(fine)),
            "Concheiro 3.2.2",
        ),
        (
            "flat test",
            Metric::FlatTest(Threshold::Pixels(fine)),
            "Concheiro 3.2.2",
        ),
        (
            "length test",
            Metric::LengthTest(Threshold::Pixels(pixels)),
            "Concheiro 3.2.2",
        ),
    ]
}

fn pixels_of(metric: Metric) -> Option<f64> {
    match metric {
        Metric::Edge { pixels } | Metric::LocalArea { pixels } | Metric::Boundary { pixels, .. } => Some(pixels),
        _ => None,
    }
}

fn metric(ui: &mut Ui, metric: &mut Metric) {
    name(ui, "metric", "when a leaf is too coarse");
    let kind = std::mem::discriminant(&*metric);
    let all = metrics(*metric);
    let now = all
        .iter()
        .find(|(_, m, _)| std::mem::discriminant(m) == kind)
        .map_or("", |m| m.0);
    ComboBox::from_id_salt("metric")
        .selected_text(now)
        .width(140.0)
        .show_ui(ui, |ui| {
            for (label, wanted, tip) in all {
                let is_now = std::mem::discriminant(&wanted) == kind;
                if ui.selectable_label(is_now, label).on_hover_text(tip).clicked() && !is_now {
                    *metric = wanted;
                }
            }
        });
    ui.end_row();
    let pixels = |ui: &mut Ui, text: &str, value: &mut f64| {
        name(
            ui,
            text,
            "in pixels; lower is finer: half of it is four times the leaves",
        );
        ui.add(
            Slider::new(value, 0.05..=64.0)
                .logarithmic(true)
                .suffix(" px")
                .max_decimals(2),
        );
        ui.end_row();
    };
    match metric {
        Metric::Edge { pixels: p } | Metric::LocalArea { pixels: p } => pixels(ui, "threshold", p),
        Metric::Deviation { pixels: p } | Metric::LinearApproximation { pixels: p } => pixels(ui, "threshold", p),
        Metric::Boundary {
            pixels: p,
            boundary_pixels,
        } => {
            pixels(ui, "threshold", p);
            pixels(ui, "at boundaries", boundary_pixels);
            *boundary_pixels = boundary_pixels.min(*p);
        }
        Metric::DistanceTest(Threshold::Pixels(p))
        | Metric::FlatTest(Threshold::Pixels(p))
        | Metric::LengthTest(Threshold::Pixels(p)) => pixels(ui, "threshold", p),
        Metric::Distance { factor } => {
            name(ui, "factor", "in metres: doubling it adds a level");
            ui.add(Slider::new(factor, 1e-3..=1e5).logarithmic(true).suffix(" m"));
            ui.end_row();
        }
        Metric::FlatTest(Threshold::Units(cosine)) => {
            name(ui, "least cosine", "of the angle between an edge and the surface");
            ui.add(Slider::new(cosine, 0.0..=0.99999));
            ui.end_row();
        }
        Metric::DistanceTest(Threshold::Units(length)) | Metric::LengthTest(Threshold::Units(length)) => {
            name(ui, "threshold", "a length of the model");
            ui.add(Slider::new(length, 1e-6..=1e3).logarithmic(true));
            ui.end_row();
        }
    }
}

fn pairs(ui: &mut Ui, settings: &mut Settings) {
    name(
        ui,
        "pairs",
        "two leaves drawn as one triangle: where they must be, beside larger ones, or also where the threshold is kept so",
    );
    let mut is_on = settings.pairs == Pairs::Wished;
    ui.checkbox(&mut is_on, "where the threshold allows");
    settings.pairs = if is_on { Pairs::Wished } else { Pairs::Forced };
    ui.end_row();
}

/// Only metrics that halve from level to level have it; with another it goes out.
fn morph(ui: &mut Ui, settings: &mut Settings) {
    name(
        ui,
        "morph",
        "vertices that a split adds slide from the edge that they divide to the surface, so that nothing jumps",
    );
    let halves = settings.metric.halves();
    let mut is_on = settings.morph == Morph::Geomorph && halves;
    let switch = ui.add_enabled(halves, egui::Checkbox::new(&mut is_on, "new vertices slide"));
    switch.on_disabled_hover_text("only with edge, boundary and local area, which halve from level to level");
    settings.morph = if is_on { Morph::Geomorph } else { Morph::None };
    ui.end_row();
}

fn numbers(ui: &mut Ui, settings: &mut Settings) {
    name(ui, "base grid", "k: each leaf is drawn as 4^k triangles");
    ui.add(Slider::new(&mut settings.base_grid, 0..=6));
    ui.end_row();
    let deepest = 31 - settings.base_grid;
    name(ui, "deepest level", "no leaf is deeper");
    let mut level = settings.deepest_level();
    if ui.add(Slider::new(&mut level, 0..=deepest)).changed() {
        settings.max_level = Some(level);
    }
    settings.max_level = settings.max_level.map(|level| level.min(deepest));
    ui.end_row();
    name(ui, "settle", "update passes a frame: more follow a fast camera sooner");
    ui.add(
        Slider::new(&mut settings.settle, 1..=64)
            .logarithmic(true)
            .suffix(" a frame"),
    );
    ui.end_row();
}

fn limits(ui: &mut Ui, settings: &mut Settings) {
    name(
        ui,
        "capacity",
        "leaves that the buffers of each surface hold; what does not fit is drawn coarser",
    );
    let mut power = f64::from(settings.capacity).log2();
    let text = |power: f64, _| format!("{:.0} k", power.exp2() / 1000.0);
    let slider = Slider::new(&mut power, 10.0..=22.0)
        .step_by(1.0)
        .custom_formatter(text)
        .suffix(" leaves");
    if ui.add(slider).changed() {
        settings.capacity = power.round().exp2() as u32;
        settings.target_leaves = settings.target_leaves.map(|n| n.min(settings.capacity));
    }
    ui.end_row();
    name(ui, "target count", "leaves a surface that the threshold is steered to");
    ui.horizontal(|ui| {
        let mut is_on = settings.target_leaves.is_some();
        let most = settings.capacity;
        if ui.checkbox(&mut is_on, "").changed() {
            settings.target_leaves = is_on.then_some(most / 4);
        }
        if let Some(target) = &mut settings.target_leaves {
            ui.add(
                DragValue::new(target)
                    .range(1..=most)
                    .speed(f64::from(most) / 2000.0)
                    .suffix(" leaves"),
            );
        }
    });
    ui.end_row();
}

fn faces(ui: &mut Ui, settings: &mut Settings, has_nets: bool) {
    name(ui, "culling", "whether leaves outside the view are left out");
    let mut culls = settings.culling == Culling::Frustum;
    if ui.checkbox(&mut culls, "by the view").changed() {
        settings.culling = if culls { Culling::Frustum } else { Culling::Off };
    }
    ui.end_row();
    name(
        ui,
        "guard band",
        "width of the band around the view that stays fine, in parts of the picture",
    );
    ui.add(Slider::new(&mut settings.guard_band.margin, 0.0..=2.0));
    ui.end_row();
    name(ui, "outside it", "how many times coarser leaves may become there");
    ui.add(
        Slider::new(&mut settings.guard_band.coarsen, 1.0..=64.0)
            .logarithmic(true)
            .suffix(" ×"),
    );
    ui.end_row();
    name(
        ui,
        "back faces",
        "what is seen from behind; for closed surfaces only: of open ones the inside vanishes",
    );
    let all = [
        (BackFaces::Drawn, "drawn", false),
        (BackFaces::Hidden, "hidden", false),
        (BackFaces::Leaves, "leaves left out", false),
        (BackFaces::Light, "faces, by corners", true),
        (BackFaces::Strong, "faces, by squares", true),
        (BackFaces::Conservative, "faces, by cones", true),
    ];
    let now = all.iter().find(|(b, ..)| *b == settings.back_faces).map_or("", |b| b.1);
    ComboBox::from_id_salt("back faces")
        .selected_text(now)
        .width(140.0)
        .show_ui(ui, |ui| {
            for (back_faces, label, needs_nets) in all {
                ui.add_enabled_ui(has_nets || !needs_nets, |ui| {
                    ui.selectable_value(&mut settings.back_faces, back_faces, label);
                });
            }
        });
    ui.end_row();
}

/// Sun, sky and air.
pub fn light(viewer: &mut Viewer, ui: &mut Ui) {
    let Some(document) = &viewer.document else { return };
    let mut scene = document.loaded.scene.clone();
    Grid::new("light").num_columns(2).spacing([8.0, 4.0]).show(ui, |ui| {
        name(ui, "sun, azimuth", "clockwise from north");
        ui.add(
            Slider::new(&mut scene.light.azimuth, 0.0..=360.0)
                .suffix("°")
                .max_decimals(0),
        );
        ui.end_row();
        name(ui, "sun, elevation", "above the horizon");
        ui.add(
            Slider::new(&mut scene.light.elevation, -90.0..=90.0)
                .suffix("°")
                .max_decimals(0),
        );
        ui.end_row();
        name(ui, "exposure", "factor on all light");
        ui.add(
            Slider::new(&mut scene.light.exposure, 0.05..=20.0)
                .logarithmic(true)
                .suffix(" ×"),
        );
        ui.end_row();
        let mut has_sky = scene.effects.contains(&Effect::Sky);
        name(ui, "sky", "drawn where nothing else is");
        if ui.checkbox(&mut has_sky, "").changed() {
            scene.effects.retain(|e| *e != Effect::Sky);
            scene.effects.extend(has_sky.then_some(Effect::Sky));
        }
        ui.end_row();
        let fog = scene
            .effects
            .iter()
            .find_map(|e| if let Effect::Fog(fog) = e { Some(*fog) } else { None });
        let mut has_fog = fog.is_some();
        let mut fog = fog.unwrap_or(Fog::default());
        name(ui, "haze", "half of the colour at this distance");
        ui.horizontal(|ui| {
            ui.checkbox(&mut has_fog, "");
            let pace = fog.distance / 100.0;
            if has_fog {
                ui.add(
                    DragValue::new(&mut fog.distance)
                        .range(0.1..=1e7)
                        .speed(pace)
                        .suffix(" m"),
                );
            }
        });
        ui.end_row();
        scene.effects.retain(|e| !matches!(e, Effect::Fog(_)));
        scene.effects.extend(has_fog.then_some(Effect::Fog(fog)));
    });
    // The order of effects has no meaning.
    let same = scene.light == document.loaded.scene.light
        && scene.effects.len() == document.loaded.scene.effects.len()
        && scene.effects.iter().all(|e| document.loaded.scene.effects.contains(e));
    if !same {
        viewer.actions.push(Action::Tune(Box::new(scene)));
    }
}
