//! What the report varies: each series is one thing changed, at several values. A new one is a line here.

use super::isolation::isolated;
use keyleaf::key::MAX_LEVEL;
use keyleaf::surface::{BasisMethod, PatchKind, PatchSettings, Patches, Surface};
use keyleaf::{BackFaces, Balance, Metric, Morph, Pairs, Settings};
use keyleaf_scene::scene::{GaussianShape, QasShape, QasVariant, Shape, Solver};
use keyleaf_stage::{Loaded, LoadedObject};
use std::sync::Arc;

/// One thing that varies.
pub struct Series {
    pub name: &'static str,
    /// Labels with the scene at each value, from coarse to fine where there is an order.
    pub points: Vec<(String, Loaded)>,
    /// Whether every value needs more leaves than the one before.
    pub is_refining: bool,
}

/// Thresholds in pixels, the last ones for long reports only.
const EDGES: [f32; 6] = [32.0, 16.0, 8.0, 4.0, 2.0, 1.0];
const DEVIATIONS: [f32; 6] = [8.0, 4.0, 2.0, 1.0, 0.5, 0.25];
const QUICK: usize = 4;
/// The edges at which everything else is compared.
const COMPARED: f32 = 8.0;

/// The deepest level of a key of 32 bits with 4 for the level (Khoury 2018, 3.3).
const NARROW_LEVEL: u32 = 14;
const GRIDS: [u32; 4] = [0, 1, 2, 3];
const ISOLATIONS: [u32; 4] = [1, 2, 4, 8];
const BASES: [(BasisMethod, &str); 4] = [
    (BasisMethod::Triangular, "A2.2"),
    (BasisMethod::DeBoor, "de Boor"),
    (BasisMethod::Extraction, "extraction"),
    (BasisMethod::Power, "power form"),
];

fn with_settings(loaded: &Loaded, change: impl Fn(&mut Settings)) -> Loaded {
    let mut changed = loaded.clone();
    for object in &mut changed.objects {
        object.settings.target_leaves = 0;
        change(&mut object.settings);
    }
    changed
}

/// Another base grid. Level and grid together are at most 31.
pub fn gridded(settings: &mut Settings, k: u32) {
    settings.base_grid = k;
    settings.max_level = settings.max_level.min(MAX_LEVEL - k);
}

/// The scene at the edges at which everything else is compared.
fn compared(loaded: &Loaded) -> Loaded {
    with_settings(loaded, |settings| settings.metric = Metric::Edge { pixels: COMPARED })
}

/// The scene with other surfaces where `change` gives some; none if it gives none at all.
fn with_surfaces(loaded: &Loaded, change: impl Fn(&LoadedObject) -> Option<Arc<dyn Surface>>) -> Option<Loaded> {
    let mut changed = compared(loaded);
    let mut is_changed = false;
    for object in &mut changed.objects {
        if let Some(surface) = change(object) {
            object.surface = surface;
            is_changed = true;
        }
    }
    is_changed.then_some(changed)
}

fn of_surfaces<T: Copy>(
    loaded: &Loaded,
    name: &'static str,
    values: &[(T, String)],
    change: impl Fn(&LoadedObject, T) -> Option<Arc<dyn Surface>>,
) -> Series {
    let points = values.iter().filter_map(|(value, label)| {
        let changed = with_surfaces(loaded, |object| change(object, *value))?;
        Some((label.clone(), changed))
    });
    Series {
        name,
        points: points.collect(),
        is_refining: false,
    }
}

/// A surface of the same control mesh with another shape.
fn reshaped(object: &LoadedObject, change: impl Fn(&Shape) -> Option<Shape>) -> Option<Arc<dyn Surface>> {
    let cage = object.cage.as_ref()?;
    cage.surface_as(&change(cage.shape())?).ok()
}

fn solved(shape: &Shape, solver: Solver) -> Option<Shape> {
    match shape {
        Shape::GaussianProduct(shape) => Some(Shape::GaussianProduct(GaussianShape {
            solver,
            ..shape.clone()
        })),
        _ => None,
    }
}

/// Approximations of a Loop surface.
fn approximated(shape: &Shape, by: &'static str) -> Option<Shape> {
    let Shape::Loop(_) = shape else { return None };
    Some(match by {
        "QAS" => Shape::Qas(QasShape {
            variant: QasVariant::Approximating,
        }),
        "PN triangles" => Shape::PnTriangles,
        _ => shape.clone(),
    })
}

