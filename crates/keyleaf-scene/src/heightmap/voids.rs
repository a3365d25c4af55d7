//! Which samples of a height map are voids.
//!
//! - Always: what is not a finite number, and the explicit void value (of the scene, or of a TIFF's `GDAL_NODATA`).
//! - If a sidecar lists all voids: those, and no others. If it says that there are more than it lists: those, and what
//!   is found by the rules below.
//! - Else the usual marks −32768, −32767, 65535, also wrapped to 32768 and 32769 in unsigned maps (and −9999 and
//!   beyond ±10³⁰ in float maps), where no other sample is near such a value: in a map that uses the whole range of
//!   its integers they are heights.
//! - And, in maps of whole metres (integers of 16 bits or more, none above [`HIGHEST_METRES`]), connected zeros whose
//!   bordering samples have a median of more than [`SHORE`] quanta, unless they are more than a quarter of the map: a
//!   real sea has a shore.

use std::collections::BTreeSet;
use std::path::Path;

use crate::error::{FilePlace, ImportError};
use crate::note::Note;

use super::decode::{Raster, SampleKind};
use super::sidecar::Sidecar;

/// A region of zeros is a void if the samples around it are higher than this, in the median, in quanta.
const SHORE: f32 = 30.0;
/// How far other samples must be from a mark for it to be one, in quanta of integers: a map that uses their whole
/// range has samples in between.
const GAP: f32 = 10_000.0;
/// The same for floats, in their own unit.
const FLOAT_GAP: f32 = 100.0;
/// Maps with samples above this are not in metres of the Earth: there a step of 30 quanta may be a shore.
const HIGHEST_METRES: f32 = 9000.0;

/// A mask of the voids.
pub(super) fn find(
    file: &Path,
    raster: &Raster,
    void_value: Option<f32>,
    sidecar: Option<&Sidecar>,
    notes: &mut Vec<Note>,
) -> Result<Vec<bool>, ImportError> {
    let explicit = [void_value, raster.no_data];
    let is_explicit = |s: f32| !s.is_finite() || explicit.contains(&Some(s));
    let mut mask: Vec<bool> = raster.samples.iter().map(|&s| is_explicit(s)).collect();
    if let Some((sidecar, listed)) = sidecar.and_then(|s| Some((s, s.voids.as_ref()?))) {
        for &[row, column] in listed {
            if row >= raster.height || column >= raster.width {
                let reason = format!(
                    "the listed void is outside the map of {}x{} samples",
                    raster.width, raster.height
                );
                let place = FilePlace::Sample { row, column };
                return Err(ImportError::malformed(&file.with_extension("json"), place, reason));
            }
            mask[row * raster.width + column] = true;
        }
        let count = sidecar.n_void.unwrap_or(listed.len());
        if count <= listed.len() {
            return Ok(mask);
        }
        let text = format!(
            "the sidecar lists {} of {count} voids; the others are looked for",
            listed.len()
        );
        notes.push(Note::remark(file, text));
    }
    let marks = marks(raster, &mask);
    if !marks.is_empty() {
        for (void, sample) in mask.iter_mut().zip(&raster.samples) {
            *void |= marks.contains(sample);
        }
        if raster.kind == SampleKind::Float {
            let absurd = |s: &f32| s.abs() > 1e30;
            mask.iter_mut()
                .zip(&raster.samples)
                .for_each(|(void, s)| *void |= absurd(s));
        }
        notes.push(Note::remark(
            file,
            format!("samples of value {} are taken for voids", shown(&marks)),
        ));
    }
    let zeros = mark_dry_zeros(raster, &mut mask);
    if zeros > 0 {
        let text = format!("{zeros} zeros without a shore are taken for voids");
        notes.push(Note::remark(file, text));
    }
    Ok(mask)
}

fn shown(marks: &[f32]) -> String {
    marks.iter().map(f32::to_string).collect::<Vec<_>>().join(", ")
}

/// The usual marks that are in the map, without other samples near them.
fn marks(raster: &Raster, mask: &[bool]) -> Vec<f32> {
    let candidates: &[f32] = match raster.kind {
        SampleKind::Byte => &[],
        SampleKind::Unsigned => &[32768.0, 32769.0, 65535.0],
        SampleKind::Signed => &[-32768.0, -32767.0],
        SampleKind::Float => &[-32768.0, -32767.0, -9999.0],
    };
    let known = || {
        raster
            .samples
            .iter()
            .zip(mask)
            .filter(|(_, void)| !**void)
            .map(|(s, _)| *s)
    };
    let gap = if raster.kind == SampleKind::Float {
        FLOAT_GAP
    } else {
        GAP
    };
    let mut found = BTreeSet::new();
    let mut near = BTreeSet::new();
    for sample in known() {
        if sample.abs() > 1e30 || candidates.contains(&sample) {
            found.insert(sample.to_bits());
        } else {
            near.extend(
                candidates
                    .iter()
                    .filter(|c| (**c - sample).abs() <= gap)
                    .map(|c| c.to_bits()),
            );
        }
    }
    found
        .difference(&near)
        .take(8)
        .map(|&bits| f32::from_bits(bits))
        .collect()
}

/// Marks connected zeros with high borders; says how many samples.
fn mark_dry_zeros(raster: &Raster, mask: &mut [bool]) -> usize {
    let (width, height, samples) = (raster.width, raster.height, &raster.samples);
    let known = samples.iter().zip(mask.iter()).filter(|(_, void)| !**void);
    let highest = known.map(|(s, _)| *s).fold(0.0, f32::max);
    let is_integer = matches!(raster.kind, SampleKind::Unsigned | SampleKind::Signed);
    if !is_integer || highest > HIGHEST_METRES {
        return 0;
    }
    let mut seen = vec![false; samples.len()];
    let mut marked = 0;
    for start in 0..samples.len() {
        if samples[start] != 0.0 || seen[start] || mask[start] {
            continue;
        }
        let mut component = vec![start];
        let mut border = Vec::new();
        seen[start] = true;
        let mut next = 0;
        while let Some(&at) = component.get(next) {
            next += 1;
            for neighbour in neighbours(at, width, height) {
                if mask[neighbour] {
                    continue;
                }
                if samples[neighbour] != 0.0 {
                    border.push(samples[neighbour]);
                } else if !std::mem::replace(&mut seen[neighbour], true) {
                    component.push(neighbour);
                }
            }
        }
        let is_small = component.len() <= samples.len() / 4;
        if is_small && median(&mut border).is_some_and(|m| m > SHORE) {
            marked += component.len();
            component.iter().for_each(|&at| mask[at] = true);
        }
    }
    marked
}

fn median(values: &mut [f32]) -> Option<f32> {
    values.sort_by(f32::total_cmp);
    values.get(values.len() / 2).copied()
}

/// The up to four samples beside one.
pub(super) fn neighbours(at: usize, width: usize, height: usize) -> impl Iterator<Item = usize> + Clone {
    let (row, column) = (at / width, at % width);
    let all = [
        (row > 0).then(|| at - width),
        (column > 0).then(|| at - 1),
        (column + 1 < width).then(|| at + 1),
        (row + 1 < height).then(|| at + width),
    ];
    all.into_iter().flatten()
}
