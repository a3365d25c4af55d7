//! Whether the shape of a surface is in its ranges, fits its source, and can move as it is to.

use std::collections::HashSet;

use super::error::Problem;
use super::motion::{GroupTrack, Motion, Track};
use super::subdivision::{Covariances, GaussianShape, Sharpness};
use super::validate::{Checked, file_name, finite, not_zero, positive, vector, within};
use super::{DisplacedSource, DisplacementHeight, Shape, Source, SurfaceEntry};

/// The largest isolation.
const MAX_ISOLATION: u32 = 16;
/// Standard deviations over the mean length of the edges.
const LEAST_FACTOR: f64 = 1e-6;
const MOST_FACTOR: f64 = 1e6;
/// Standard deviation across a surface over that along it.
const LEAST_FLATNESS: f64 = 1e-3;

pub(super) fn check_shape(field: &str, surface: &SurfaceEntry) -> Checked {
    let shape = &surface.surface;
    if !matches!(shape, Shape::Flat) && !matches!(surface.source, Source::Mesh(_)) {
        let problem = format!("only a Mesh can be {}; expected Flat", shape.name());
        return Err(Problem::new(field, problem));
    }
    match shape {
        Shape::Flat | Shape::PnTriangles | Shape::Qas(_) => Ok(()),
        Shape::Displaced(displaced) => check_displaced(field, displaced),
        Shape::CatmullClark(shape) => {
            isolation(field, shape.isolation)?;
            check_sharpness(field, &shape.sharpness)
        }
        Shape::Loop(shape) => {
            isolation(field, shape.isolation)?;
            check_sharpness(field, &shape.sharpness)
        }
        Shape::GaussianProduct(shape) => check_gaussian(field, shape),
    }
}

fn check_displaced(field: &str, displaced: &DisplacedSource) -> Checked {
    let height = format!("{field}.height");
    match &displaced.height {
        DisplacementHeight::Texture(texture) => {
            file_name(&format!("{height}.path"), &texture.path)?;
            not_zero(&format!("{height}.amplitude"), texture.amplitude)?;
            finite(&format!("{height}.middle"), texture.middle)
        }
        DisplacementHeight::Noise(noise) => {
            not_zero(&format!("{height}.amplitude"), noise.amplitude)?;
            positive(&format!("{height}.wavelength"), noise.wavelength)?;
            within(&format!("{height}.octaves"), noise.octaves.into(), 1.0, 16.0)?;
            within(&format!("{height}.gain"), noise.gain, 0.0, 1.0)
        }
    }
}

fn check_gaussian(field: &str, shape: &GaussianShape) -> Checked {
    let covariances = format!("{field}.covariances");
    match &shape.covariances {
        Covariances::FromFile => {}
        Covariances::File(path) => file_name(&covariances, path)?,
        Covariances::Isotropic(factor) => within(&covariances, *factor, LEAST_FACTOR, MOST_FACTOR)?,
        Covariances::FromNormals(normals) => {
            within(
                &format!("{covariances}.factor"),
                normals.factor,
                LEAST_FACTOR,
                MOST_FACTOR,
            )?;
            within(
                &format!("{covariances}.flatness"),
                normals.flatness,
                LEAST_FLATNESS,
                1.0,
            )?;
        }
    }
    isolation(field, shape.isolation)?;
    check_sharpness(field, &shape.sharpness)
}

fn isolation(field: &str, value: u32) -> Checked {
    within(&format!("{field}.isolation"), value.into(), 0.0, MAX_ISOLATION.into())
}

