//! Subdivision surfaces: what isolation about extraordinary vertices costs and gains (Komar 2020, tables 4.1, 4.6, 4.7).

use super::Shown;
use super::samples::Accuracy;
use super::studio::{Setup, Studio, with_object};
use crate::output::thousands;
use crate::progress;
use keyleaf::View;
use keyleaf::surface::Surface;
use keyleaf_scene::scene::Shape;
use keyleaf_scene::{ControlCage, PoseError};
use keyleaf_stage::{Loaded, LoadedObject, Pipelines};
use serde_json::json;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Steps of isolation in the table.
const LEVELS: std::ops::RangeInclusive<u32> = 1..=6;

/// Preprocessing is repeated so often, or for so long.
const REPEATS: usize = 5;
const LONG_ENOUGH: Duration = Duration::from_millis(500);

/// The shape with another isolation; `None` if it has none.
pub fn isolated(shape: &Shape, steps: u32) -> Option<Shape> {
    let mut shape = shape.clone();
    match &mut shape {
        Shape::CatmullClark(shape) => shape.isolation = steps,
        Shape::Loop(shape) => shape.isolation = steps,
        Shape::GaussianProduct(shape) => shape.isolation = steps,
        _ => return None,
    }
    Some(shape)
}

/// A surface, the median milliseconds of making it and its tables, and the bytes of these.
fn prepare(cage: &ControlCage, shape: &Shape) -> Result<(Arc<dyn Surface>, f64, usize), PoseError> {
    let begin = Instant::now();
    let mut times = Vec::new();
    loop {
        let start = Instant::now();
        let surface = cage.surface_as(shape)?;
        let tables = surface.tables(glam::DVec3::ZERO);
        times.push(start.elapsed().as_secs_f64() * 1e3);
        if times.len() == REPEATS || begin.elapsed() > LONG_ENOUGH {
            times.sort_by(f64::total_cmp);
            let bytes = tables.params.len() + 4 * (tables.a.len() + tables.b.len());
            return Ok((surface, times[times.len() / 2], bytes));
        }
    }
}

/// Whether the table has something to say of a surface.
pub fn has_isolation(object: &LoadedObject) -> bool {
    let shape = object.cage.as_ref().map(|cage| cage.shape());
    shape.is_some_and(|shape| isolated(shape, 1).is_some())
}

/// The table of the subdivision surfaces of a scene.
pub fn table(setup: &Setup<'_>, loaded: &Loaded, view: &View) -> anyhow::Result<Shown> {
    let objects: Vec<&LoadedObject> = loaded.objects.iter().filter(|object| has_isolation(object)).collect();
    let bar = progress::bar((objects.len() * LEVELS.count()) as u64, "isolation", setup.quiet);
    let quiet = Setup { quiet: true, ..*setup };
    let mut shown = Shown {
        title: format!("{}: isolation of extraordinary vertices", loaded.file.display()),
        text: Vec::new(),
        rows: Vec::new(),
    };
    let mut pipelines = Pipelines::default();
    let mut rows = Vec::new();
    for object in objects {
        let Some(cage) = &object.cage else { continue };
        for steps in LEVELS {
            let Some(shape) = isolated(cage.shape(), steps) else {
                continue;
            };
            let (surface, preprocessing, bytes) = prepare(cage, &shape)?;
            let drawn = LoadedObject {
                surface: Arc::clone(&surface),
                ..object.clone()
            };
            let shot = Studio::with_pipelines(&quiet, &with_object(loaded, drawn), view, &mut Pipelines::default())?
                .shoot()?;
            let Accuracy { position, normal } = Accuracy::of(setup, &surface, surface.as_ref(), &mut pipelines)?;
            rows.push(vec![
                object.name.clone(),
                surface.topology().face_count().to_string(),
                steps.to_string(),
                format!("{preprocessing:.2}"),
                thousands(bytes.div_ceil(1024) as u64),
                thousands(shot.triangles),
                format!("{:.2}", shot.ms),
                format!("{:.1e}", position.largest),
                format!("{:.1e}", position.rms),
                format!("{:.4}", normal.largest),
            ]);
            shown.rows.push(json!({
                "surface": object.name, "faces": surface.topology().face_count(), "isolation": steps,
                "preprocessing_ms": preprocessing, "bytes": bytes, "triangles": shot.triangles, "ms": shot.ms,
                "position_error": position, "normal_error_degrees": normal,
            }));
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    shown.add(
        "preprocessing on one core; a frame that updates and draws; distance to the limit over the diagonal and angle of normals, largest and \
         root mean square",
        &[
            "surface",
            "faces",
            "isolation",
            "preprocessing ms",
            "KiB",
            "triangles",
            "frame ms",
            "error",
            "rms",
            "normal deg",
        ],
        &rows,
    );
    Ok(shown)
}
