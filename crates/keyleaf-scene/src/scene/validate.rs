//! Whether the values of a scene are in their ranges and fit each other.

use std::collections::HashSet;

use crate::MAX_COORDINATE;

use super::error::Problem;
use super::validate_patches::{check_bezier, check_nurbs, check_patches};
use super::validate_shape::{check_motion, check_shape};
use super::{
    CameraPath, Colouring, Effect, Light, Material, Metric, Morph, PathKey, Scene, Settings, SettingsOverrides, Source,
    SurfaceEntry, TerrainSource, Threshold,
};

pub(super) type Checked = Result<(), Problem>;

/// The largest `settle`.
const MAX_SETTLE: u32 = 64;
/// The largest `base_grid`.
const MAX_BASE_GRID: u32 = 6;

/// Checks a scene; the first problem is reported.
pub(super) fn validate(scene: &Scene) -> Checked {
    if scene.surfaces.is_empty() {
        return Err(Problem::new("surfaces", "a scene needs at least one surface"));
    }
    let unique = |list: &str, names: Vec<&String>| {
        let mut seen = HashSet::new();
        for (i, name) in names.into_iter().enumerate() {
            let field = format!("{list}[{i}].name");
            if name.trim().is_empty() {
                return Err(Problem::new(field, "the name is empty"));
            }
            if !seen.insert(name) {
                let problem = format!("the name `{name}` is there twice; names must be different");
                return Err(Problem::new(field, problem));
            }
        }
        Ok(())
    };
    unique("surfaces", scene.surfaces.iter().map(|s| &s.name).collect())?;
    unique("cameras", scene.cameras.iter().map(|c| &c.name).collect())?;
    unique("paths", scene.paths.iter().map(|p| &p.name).collect())?;
    for (i, surface) in scene.surfaces.iter().enumerate() {
        check_surface(&format!("surfaces[{i}]"), surface, &scene.settings)?;
    }
    check_settings(&scene.settings)?;
    check_light(&scene.light)?;
    for (i, effect) in scene.effects.iter().enumerate() {
        if scene.effects[..i]
            .iter()
            .any(|e| std::mem::discriminant(e) == std::mem::discriminant(effect))
        {
            return Err(Problem::new(format!("effects[{i}]"), "the effect is there twice"));
        }
        if let Effect::Fog(fog) = effect {
            positive(&format!("effects[{i}].distance"), fog.distance)?;
            colour(&format!("effects[{i}].colour"), &fog.colour, f32::MAX)?;
        }
    }
    for (i, camera) in scene.cameras.iter().enumerate() {
        let field = format!("cameras[{i}]");
        check_view(&field, camera.eye, camera.look_at, camera.fov)?;
        optional(&format!("{field}.near"), camera.near, positive)?;
    }
    scene
        .paths
        .iter()
        .enumerate()
        .try_for_each(|(i, path)| check_path(&format!("paths[{i}]"), path))
}

pub(super) fn finite(field: &str, value: f64) -> Checked {
    if value.abs() <= MAX_COORDINATE {
        return Ok(());
    }
    let problem = format!("{value} is not allowed; expected a finite number of at most {MAX_COORDINATE:e}");
    Err(Problem::new(field, problem))
}

pub(super) fn positive(field: &str, value: f64) -> Checked {
    finite(field, value)?;
    if value > 0.0 {
        return Ok(());
    }
    Err(Problem::new(
        field,
        format!("{value} is not allowed; expected a number above 0"),
    ))
}

pub(super) fn not_zero(field: &str, value: f64) -> Checked {
    finite(field, value)?;
    if value != 0.0 {
        return Ok(());
    }
    Err(Problem::new(field, "0 is not allowed; expected another number"))
}

/// Between two bounds, both allowed.
pub(super) fn within(field: &str, value: f64, low: f64, high: f64) -> Checked {
    if value >= low && value <= high {
        return Ok(());
    }
    let problem = format!("{value} is not allowed; expected a number from {low} to {high}");
    Err(Problem::new(field, problem))
}

/// Between two bounds, none allowed.
fn between(field: &str, value: f64, low: f64, high: f64) -> Checked {
    if value > low && value < high {
        return Ok(());
    }
    let problem = format!("{value} is not allowed; expected a number above {low} and below {high}");
    Err(Problem::new(field, problem))
}

fn optional<T>(field: &str, value: Option<T>, check: impl Fn(&str, T) -> Checked) -> Checked {
    value.map_or(Ok(()), |value| check(field, value))
}

pub(super) fn vector(field: &str, value: [f64; 3]) -> Checked {
    value.into_iter().try_for_each(|c| finite(field, c))
}

fn colour(field: &str, value: &[f32; 3], most: f32) -> Checked {
    match value.iter().find(|c| !(**c >= 0.0 && **c <= most)) {
        None => Ok(()),
        Some(c) if most == f32::MAX => Err(Problem::new(
            field,
            format!("{c} is not allowed; expected numbers of at least 0"),
        )),
        Some(c) => Err(Problem::new(
            field,
            format!("{c} is not allowed; expected numbers from 0 to {most}"),
        )),
    }
}

