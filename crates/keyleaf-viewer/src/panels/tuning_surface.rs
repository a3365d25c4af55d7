//! Options of the surfaces themselves: changing one makes the surface anew.

use crate::action::Action;
use crate::viewer::Viewer;
use egui::{ComboBox, RichText, Slider, Ui};
use keyleaf_scene::scene::{
    Basis, GaussianScheme, Interpolation, LoopWeights, QasVariant, Shape, Solver, Source, SurfaceEntry,
};

/// Shows the options of each surface.
pub fn show(viewer: &mut Viewer, ui: &mut Ui) {
    let Some(document) = &viewer.document else { return };
    let mut scene = document.loaded.scene.clone();
    let mut is_done = true;
    for (number, entry) in scene.surfaces.iter_mut().enumerate() {
        ui.push_id(number, |ui| {
            ui.label(RichText::new(&entry.name).strong().small());
            is_done &= options(ui, entry);
        });
    }
    // A slider that is held makes no surface yet.
    if is_done && scene.surfaces != document.loaded.scene.surfaces && viewer.opening.is_none() {
        viewer.actions.push(Action::Rebuild(Box::new(scene)));
    }
}

/// Whether the change, if there is one, is complete.
fn options(ui: &mut Ui, entry: &mut SurfaceEntry) -> bool {
    let is_source = match &mut entry.source {
        Source::Nurbs(nurbs) => {
            basis(ui, &mut nurbs.basis);
            true
        }
        Source::Patches(patches) => {
            let mut now = patches.basis.unwrap_or_default();
            basis(ui, &mut now);
            if now != patches.basis.unwrap_or_default() {
                patches.basis = Some(now);
            }
            true
        }
        Source::HeightField(map) => {
            let all = [
                (Interpolation::Bicubic, "Catmull-Rom splines"),
                (Interpolation::Bilinear, "linear"),
            ];
            choice(
                ui,
                "between samples",
                "how heights run between samples",
                &mut map.interpolation,
                &all,
            );
            true
        }
        Source::Terrain(_) | Source::Mesh(_) | Source::Bezier(_) => false,
    };
    let (is_shape, is_done) = shape(ui, &mut entry.surface);
    if !is_source && !is_shape {
        ui.weak("no options");
    }
    is_done
}

/// Whether there are options, and whether none is in the hands of the person.
fn shape(ui: &mut Ui, shape: &mut Shape) -> (bool, bool) {
    let is_done = match shape {
        Shape::CatmullClark(s) => isolation(ui, &mut s.isolation),
        Shape::Loop(s) => {
            let all = [(LoopWeights::Loop, "Loop"), (LoopWeights::Warren, "Warren")];
            choice(ui, "weights", "of inner vertices", &mut s.weights, &all);
            isolation(ui, &mut s.isolation)
        }
        Shape::GaussianProduct(s) => {
            let schemes = [
                (GaussianScheme::CatmullClark, "Catmull-Clark"),
                (GaussianScheme::Loop, "Loop"),
                (GaussianScheme::LoopWarren, "Loop, Warren"),
            ];
            choice(ui, "scheme", "that the Gaussians go through", &mut s.scheme, &schemes);
            let solvers = [(Solver::Ldlt, "LDLᵀ"), (Solver::Adjugate, "adjugate")];
            choice(ui, "solver", "of the 3 × 3 systems", &mut s.solver, &solvers);
            isolation(ui, &mut s.isolation)
        }
        Shape::Qas(s) => {
            let all = [
                (QasVariant::Approximating, "approximating"),
                (QasVariant::Interpolating, "interpolating"),
            ];
            choice(ui, "variant", "of the quadratic patches", &mut s.variant, &all);
            true
        }
        _ => return (false, true),
    };
    (true, is_done)
}

fn basis(ui: &mut Ui, basis: &mut Basis) {
    let all = [
        (Basis::Triangular, "triangular"),
        (Basis::Stair, "stair"),
        (Basis::DeBoor, "de Boor"),
        (Basis::Extraction, "Bézier extraction"),
        (Basis::Power, "polynomials"),
    ];
    choice(ui, "basis", "how the basis functions are computed", basis, &all);
}

fn isolation(ui: &mut Ui, steps: &mut u32) -> bool {
    ui.horizontal(|ui| {
        ui.label(RichText::new("isolation").weak())
            .on_hover_text("subdivision steps around extraordinary vertices");
        let response = ui.add(Slider::new(steps, 1..=16).suffix(" steps"));
        !response.dragged() && !response.has_focus()
    })
    .inner
}

fn choice<T: PartialEq + Copy>(ui: &mut Ui, name: &str, tip: &str, value: &mut T, all: &[(T, &str)]) {
    ui.horizontal(|ui| {
        ui.label(RichText::new(name).weak()).on_hover_text(tip);
        let now = all.iter().find(|(v, _)| v == value).map_or("", |v| v.1);
        ComboBox::from_id_salt(name).selected_text(now).show_ui(ui, |ui| {
            for (wanted, label) in all {
                ui.selectable_value(value, *wanted, *label);
            }
        });
    });
}