fn based(object: &LoadedObject, method: BasisMethod) -> Option<Arc<dyn Surface>> {
    let patches = object.surface.as_patches()?;
    let settings = PatchSettings {
        kind: PatchKind::Nurbs(method),
        ..PatchSettings::default()
    };
    Some(Arc::new(Patches::new(patches.surfaces().to_vec(), settings).ok()?))
}

fn labelled<T: Copy, const N: usize>(values: [T; N], label: impl Fn(T) -> String) -> [(T, String); N] {
    values.map(|value| (value, label(value)))
}

/// All series that have something to say of a scene.
pub fn all(loaded: &Loaded, quick: bool) -> Vec<Series> {
    let count = if quick { QUICK } else { EDGES.len() };
    let of_settings = |name, points: Vec<(String, Loaded)>| Series {
        name,
        points,
        is_refining: false,
    };
    let refining = |name, points| Series {
        is_refining: true,
        ..of_settings(name, points)
    };
    let pixels = |values: &[f32], metric: fn(f32) -> Metric| -> Vec<(String, Loaded)> {
        let at = |&pixels: &f32| {
            let changed = with_settings(loaded, |settings| settings.metric = metric(pixels));
            (format!("{pixels} px"), changed)
        };
        values[..count].iter().map(at).collect()
    };
    let has_deviation = |object: &LoadedObject| object.cage.is_some() || object.surface.as_patches().is_some();
    let mut all = vec![refining("edge", pixels(&EDGES, |pixels| Metric::Edge { pixels }))];
    if loaded.objects.iter().all(has_deviation) {
        all.push(refining(
            "deviation",
            pixels(&DEVIATIONS, |pixels| Metric::Deviation { pixels }),
        ));
    }
    let edges_with = |change: fn(&mut Settings)| -> Vec<(String, Loaded)> {
        let edges = pixels(&EDGES, |pixels| Metric::Edge { pixels }).into_iter();
        edges
            .map(|(label, scene)| (label, with_settings(&scene, change)))
            .collect()
    };
    all.push(refining(
        "edge, geomorph",
        edges_with(|settings| settings.morph = Morph::Geomorph),
    ));
    all.push(refining(
        "edge, pairs as wished",
        edges_with(|settings| settings.pairs = Pairs::Wished),
    ));
    let with = |change: &dyn Fn(&mut Settings)| with_settings(&compared(loaded), change);
    all.push(of_settings(
        "base grid, edge 8 px",
        GRIDS
            .map(|k| (format!("4^{k}"), with(&|settings| gridded(settings, k))))
            .into(),
    ));
    all.push(of_settings(
        "levels, edge 8 px",
        vec![(
            format!("{NARROW_LEVEL}: keys of 32 bits"),
            with(&|settings| settings.max_level = settings.max_level.min(NARROW_LEVEL)),
        )],
    ));
    all.push(of_settings(
        "neighbours, edge 8 px",
        vec![(
            "off: cracks".to_owned(),
            with(&|settings| settings.balance = Balance::Off),
        )],
    ));
    if loaded
        .objects
        .iter()
        .any(|object| object.settings.back_faces != BackFaces::Drawn)
    {
        let ways = [BackFaces::Drawn, BackFaces::Hidden, BackFaces::Leaves];
        let culled = ways.map(|way| (way.name().to_owned(), with(&|settings| settings.back_faces = way)));
        all.push(of_settings("back faces, edge 8 px", culled.into()));
    }
    // De Boor's recursion takes the compiler of a software device some twenty seconds.
    let is_shown = |(method, _): &(BasisMethod, &str)| !(quick && *method == BasisMethod::DeBoor);
    let bases: Vec<_> = BASES
        .into_iter()
        .filter(is_shown)
        .map(|(m, name)| (m, name.to_owned()))
        .collect();
    let solvers = [
        (Solver::Ldlt, "LDLT".to_owned()),
        (Solver::Adjugate, "adjugate".to_owned()),
    ];
    let approximations = labelled(["PN triangles", "QAS", "Loop"], str::to_owned);
    all.extend([
        of_surfaces(loaded, "basis, edge 8 px", &bases, based),
        of_surfaces(
            loaded,
            "isolation, edge 8 px",
            &labelled(ISOLATIONS, |n| n.to_string()),
            |object, steps| reshaped(object, |shape| isolated(shape, steps)),
        ),
        of_surfaces(loaded, "solver, edge 8 px", &solvers, |object, solver| {
            reshaped(object, |shape| solved(shape, solver))
        }),
        of_surfaces(loaded, "approximation, edge 8 px", &approximations, |object, by| {
            reshaped(object, |shape| approximated(shape, by))
        }),
    ]);
    all.retain(|series| !series.points.is_empty());
    all
}