pub(super) fn file_name(field: &str, name: &str) -> Checked {
    if name.trim().is_empty() {
        return Err(Problem::new(field, "expected the path of a file"));
    }
    Ok(())
}

fn check_settings(settings: &Settings) -> Checked {
    check_metric("settings.metric", settings.metric)?;
    check_morph("settings.metric", settings.metric, settings.morph)?;
    let count = |name: &str, value: u32, low: u32, high: u32| {
        within(&format!("settings.{name}"), value.into(), low.into(), high.into())
    };
    count("base_grid", settings.base_grid, 0, MAX_BASE_GRID)?;
    count("capacity", settings.capacity, 1, u32::MAX)?;
    count("settle", settings.settle, 1, MAX_SETTLE)?;
    if let Some(target) = settings.target_leaves {
        count("target_leaves", target, 1, settings.capacity)?;
    }
    check_max_level("settings.max_level", settings.max_level, settings)?;
    within("settings.guard_band.margin", settings.guard_band.margin, 0.0, 10.0)?;
    finite("settings.guard_band.coarsen", settings.guard_band.coarsen)?;
    within(
        "settings.guard_band.coarsen",
        settings.guard_band.coarsen,
        1.0,
        MAX_COORDINATE,
    )
}

fn check_metric(field: &str, metric: Metric) -> Checked {
    match metric {
        Metric::Edge { pixels } => positive(&format!("{field}.pixels"), pixels),
        Metric::Distance { factor } => positive(&format!("{field}.factor"), factor),
        Metric::Deviation { pixels } | Metric::LocalArea { pixels } | Metric::LinearApproximation { pixels } => {
            positive(&format!("{field}.pixels"), pixels)
        }
        Metric::Boundary {
            pixels,
            boundary_pixels,
        } => {
            positive(&format!("{field}.pixels"), pixels)?;
            positive(&format!("{field}.boundary_pixels"), boundary_pixels)?;
            within(&format!("{field}.boundary_pixels"), boundary_pixels, 0.0, pixels)
        }
        Metric::FlatTest(Threshold::Units(cosine)) if cosine >= 1.0 => Err(Problem::new(
            field,
            format!("expected a cosine from 0 to below 1, found {cosine}"),
        )),
        Metric::FlatTest(Threshold::Units(cosine)) => within(field, cosine, 0.0, 1.0),
        Metric::DistanceTest(threshold) | Metric::FlatTest(threshold) | Metric::LengthTest(threshold) => {
            let (Threshold::Units(value) | Threshold::Pixels(value)) = threshold;
            positive(field, value)
        }
    }
}

fn check_morph(field: &str, metric: Metric, morph: Morph) -> Checked {
    if morph == Morph::None || metric.halves() {
        return Ok(());
    }
    let problem = "vertices morph by metrics that halve from level to level; expected Edge, Boundary or LocalArea, or `morph: None`";
    Err(Problem::new(field, problem))
}

fn check_max_level(field: &str, level: Option<u32>, settings: &Settings) -> Checked {
    let deepest = keyleaf_key::MAX_LEVEL.saturating_sub(settings.base_grid);
    optional(field, level, |field, level| {
        within(field, level.into(), 0.0, deepest.into())
    })
}

fn check_light(light: &Light) -> Checked {
    finite("light.azimuth", light.azimuth)?;
    within("light.elevation", light.elevation, -90.0, 90.0)?;
    colour("light.colour", &light.colour, f32::MAX)?;
    colour("light.ambient", &light.ambient, f32::MAX)?;
    positive("light.exposure", light.exposure.into())
}

fn check_surface(field: &str, surface: &SurfaceEntry, settings: &Settings) -> Checked {
    let source = format!("{field}.source");
    match &surface.source {
        Source::Mesh(path) => file_name(&source, path)?,
        Source::HeightField(map) => {
            file_name(&format!("{source}.path"), &map.path)?;
            if let Some(spacing) = map.spacing {
                spacing
                    .into_iter()
                    .try_for_each(|s| positive(&format!("{source}.spacing"), s))?;
            }
            not_zero(&format!("{source}.scale"), map.scale)?;
            finite(&format!("{source}.offset"), map.offset)?;
            if let Some(size) = map.raw_size {
                let side = |s: u32| within(&format!("{source}.raw_size"), s.into(), 2.0, 65_536.0);
                size.into_iter().try_for_each(side)?;
            }
        }
        Source::Terrain(terrain) => check_terrain(&source, terrain)?,
        Source::Patches(patches) => check_patches(&source, patches)?,
        Source::Nurbs(nurbs) => check_nurbs(&source, nurbs)?,
        Source::Bezier(bezier) => check_bezier(&source, bezier)?,
    }
    check_shape(&format!("{field}.surface"), surface)?;
    check_motion(&format!("{field}.motion"), surface)?;
    let transform = format!("{field}.transform");
    vector(&format!("{transform}.translation"), surface.transform.translation)?;
    vector(&format!("{transform}.rotation"), surface.transform.rotation)?;
    positive(&format!("{transform}.scale"), surface.transform.scale)?;
    check_material(&format!("{field}.material"), &surface.material)?;
    let is_patches = matches!(
        surface.source,
        Source::Patches(_) | Source::Nurbs(_) | Source::Bezier(_)
    );
    if is_patches && surface.material.texture.is_some() {
        let problem = "Bézier and NURBS surfaces have no texture coordinates; expected none";
        return Err(Problem::new(format!("{field}.material.texture"), problem));
    }
    let SettingsOverrides {
        metric,
        max_level,
        culling: _,
        back_faces: _,
    } = surface.settings;
    let metric_field = format!("{field}.settings.metric");
    optional(&metric_field, metric, check_metric)?;
    optional(&metric_field, metric, |field, metric| {
        check_morph(field, metric, settings.morph)
    })?;
    check_max_level(&format!("{field}.settings.max_level"), max_level, settings)
}

