//! `.bpt`: Bézier patches, each with control points of its own.
//!
//! The number of patches; for each patch a line with its degrees p and q, then (p + 1)(q + 1) lines `x y z`, those along the first
//! parameter next to each other (R. Holmes, BPT Bézier Patch File Format, 2003).

use std::path::Path;

use keyleaf_surface::NurbsSurface;

use crate::error::ImportError;

use super::lines::Lines;

/// The degrees that surfaces may have.
const DEGREES: std::ops::RangeInclusive<u32> = 1..=7;

/// Reads the patches of a file; `file` names it in errors.
pub(super) fn read(file: &Path, text: &str) -> Result<Vec<NurbsSurface>, ImportError> {
    let mut lines = Lines::new(file, text);
    let count = lines.count("patches")?;
    let mut patches = Vec::new();
    for number in 1..=count {
        patches.push(patch(&mut lines, number, count)?);
    }
    lines.end("patches")?;
    Ok(patches)
}

fn patch(lines: &mut Lines<'_>, number: usize, count: usize) -> Result<NurbsSurface, ImportError> {
    let degree: [u32; 2] = lines.values(&format!("the two degrees of patch {number} of {count}"))?;
    if let Some(wrong) = degree.iter().find(|degree| !DEGREES.contains(degree)) {
        return Err(lines.error(format!("the degree {wrong} of patch {number} is not from 1 to 7")));
    }
    let [columns, rows] = degree.map(|degree| degree as usize + 1);
    let mut points = Vec::new();
    for _ in 0..columns * rows {
        points.push(lines.position("control point")?);
    }
    let weights = vec![1.0; points.len()];
    NurbsSurface::bezier(degree, points, weights).map_err(|error| lines.error(error.to_string()))
}
