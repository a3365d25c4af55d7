//! Semi-adaptive tessellation (thesis chapter 4): candidates are tested on edges only, and whole rows follow.
//!
//! Between uniform and fully adaptive: the coarse triangles of [`dabt`](crate::dabt), one resolution, and triangle
//! strips between rows of the regular pattern. A row is left out if both of its ends are; one missing end is replaced
//! by a virtual vertex.
//!
//! Costs one to three evaluations a candidate on an edge.
//!
//! Departures:
//! - The thesis has one resolution a triangle and does not say how neighbours with different ones meet. Here there is
//!   one for the model: the greatest that any edge asks for.
//! - Candidates missing on the base, which the thesis shows complete, are left out of the last strip.
//! - Strips that would fold over a distant virtual vertex begin with the other row.

use crate::cells::Cells;
use crate::coarse::{CellNodes, EdgePlan, Plans, coarse_triangles, greatest_resolution};
use crate::insertion::Settings;
use crate::mesher::Mesher;
use crate::virtual_rows::{Pattern, strips, triangles};
use crate::{BaselineError, Sampler, Tessellation, View};

/// Tessellates a model for a view.
///
/// # Errors
/// [`BaselineError`] if the model, the view or a setting is at fault.
pub fn tessellate(sampler: &dyn Sampler, view: &View, settings: &Settings) -> Result<Tessellation, BaselineError> {
    view.check()?;
    settings.check()?;
    let cells = Cells::spans(sampler, settings.coarse_cells)?;
    let resolution = greatest_resolution(sampler, view, settings, &cells)?;
    let settings = Settings {
        segment_pixels: 0.0,
        max_resolution: resolution,
        ..*settings
    };
    let segments = resolution + 1;
    let plans = Plans::new(sampler, view, &settings, &cells, segments)?;
    let mut mesher = Mesher::new(sampler, &cells);
    for cell in &cells.cells {
        let diagonal = plans.diagonal(&cells, cell)?;
        let mut nodes = CellNodes::default();
        for triangle in coarse_triangles(&cells, cell) {
            let [left, base, right] = plans
                .of_triangle(cell, triangle, &diagonal)
                .map(|plan| flags(&plan, segments));
            let strips = strips(&Pattern { left, right, base });
            let found: Vec<_> = strips.iter().flat_map(|strip| triangles(strip)).collect();
            nodes.add(&mut mesher, cell, triangle, &found)?;
        }
    }
    Ok(mesher.finish())
}

fn flags(plan: &EdgePlan, segments: u32) -> Vec<bool> {
    let mut flags = vec![false; segments as usize + 1];
    flags[0] = true;
    flags[segments as usize] = true;
    for &at in &plan.inserted {
        flags[at as usize] = true;
    }
    flags
}
