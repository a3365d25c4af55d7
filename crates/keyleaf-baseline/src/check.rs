//! Is a tessellation a surface without cracks? Looks at the triangles and the model only, not at how they were made.

use crate::{Boundary, Sampler, Side, Tessellation};
use glam::DVec2;
use std::collections::HashMap;

/// How far from a side, relative to the domain, a point on it may lie.
const ON_SIDE: f64 = 1e-9;

/// What is wrong with a tessellation, and how much of the domains it covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    /// Edges of one triangle only that do not lie on a free side: cracks, and T-junctions.
    pub open_edges: usize,
    /// Edges of more than two triangles.
    pub crowded_edges: usize,
    /// Triangles with a vertex twice or with one that does not exist.
    pub broken_triangles: usize,
    /// Triangles without a positive area in the domain: folds and slivers.
    pub folded_triangles: usize,
    /// Positions or parameters that are NaN or infinite.
    pub not_finite: usize,
    /// The least share of its domain, slivers included, that a surface has covered; below 1 where there are holes.
    pub least_covered: f64,
    /// The greatest share; above 1 where triangles overlap.
    pub most_covered: f64,
}

impl Report {
    /// No cracks, folds, overlaps, holes or NaN.
    pub fn is_watertight(&self) -> bool {
        let faults =
            self.open_edges + self.crowded_edges + self.broken_triangles + self.folded_triangles + self.not_finite;
        faults == 0 && self.most_covered <= 1.0 + ON_SIDE && self.least_covered >= 1.0 - ON_SIDE
    }
}

/// Checks that every edge has two triangles, or one on a free side, that no triangle is folded or overlaps, and that
/// all is finite.
///
/// Edges are told apart by their vertices, which are welded, so equal positions are no excuse.
pub fn check(sampler: &dyn Sampler, tessellation: &Tessellation) -> Report {
    let domains: Vec<[DVec2; 2]> = (0..sampler.surfaces())
        .map(|surface| domain(sampler, surface))
        .collect();
    let mut covered = vec![0.0; domains.len()];
    let mut report = Report {
        open_edges: 0,
        crowded_edges: 0,
        broken_triangles: tessellation.triangles.len().abs_diff(tessellation.domains.len()),
        folded_triangles: 0,
        not_finite: tessellation
            .positions
            .iter()
            .filter(|position| !position.is_finite())
            .count(),
        least_covered: 1.0,
        most_covered: 0.0,
    };
    // By vertices: how many triangles, and whether one of them has the edge on a free side.
    let mut edges: HashMap<[u32; 2], (usize, bool)> = HashMap::new();
    for (&triangle, &(surface, at)) in tessellation.triangles.iter().zip(&tessellation.domains) {
        let [a, b, c] = triangle;
        let exists = |vertex: u32| (vertex as usize) < tessellation.positions.len();
        let Some(&[first, last]) = domains.get(surface as usize) else {
            report.broken_triangles += 1;
            continue;
        };
        if a == b || b == c || c == a || !triangle.into_iter().all(exists) {
            report.broken_triangles += 1;
            continue;
        }
        report.not_finite += at.iter().filter(|at| !at.is_finite()).count();
        let t = at.map(|at| (at - first) / (last - first));
        let area = (t[1] - t[0]).perp_dot(t[2] - t[0]) / 2.0;
        report.folded_triangles += usize::from(area.is_nan() || area <= 0.0);
        covered[surface as usize] += area;
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            let key = [triangle[i].min(triangle[j]), triangle[i].max(triangle[j])];
            let edge = edges.entry(key).or_insert((0, false));
            edge.0 += 1;
            edge.1 |= on_free_side(sampler, surface as usize, t[i], t[j]);
        }
    }
    for sliver in &tessellation.slivers {
        let Some(&[first, last]) = domains.get(sliver.surface as usize) else {
            report.broken_triangles += 1;
            continue;
        };
        let t = sliver.at.map(|at| (at - first) / (last - first));
        covered[sliver.surface as usize] += (t[1] - t[0]).perp_dot(t[2] - t[0]) / 2.0;
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            let [a, b] = [sliver.vertices[i], sliver.vertices[j]];
            let edge = edges.entry([a.min(b), a.max(b)]).or_insert((0, false));
            edge.1 |= on_free_side(sampler, sliver.surface as usize, t[i], t[j]);
        }
    }
    for (triangles, free) in edges.into_values() {
        report.open_edges += usize::from(triangles == 1 && !free);
        report.crowded_edges += usize::from(triangles > 2);
    }
    for share in covered {
        report.least_covered = share.min(report.least_covered);
        report.most_covered = share.max(report.most_covered);
    }
    report
}

pub(crate) fn domain(sampler: &dyn Sampler, surface: usize) -> [DVec2; 2] {
    let ends = sampler.spans(surface).map(|knots| {
        let end = |knot: Option<&f64>| knot.copied().unwrap_or(f64::NAN);
        [end(knots.first()), end(knots.last())]
    });
    [DVec2::new(ends[0][0], ends[1][0]), DVec2::new(ends[0][1], ends[1][1])]
}

/// Whether an edge, in normalised parameters, lies on a side beyond which there is nothing.
fn on_free_side(sampler: &dyn Sampler, surface: usize, a: DVec2, b: DVec2) -> bool {
    Side::ALL.into_iter().any(|side| {
        let near = |at: DVec2| {
            let line = side.at(0.5);
            let (across, on) = if side.runs_along() == 0 {
                (at.y, line.y)
            } else {
                (at.x, line.x)
            };
            (across - on).abs() <= ON_SIDE
        };
        near(a) && near(b) && sampler.boundary(surface, side) == Boundary::Free
    })
}
