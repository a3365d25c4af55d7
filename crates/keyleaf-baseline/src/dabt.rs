//! Dynamic and adaptive Bézier tessellation, DABT (thesis chapter 3): triangles with three resolutions, refined vertex
//! by vertex.
//!
//! Every KSQuad is 3 × 3 cells of two coarse triangles. Each edge of a coarse triangle has a resolution L of its own: L
//! candidate vertices on the edge, and those of the pattern of L in the third of the triangle that is nearest to the
//! edge. Each candidate passes a test ([`Test`]) or is left out. What decides about an edge is the edge alone, so that
//! both of its triangles agree. Vertices are then linked row by row. Points are counted in the unified pattern, whose
//! number of segments is the least common multiple of all others, hence exactly.
//!
//! Costs one to three evaluations a candidate; of a triangle with resolution 3 on all edges come at most 16.
//!
//! Departures:
//! - The thesis does not say how an edge gets its resolution. Here by its length on screen
//!   ([`Settings::segment_pixels`]).
//! - In the thirds of the left and right edge, per-edge decisions hold for the row of the candidate, as in the thesis.
//!   The base has no such rows; a candidate in its third is inserted if the line through it parallel to the left or to
//!   the right edge meets the base in an inserted one.
//! - A coarse triangle with a collapsed side has no candidates inside unless one of its edges has an inserted one.
//! - A candidate between two thirds belongs to both patterns that have it, and is inserted if either says so.

use crate::cells::{Cell, Cells};
use crate::coarse::{CellNodes, CoarseTriangle, EDGES, EdgePlan, Lattice, Plans, coarse_triangles};
use crate::insertion::{Settings, Test};
use crate::mesher::{Mesher, greatest_common_divisor};
use crate::rows::{rows, triangulate};
use crate::{BaselineError, Sampler, Tessellation, View};
use glam::DVec3;

/// Tessellates a model for a view.
///
/// # Errors
/// [`BaselineError`] if the model, the view or a setting is at fault.
pub fn tessellate(sampler: &dyn Sampler, view: &View, settings: &Settings) -> Result<Tessellation, BaselineError> {
    view.check()?;
    settings.check()?;
    let cells = Cells::spans(sampler, settings.coarse_cells)?;
    let plans = Plans::new(sampler, view, settings, &cells, unified(settings.max_resolution))?;
    let mut mesher = Mesher::new(sampler, &cells);
    for cell in &cells.cells {
        let diagonal = plans.diagonal(&cells, cell)?;
        let mut nodes = CellNodes::default();
        for triangle in coarse_triangles(&cells, cell) {
            let edges = plans.of_triangle(cell, triangle, &diagonal);
            let mut vertices = on_edges(&edges, plans.unit);
            let candidates = Interior::new(sampler, view, settings.test, &mut mesher, cell, triangle)?;
            // A triangle that is no more than an edge stays one.
            let sliver = candidates.collapsed && edges.iter().all(|edge| edge.inserted.is_empty());
            for edge in 0..if sliver { 0 } else { 3 } {
                candidates.insert(&mesher, &edges, edge, plans.unit, &mut vertices)?;
            }
            nodes.add(&mut mesher, cell, triangle, &triangulate(rows(vertices)))?;
        }
    }
    Ok(mesher.finish())
}

/// Segments of the unified pattern: the least common multiple of 1 to L_max + 1 (thesis 3.2.1).
fn unified(max_resolution: u32) -> u32 {
    (1..=max_resolution + 1).fold(1, |multiple, n| multiple / greatest_common_divisor(multiple, n) * n)
}

/// Corners and inserted candidates on the edges.
fn on_edges(edges: &[EdgePlan; 3], unit: u32) -> Vec<Lattice> {
    let mut vertices = vec![[unit, 0, 0], [0, unit, 0], [0, 0, unit]];
    for (edge, [a, b]) in edges.iter().zip(EDGES) {
        for &at in &edge.inserted {
            let mut w = [0; 3];
            w[a] = unit - at;
            w[b] = at;
            vertices.push(w);
        }
    }
    vertices
}

/// Decides about the candidates inside a triangle.
struct Interior<'a> {
    sampler: &'a dyn Sampler,
    view: &'a View,
    test: Test,
    cell: &'a Cell,
    triangle: &'a CoarseTriangle,
    corners: [DVec3; 3],
    /// Two of the corners are one vertex.
    collapsed: bool,
    /// Half the longest edge.
    radius: f64,
}

impl<'a> Interior<'a> {
    fn new(
        sampler: &'a dyn Sampler,
        view: &'a View,
        test: Test,
        mesher: &mut Mesher<'_>,
        cell: &'a Cell,
        triangle: &'a CoarseTriangle,
    ) -> Result<Self, BaselineError> {
        let mut corners = [DVec3::ZERO; 3];
        for (position, corner) in corners.iter_mut().zip(triangle.corners) {
            let node = mesher.corner(cell, corner)?;
            *position = mesher.position(node);
        }
        let vertices = triangle.corners.map(|corner| cell.corners[corner]);
        let collapsed = EDGES.into_iter().any(|[a, b]| vertices[a] == vertices[b]);
        let longest = EDGES
            .map(|[a, b]| corners[a].distance(corners[b]))
            .into_iter()
            .fold(0.0, f64::max);
        Ok(Self {
            sampler,
            view,
            test,
            cell,
            triangle,
            corners,
            collapsed,
            radius: longest / 2.0,
        })
    }

    /// Adds the candidates of the pattern of an edge, in its third, that are inserted.
    fn insert(
        &self,
        mesher: &Mesher<'_>,
        edges: &[EdgePlan; 3],
        edge: usize,
        unit: u32,
        vertices: &mut Vec<Lattice>,
    ) -> Result<(), BaselineError> {
        let segments = edges[edge].resolution + 1;
        let step = unit / segments;
        let opposite = 3 - EDGES[edge][0] - EDGES[edge][1];
        for i in 1..segments {
            for j in 1..segments - i {
                let w = [i * step, j * step, (segments - i - j) * step];
                let in_third = w.iter().all(|&other| w[opposite] <= other);
                if in_third && self.passes(mesher, &edges[edge], edge, unit, w)? {
                    vertices.push(w);
                }
            }
        }
        Ok(())
    }

    fn passes(
        &self,
        mesher: &Mesher<'_>,
        plan: &EdgePlan,
        edge: usize,
        unit: u32,
        w: Lattice,
    ) -> Result<bool, BaselineError> {
        if let Test::Distance { pixels } = self.test {
            let mut on_coarse = DVec3::ZERO;
            for (corner, w) in self.corners.into_iter().zip(w) {
                on_coarse += corner * (f64::from(w) / f64::from(unit));
            }
            let at = mesher.parameters(self.cell, self.triangle.fraction(w));
            let on_surface = crate::cells::position(self.sampler, self.cell.surface, at)?;
            let distance = on_coarse.distance(on_surface);
            return Ok(self.view.pixels_within(distance, on_coarse, self.radius) > pixels);
        }
        let inserted = |at: u32| plan.inserted.binary_search(&at).is_ok();
        Ok(match edge {
            1 => inserted(unit - w[1]) || inserted(w[2]),
            _ => inserted(unit - w[0]),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_resolutions_have_eleven_candidates_when_unified() {
        assert_eq!(unified(3), 12);
        assert_eq!(unified(crate::insertion::MAX_RESOLUTION), 720_720);
    }
}
