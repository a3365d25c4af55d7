//! Methods for basis functions × degree: milliseconds, and f32 error against the f64 twin.

use super::Shown;
use super::samples;
use super::studio::{Setup, Studio};
use crate::progress;
use glam::{DAffine3, DVec3};
use keyleaf::draw::Look;
use keyleaf::key::RootPoint;
use keyleaf::shading::Material;
use keyleaf::surface::{BasisMethod, NurbsSurface, PatchKind, PatchSettings, Patches, Surface};
use keyleaf::{Metric, Settings, View};
use keyleaf_scene::Scene;
use keyleaf_scene::scene::Colouring;
use keyleaf_stage::{Deviations, Loaded, LoadedObject, Pipelines};
use serde_json::json;
use std::path::PathBuf;
use std::sync::Arc;

const DEGREES: std::ops::RangeInclusive<u32> = 2..=5;
const METHODS: [(BasisMethod, &str); 6] = [
    (BasisMethod::Triangular, "triangular table (A2.2)"),
    (BasisMethod::Loops, "the same by loops"),
    (BasisMethod::Stair, "stair strategy"),
    (BasisMethod::DeBoor, "de Boor's recursion"),
    (BasisMethod::Extraction, "Bézier extraction"),
    (BasisMethod::Power, "power form, made once a KSQuad"),
];

/// Spans a side.
const SPANS: usize = 8;
/// Samples of the error.
const SAMPLES: u32 = 20_000;
/// 2⁻²⁴, the unit of errors together with the largest coordinate.
const F32_ROUNDING: f64 = 1.0 / 16_777_216.0;

/// What is drawn for the times.
pub fn view() -> keyleaf_scene::View {
    keyleaf_scene::View::new(DVec3::new(0.5, 1.4, 1.5), DVec3::new(0.5, 0.5, 0.0), 45.0, None)
}

/// Spans of one length, or of lengths from 1e-6 to 1 with knots of every multiplicity that keeps the surface whole.
fn inner_knots(degree: u32, is_hard: bool) -> Vec<f64> {
    if !is_hard {
        return (1..SPANS).map(|i| i as f64 / SPANS as f64).collect();
    }
    let mut knots = vec![0.125, 0.125 + 1e-6];
    for multiplicity in 1..=degree as usize {
        knots.extend(std::iter::repeat_n(0.25 + 0.1 * multiplicity as f64, multiplicity));
    }
    knots
}

/// A wavy sheet over the unit square, its control points exact in f32.
fn sheet(degree: u32, is_hard: bool) -> anyhow::Result<NurbsSurface> {
    let p = degree as usize;
    let inner = inner_knots(degree, is_hard);
    let knots: Vec<f64> = std::iter::repeat_n(0.0, p + 1)
        .chain(inner)
        .chain(std::iter::repeat_n(1.0, p + 1))
        .collect();
    let count = knots.len() - p - 1;
    // At Greville's abscissae x and y are the parameters themselves.
    let greville = |i: usize| knots[i + 1..=i + p].iter().sum::<f64>() / p as f64;
    let point = |i: usize, j: usize| {
        let (x, y) = (greville(i), greville(j));
        let z = 0.1 * (9.0 * x + 2.0 * y).sin() * (7.0 * y).cos();
        DVec3::new(x, y, z).as_vec3().as_dvec3()
    };
    let points: Vec<DVec3> = (0..count)
        .flat_map(|j| (0..count).map(move |i| (i, j)))
        .map(|(i, j)| point(i, j))
        .collect();
    let weights = vec![1.0; points.len()];
    Ok(NurbsSurface::new([degree; 2], [knots.clone(), knots], points, weights)?)
}

fn scene_of(surface: Arc<dyn Surface>) -> Loaded {
    let bounds = surface.bounding_box();
    let settings = Settings {
        metric: Metric::Edge { pixels: 8.0 },
        ..Settings::default()
    };
    Loaded {
        file: PathBuf::new(),
        scene: Scene {
            surfaces: Vec::new(),
            settings: Default::default(),
            light: Default::default(),
            effects: Vec::new(),
            cameras: Vec::new(),
            paths: Vec::new(),
        },
        objects: vec![LoadedObject {
            name: "sheet".to_owned(),
            surface,
            cage: None,
            world_from_object: DAffine3::IDENTITY,
            settings,
            material: Material::Plain,
            look: Look::default(),
            base_colour: [0.5; 3],
            colouring: Colouring::Plain,
        }],
        notes: Vec::new(),
        files: Vec::new(),
        bounds,
    }
}

