//! Whether the sources of Bézier and NURBS surfaces are in their ranges.

use super::error::Problem;
use super::patches::{BezierSource, NurbsSource, PatchesSource, bezier_surface};
use super::validate::{Checked, file_name, within};

/// The largest tolerance: boundaries farther apart are not the same to any eye.
const MAX_TOLERANCE: f64 = 0.01;

pub(super) fn check_patches(field: &str, source: &PatchesSource) -> Checked {
    file_name(&format!("{field}.path"), &source.path)?;
    check_tolerance(field, source.tolerance)
}

pub(super) fn check_nurbs(field: &str, source: &NurbsSource) -> Checked {
    let list = format!("{field}.surfaces");
    some(&list, source.surfaces.len())?;
    for (index, patch) in source.surfaces.iter().enumerate() {
        patch
            .surface()
            .map_err(|problem| within_field(&format!("{list}[{index}]"), &problem))?;
    }
    check_tolerance(field, source.tolerance)
}

pub(super) fn check_bezier(field: &str, source: &BezierSource) -> Checked {
    let list = format!("{field}.patches");
    some(&list, source.patches.len())?;
    for (index, rows) in source.patches.iter().enumerate() {
        bezier_surface(rows).map_err(|problem| within_field(&format!("{list}[{index}]"), &problem))?;
    }
    check_tolerance(field, source.tolerance)
}

fn check_tolerance(field: &str, tolerance: f64) -> Checked {
    within(&format!("{field}.tolerance"), tolerance, 0.0, MAX_TOLERANCE)
}

fn some(field: &str, count: usize) -> Checked {
    if count > 0 {
        return Ok(());
    }
    Err(Problem::new(field, "the list is empty; expected at least one"))
}

/// A problem of a part, as one of the whole.
fn within_field(field: &str, problem: &Problem) -> Problem {
    let separator = if problem.field.is_empty() || problem.field.starts_with('[') {
        ""
    } else {
        "."
    };
    Problem::new(format!("{field}{separator}{}", problem.field), problem.problem.clone())
}
