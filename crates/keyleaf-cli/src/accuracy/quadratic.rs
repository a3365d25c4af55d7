//! Quadratic approximations, PN triangles and Loop surfaces of one control mesh, against the limit of Loop subdivision (Boubekeur and
//! Schlick 2007, *QAS: Real-Time Quadratic Approximation of Subdivision Surfaces*).

use super::Shown;
use super::samples::Accuracy;
use super::studio::{Setup, Studio, with_object};
use crate::output::thousands;
use keyleaf::View;
use keyleaf_scene::ControlCage;
use keyleaf_scene::scene::{LoopShape, QasShape, QasVariant, Shape};
use keyleaf_stage::{Loaded, LoadedObject, Pipelines};
use serde_json::json;
use std::sync::Arc;

/// What the limit is taken with.
const EXACT: u32 = 16;

fn loop_surface(isolation: u32) -> Shape {
    Shape::Loop(LoopShape {
        isolation,
        ..LoopShape::default()
    })
}

fn methods() -> Vec<(&'static str, Shape)> {
    let qas = |variant| Shape::Qas(QasShape { variant });
    vec![
        ("PN triangles", Shape::PnTriangles),
        ("QAS, interpolating: another limit", qas(QasVariant::Interpolating)),
        ("QAS", qas(QasVariant::Approximating)),
        ("Loop, isolation 2", loop_surface(2)),
        ("Loop, isolation 8", loop_surface(8)),
    ]
}

/// Whether a control mesh has a Loop surface.
pub fn is_of_triangles(object: &LoadedObject) -> bool {
    let is_triangle = |face: &[u32]| face.len() == 3;
    let cage = object.cage.as_ref();
    cage.is_some_and(|cage| cage.control.mesh.faces.iter().all(is_triangle))
}

/// The table of one surface.
pub fn table(setup: &Setup<'_>, loaded: &Loaded, object: &LoadedObject, view: &View) -> anyhow::Result<Shown> {
    let cage: &ControlCage = object
        .cage
        .as_ref()
        .ok_or_else(|| anyhow::anyhow!("the surface has no control mesh"))?;
    let exact = cage.surface_as(&loop_surface(EXACT))?;
    let mut shown = Shown {
        title: format!(
            "{}, {}: approximations of a Loop surface",
            loaded.file.display(),
            object.name
        ),
        text: Vec::new(),
        rows: Vec::new(),
    };
    let mut rows = Vec::new();
    let quiet = Setup { quiet: true, ..*setup };
    for (name, shape) in methods() {
        let surface = cage.surface_as(&shape)?;
        let drawn = LoadedObject {
            surface: Arc::clone(&surface),
            ..object.clone()
        };
        let mut pipelines = Pipelines::default();
        let shot = Studio::with_pipelines(&quiet, &with_object(loaded, drawn), view, &mut pipelines)?.shoot()?;
        let Accuracy { position, normal } = Accuracy::of(setup, &surface, exact.as_ref(), &mut pipelines)?;
        let tables = surface.tables(glam::DVec3::ZERO);
        let bytes = tables.params.len() + 4 * (tables.a.len() + tables.b.len());
        rows.push(vec![
            name.to_owned(),
            thousands(bytes.div_ceil(1024) as u64),
            thousands(shot.triangles),
            format!("{:.2}", shot.ms),
            format!("{:.1e}", position.largest),
            format!("{:.1e}", position.rms),
            format!("{:.3}", normal.largest),
            format!("{:.3}", normal.rms),
        ]);
        shown.rows.push(json!({
            "method": name, "bytes": bytes, "triangles": shot.triangles, "ms": shot.ms,
            "position_error": position, "normal_error_degrees": normal,
        }));
    }
    shown.add(
        "a frame that updates and draws; distance to the limit over the diagonal and angle of normals, largest and root mean square",
        &["method", "KiB", "triangles", "frame ms", "error", "rms", "normal deg", "rms"],
        &rows,
    );
    Ok(shown)
}