fn check_sharpness(field: &str, sharpness: &Sharpness) -> Checked {
    let not_negative = |field: String, value: f64| {
        finite(&field, value)?;
        if value >= 0.0 {
            return Ok(());
        }
        let problem = format!("the sharpness {value} is not allowed; expected a number of at least 0");
        Err(Problem::new(field, problem))
    };
    let mut edges = HashSet::new();
    for (index, &(a, b, value)) in sharpness.creases.iter().enumerate() {
        let place = format!("{field}.sharpness.creases[{index}]");
        if a == b {
            let problem = format!("a crease from vertex {a} to itself; expected the two ends of an edge");
            return Err(Problem::new(place, problem));
        }
        if !edges.insert([a.min(b), a.max(b)]) {
            let problem = format!("the crease from vertex {a} to vertex {b} is there twice");
            return Err(Problem::new(place, problem));
        }
        not_negative(place, value)?;
    }
    let mut vertices = HashSet::new();
    for (index, &(vertex, value)) in sharpness.corners.iter().enumerate() {
        let place = format!("{field}.sharpness.corners[{index}]");
        if !vertices.insert(vertex) {
            let problem = format!("the corner at vertex {vertex} is there twice");
            return Err(Problem::new(place, problem));
        }
        not_negative(place, value)?;
    }
    Ok(())
}

pub(super) fn check_motion(field: &str, surface: &SurfaceEntry) -> Checked {
    let Motion::Keys(tracks) = &surface.motion else {
        return Ok(());
    };
    if matches!(surface.surface, Shape::Flat | Shape::Displaced(_)) {
        let problem = "only a control mesh can move; expected Still, or a surface such as CatmullClark()";
        return Err(Problem::new(field, problem));
    }
    if tracks.is_empty() {
        return Err(Problem::new(field, "the list is empty; expected at least one track"));
    }
    let mut names = HashSet::new();
    for (index, track) in tracks.iter().enumerate() {
        let place = format!("{field}[{index}]");
        match track {
            Track::Group(group) => check_group(&place, group, &mut names)?,
            Track::Blend(blend) => {
                file_name(&format!("{place}.path"), &blend.path)?;
                if blend.keys.is_empty() {
                    let problem = "the list is empty; expected at least one key";
                    return Err(Problem::new(format!("{place}.keys"), problem));
                }
                check_times(&place, blend.keys.iter().map(|key| key.time))?;
                for (index, key) in blend.keys.iter().enumerate() {
                    finite(&format!("{place}.keys[{index}].weight"), key.weight)?;
                }
            }
        }
    }
    Ok(())
}

fn check_group<'a>(field: &str, group: &'a GroupTrack, names: &mut HashSet<&'a str>) -> Checked {
    if group.name.trim().is_empty() {
        return Err(Problem::new(format!("{field}.name"), "the name is empty"));
    }
    if let Some(parent) = &group.parent
        && !names.contains(parent.as_str())
    {
        let problem = format!("no group before this one has the name `{parent}`; parents come first");
        return Err(Problem::new(format!("{field}.parent"), problem));
    }
    if !names.insert(&group.name) {
        let problem = format!("the name `{}` is there twice; names must be different", group.name);
        return Err(Problem::new(format!("{field}.name"), problem));
    }
    for (index, &(first, last)) in group.vertices.iter().enumerate() {
        if first > last {
            let problem = format!("({first}, {last}): expected the first vertex of the range before the last");
            return Err(Problem::new(format!("{field}.vertices[{index}]"), problem));
        }
    }
    vector(&format!("{field}.pivot"), group.pivot)?;
    check_times(field, group.keys.iter().map(|key| key.time))?;
    for (index, key) in group.keys.iter().enumerate() {
        let key_field = format!("{field}.keys[{index}]");
        vector(&format!("{key_field}.translation"), key.translation)?;
        vector(&format!("{key_field}.rotation"), key.rotation)?;
        positive(&format!("{key_field}.scale"), key.scale)?;
    }
    Ok(())
}

/// Whether times are finite and increase.
fn check_times(field: &str, times: impl Iterator<Item = f64>) -> Checked {
    let mut before = f64::NEG_INFINITY;
    for (index, time) in times.enumerate() {
        let place = format!("{field}.keys[{index}].time");
        finite(&place, time)?;
        if time <= before {
            let problem = format!("{time} is not later than the key before, {before}");
            return Err(Problem::new(place, problem));
        }
        before = time;
    }
    Ok(())
}