/// Distances between the GPU and the f64 twin, in units of 2⁻²⁴ of the largest coordinate.
fn errors(setup: &Setup<'_>, surface: &Arc<dyn Surface>, pipelines: &mut Pipelines) -> anyhow::Result<Deviations> {
    let at: Vec<RootPoint> = (0..SAMPLES).map(|i| samples::even(surface.topology(), i)).collect();
    let found = samples::differences(setup, surface, surface.as_ref(), &at, pipelines)?;
    let (low, high) = surface.bounding_box();
    let unit = F32_ROUNDING * low.abs().max(high.abs()).max_element();
    Ok(Deviations::of(found.iter().map(|found| found.distance)).scaled(1.0 / unit))
}

/// What one method does at one degree.
struct Measured {
    degree: u32,
    name: &'static str,
    ms: f64,
    triangles: u64,
    /// Largest and root mean square, even knots, then hard ones.
    errors: [Deviations; 2],
}

fn measure(
    setup: &Setup<'_>,
    view: &View,
    (method, name): (BasisMethod, &'static str),
) -> anyhow::Result<Vec<Measured>> {
    let surface = |degree: u32, is_hard: bool| -> anyhow::Result<Arc<dyn Surface>> {
        let kind = PatchKind::Nurbs(method);
        let settings = PatchSettings {
            kind,
            ..PatchSettings::default()
        };
        Ok(Arc::new(Patches::new(vec![sheet(degree, is_hard)?], settings)?))
    };
    // The degree is data: pipelines serve all.
    let mut pipelines = Pipelines::default();
    let mut all = Vec::new();
    for degree in DEGREES {
        let [even, hard] = [surface(degree, false)?, surface(degree, true)?];
        let scene = scene_of(Arc::clone(&even));
        let shot = Studio::with_pipelines(setup, &scene, view, &mut pipelines)?.shoot()?;
        all.push(Measured {
            degree,
            name,
            ms: shot.ms,
            triangles: shot.triangles,
            errors: [
                errors(setup, &even, &mut pipelines)?,
                errors(setup, &hard, &mut pipelines)?,
            ],
        });
    }
    Ok(all)
}

/// The table. `view` shows the sheet.
pub fn table(setup: &Setup<'_>, view: &View) -> anyhow::Result<Shown> {
    let bar = progress::bar(METHODS.len() as u64, "bases", setup.quiet);
    let quiet = Setup { quiet: true, ..*setup };
    let mut measured = Vec::new();
    for method in METHODS {
        measured.extend(measure(&quiet, view, method)?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    measured.sort_by_key(|m| m.degree); // stable: methods stay in their order
    let mut shown = Shown {
        title:
            "basis functions: a B-spline sheet of 8 x 8 spans, and one with knots 1e-6 apart and of all multiplicities"
                .to_owned(),
        text: Vec::new(),
        rows: Vec::new(),
    };
    let mut rows = Vec::new();
    for m in &measured {
        let first = measured.iter().find(|other| other.degree == m.degree);
        let ratio = m.ms / first.map_or(m.ms, |first| first.ms);
        let [even, hard] = m.errors;
        rows.push(vec![
            m.degree.to_string(),
            m.name.to_owned(),
            format!("{:.2}", m.ms),
            format!("{ratio:.2}"),
            format!("{:.1}", even.largest),
            format!("{:.2}", even.rms),
            format!("{:.1}", hard.largest),
            format!("{:.2}", hard.rms),
        ]);
        shown.rows.push(json!({
            "degree": m.degree, "method": m.name, "ms": m.ms, "triangles": m.triangles, "to_first": ratio,
            "max_error": even.largest, "rms_error": even.rms, "hard_max_error": hard.largest, "hard_rms_error": hard.rms,
            "unit": "2^-24 of the largest coordinate",
        }));
    }
    shown.add(
        "milliseconds a frame; error of positions in 2^-24 of the largest coordinate",
        &[
            "degree",
            "method",
            "ms",
            "to first",
            "largest",
            "rms",
            "hard knots: largest",
            "rms",
        ],
        &rows,
    );
    Ok(shown)
}