fn check_terrain(field: &str, terrain: &TerrainSource) -> Checked {
    positive(&format!("{field}.extent"), terrain.extent)?;
    positive(&format!("{field}.height"), terrain.height)?;
    within(&format!("{field}.first_level"), terrain.first_level.into(), 1.0, 28.0)?;
    let most = 29 - terrain.first_level;
    within(&format!("{field}.octaves"), terrain.octaves.into(), 1.0, most.into())?;
    within(&format!("{field}.gain"), terrain.gain, 0.0, 1.0)?;
    within(&format!("{field}.ridged"), terrain.ridged, 0.0, 1.0)?;
    within(&format!("{field}.contrast"), terrain.contrast, 0.0, 1.0)
}

fn check_material(field: &str, material: &Material) -> Checked {
    if let Some(base) = &material.base_colour {
        colour(&format!("{field}.base_colour"), base, 1.0)?;
    }
    if let Some(texture) = &material.texture {
        file_name(&format!("{field}.texture"), texture)?;
    }
    if let Some(matcap) = &material.matcap {
        file_name(&format!("{field}.matcap"), matcap)?;
        let place = format!("{field}.matcap");
        if material.texture.is_some() {
            let problem = "a texture and a matcap; expected only one of them";
            return Err(Problem::new(place, problem));
        }
        if material.colouring != Colouring::Plain {
            let problem = "a matcap, and colours that follow the shape; expected only one of them";
            return Err(Problem::new(place, problem));
        }
    }
    let Colouring::Terrain(colours) = &material.colouring else {
        return Ok(());
    };
    let field = format!("{field}.colouring");
    for (name, value) in [
        ("low", colours.low),
        ("high", colours.high),
        ("steep", colours.steep),
        ("snow", colours.snow),
    ] {
        colour(&format!("{field}.{name}"), &value, 1.0)?;
    }
    optional(&format!("{field}.snow_line"), colours.snow_line, finite)?;
    let ordered = |field: &str, [low, high]: [f64; 2]| {
        finite(field, low)?;
        finite(field, high)?;
        if low < high {
            return Ok(());
        }
        Err(Problem::new(
            field,
            format!("({low}, {high}): expected the first below the second"),
        ))
    };
    optional(&format!("{field}.heights"), colours.heights, ordered)?;
    let slopes = format!("{field}.slopes");
    ordered(&slopes, colours.slopes)?;
    colours
        .slopes
        .into_iter()
        .try_for_each(|s| within(&slopes, s, 0.0, 90.0))
}

fn check_view(field: &str, eye: [f64; 3], look_at: [f64; 3], fov: f64) -> Checked {
    vector(&format!("{field}.eye"), eye)?;
    vector(&format!("{field}.look_at"), look_at)?;
    if eye == look_at {
        return Err(Problem::new(format!("{field}.look_at"), "it is the same point as eye"));
    }
    between(&format!("{field}.fov"), fov, 0.0, 180.0)
}

/// Checks a path that is a file of its own.
pub(super) fn validate_path(path: &CameraPath) -> Checked {
    check_path("", path).map_err(|mut problem| {
        problem.field = problem.field.trim_start_matches('.').to_owned();
        problem
    })
}

fn check_path(field: &str, path: &CameraPath) -> Checked {
    if path.keys.is_empty() {
        return Err(Problem::new(
            format!("{field}.keys"),
            "a camera path needs at least one key",
        ));
    }
    optional(&format!("{field}.near"), path.near, positive)?;
    for (
        i,
        PathKey {
            time,
            eye,
            look_at,
            fov,
            ..
        },
    ) in path.keys.iter().enumerate()
    {
        let key = format!("{field}.keys[{i}]");
        finite(&format!("{key}.time"), *time)?;
        check_view(&key, *eye, *look_at, *fov)?;
        if i > 0 && *time <= path.keys[i - 1].time {
            let before = path.keys[i - 1].time;
            let problem = format!("{time} is not later than the key before, {before}; times must increase");
            return Err(Problem::new(format!("{key}.time"), problem));
        }
    }
    Ok(())
}
