//! The tea set of Martin Newell, as it is passed on since 1991: bicubic Bézier patches that share control points.
//!
//! The number of patches; for each patch a line with the 16 numbers of its control points, counted from 1, four to a row; the number
//! of vertices; for each vertex a line with its coordinates. Values are separated by commas.

use std::path::Path;

use glam::DVec3;
use keyleaf_surface::NurbsSurface;

use crate::error::{FilePlace, ImportError};

use super::lines::Lines;

/// Control points of a patch.
const CONTROLS: usize = 16;

/// Whether a text begins like a file of the tea set: a number, then a line of 16 numbers.
pub(super) fn is_teaset(bytes: &[u8]) -> bool {
    let text = String::from_utf8_lossy(bytes);
    let mut lines = text.lines().filter(|line| !line.trim().is_empty());
    let is_count = |line: &str| line.trim().parse::<u32>().is_ok();
    lines.next().is_some_and(is_count)
        && lines
            .next()
            .is_some_and(|line| line.split(',').count() == CONTROLS && line.split(',').all(is_count))
}

/// Reads the patches of a file; `file` names it in errors.
pub(super) fn read(file: &Path, text: &str) -> Result<Vec<NurbsSurface>, ImportError> {
    let mut lines = Lines::new(file, text);
    let patch_count = lines.count("patches")?;
    let mut patches = Vec::new();
    for number in 1..=patch_count {
        let what = format!("the 16 control points of patch {number} of {patch_count}");
        let controls: [i64; CONTROLS] = lines.values(&what)?;
        patches.push((controls, lines.number()));
    }
    let vertex_count = lines.count("vertices")?;
    let mut vertices = Vec::new();
    for _ in 0..vertex_count {
        vertices.push(lines.position("vertex")?);
    }
    lines.end("vertices")?;
    patches
        .into_iter()
        .map(|(controls, line)| patch(file, line, &controls, &vertices))
        .collect()
}

fn patch(file: &Path, line: usize, controls: &[i64], vertices: &[DVec3]) -> Result<NurbsSurface, ImportError> {
    let vertex = |&index: &i64| {
        let position = usize::try_from(index).ok().and_then(|index| index.checked_sub(1));
        let vertex = position.and_then(|position| vertices.get(position));
        vertex.copied().ok_or_else(|| ImportError::IndexOutOfRange {
            file: file.to_path_buf(),
            place: FilePlace::Line(line),
            what: "control point",
            index,
            count: vertices.len(),
        })
    };
    let points = controls.iter().map(vertex).collect::<Result<Vec<DVec3>, _>>()?;
    NurbsSurface::bezier([3, 3], points, vec![1.0; CONTROLS])
        .map_err(|error| ImportError::malformed(file, FilePlace::Line(line), error.to_string()))
}
