//! Contours: where a surface turns from front to back.
//!
//! That of the surface is where normal · (eye − p) = 0: every drawn triangle's lattice is searched for changes of sign, and the
//! crossings are refined on the surface. That of triangles are the edges between one that faces the eye and one that does not. Both are
//! compared as curves in the picture. Contours that nearer parts hide count as well; boundaries do not, as culling makes some.

use super::domain::Domain;
use super::lattice::{cells, lattice};
use super::measure::Sum;
use super::tree::Tree;
use super::{DrawnTriangle, Measure, MeasureError, ScreenView, Truth};
use glam::{DVec2, DVec3};
use keyleaf_surface::Surface;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// How far the contours of triangles and surface are apart.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Silhouette {
    /// Pixels, the greater of both directions.
    pub error: Measure,
    /// Length of the surface's contour in the picture, pixels.
    pub length: f64,
}

type Segment = [DVec2; 2];

/// Steps of regula falsi to a crossing.
const STEPS: u32 = 24;
/// Samples a segment of the triangles' contour.
const SAMPLES: u32 = 4;

/// `None` where either has no contour in the picture. Needs all triangles of the visible part, back faces too.
pub(super) fn measure(
    surface: &dyn Surface,
    truth: Truth,
    triangles: &[DrawnTriangle],
    domains: &[Domain],
    view: &ScreenView,
    intervals: u32,
) -> Result<Option<Silhouette>, MeasureError> {
    let contour = Contour { surface, truth, view };
    let pairs: Vec<_> = triangles.iter().zip(domains).collect();
    let found: Vec<Vec<Segment>> = pairs
        .par_chunks(256)
        .map(|piece| {
            let mut segments = Vec::new();
            piece
                .iter()
                .try_for_each(|(t, domain)| contour.add(t, **domain, intervals, &mut segments))?;
            Ok(segments)
        })
        .collect::<Result<_, MeasureError>>()?;
    let of_surface: Vec<Segment> = found.into_iter().flatten().collect();
    let of_triangles = contour_edges(triangles, view);
    let (to_triangles, length) = distances(&of_surface, &of_triangles, view);
    let (to_surface, other_length) = distances(&of_triangles, &of_surface, view);
    let is_seen = length > 0.0 && other_length > 0.0;
    Ok(is_seen.then(|| Silhouette {
        error: to_triangles.measure().or(to_surface.measure()),
        length,
    }))
}

/// From the points of some segments in the picture to the nearest of others; and their length.
fn distances(from: &[Segment], to: &[Segment], view: &ScreenView) -> (Sum, f64) {
    let flat = |p: DVec2| p.extend(0.0);
    let tree = Tree::new(to.iter().map(|[a, b]| [flat(*a), flat(*b), flat(*b)]).collect());
    let (mut sum, mut length) = (Sum::default(), 0.0);
    if tree.is_empty() {
        return (sum, length);
    }
    for [a, b] in from {
        for i in 0..=SAMPLES {
            let is_end = i == 0 || i == SAMPLES;
            let weight = a.distance(*b) / f64::from(SAMPLES) * if is_end { 0.5 } else { 1.0 };
            let p = a.lerp(*b, f64::from(i) / f64::from(SAMPLES));
            if view.contains(p) {
                sum.add(tree.distance_squared(flat(p), f64::INFINITY).sqrt(), weight);
                length += weight;
            }
        }
    }
    (sum, length)
}

struct Contour<'a> {
    surface: &'a dyn Surface,
    truth: Truth,
    view: &'a ScreenView,
}

impl Contour<'_> {
    /// The surface's contour over a triangle.
    fn add(
        &self,
        triangle: &DrawnTriangle,
        domain: Domain,
        intervals: u32,
        segments: &mut Vec<Segment>,
    ) -> Result<(), MeasureError> {
        let [a, b, c] = triangle.corners.map(|corner| domain.parameters(corner.at));
        let points = lattice(intervals);
        let parameters: Vec<DVec2> = points
            .iter()
            .map(|p| a * p.weights[0] + b * p.weights[1] + c * p.weights[2])
            .collect();
        let facing: Vec<f64> = parameters
            .iter()
            .map(|at| Ok(self.facing(domain, *at)?.0))
            .collect::<Result<_, MeasureError>>()?;
        let is_front = |i: usize| facing[i] >= 0.0;
        if (0..points.len()).all(is_front) || !(0..points.len()).any(is_front) {
            return Ok(());
        }
        for cell in cells(intervals) {
            let mut ends = Vec::new();
            for [i, j] in [[0, 1], [1, 2], [2, 0]].map(|edge| edge.map(|k: usize| cell[k])) {
                if is_front(i) != is_front(j) {
                    let p = self.crossing(domain, [parameters[i], parameters[j]], [facing[i], facing[j]])?;
                    ends.extend(self.view.pixel(p));
                }
            }
            if let [from, to] = ends[..] {
                segments.push([from, to]);
            }
        }
        Ok(())
    }

    fn facing(&self, domain: Domain, at: DVec2) -> Result<(f64, DVec3), MeasureError> {
        let frame = self.truth.frame(self.surface, domain.point(self.surface, at)?);
        Ok((self.view.facing(frame.position, frame.normal), frame.position))
    }

    /// Where the surface turns between two parameters: regula falsi, Illinois variant.
    fn crossing(&self, domain: Domain, ends: [DVec2; 2], values: [f64; 2]) -> Result<DVec3, MeasureError> {
        let ([mut low, mut high], [mut below, mut above]) = ([0.0, 1.0], values);
        let at = |t: f64| ends[0].lerp(ends[1], t);
        for _ in 0..STEPS {
            if high - low < 1e-9 || below == 0.0 || above == 0.0 {
                break;
            }
            let t = (low - below * (high - low) / (above - below)).clamp(low, high);
            let value = self.facing(domain, at(t))?.0;
            if (value >= 0.0) == (below >= 0.0) {
                (low, below, above) = (t, value, above / 2.0);
            } else {
                (high, above, below) = (t, value, below / 2.0);
            }
        }
        let t = if below.abs() <= above.abs() { low } else { high };
        Ok(self.facing(domain, at(t))?.1)
    }
}

/// Edges between a triangle that faces the eye and one that does not. Edges are the same where their ends have the same bits, as they
/// have on a closed surface.
fn contour_edges(triangles: &[DrawnTriangle], view: &ScreenView) -> Vec<Segment> {
    let bits = |p: DVec3| (p + 0.0).to_array().map(f64::to_bits);
    let mut sides: HashMap<[[u64; 3]; 2], [bool; 2]> = HashMap::new();
    let mut contour = Vec::new();
    for triangle in triangles {
        let normal = triangle.area_vector();
        if normal == DVec3::ZERO {
            continue;
        }
        let [a, b, c] = triangle.positions();
        let is_front = view.facing(a, normal) >= 0.0;
        for [from, to] in [[a, b], [b, c], [c, a]] {
            let mut key = [bits(from), bits(to)];
            key.sort_unstable();
            let seen = sides.entry(key).or_default();
            let was_contour = seen[0] && seen[1];
            seen[usize::from(is_front)] = true;
            if seen[0] && seen[1] && !was_contour {
                contour.extend(view.pixel(from).zip(view.pixel(to)).map(|(a, b)| [a, b]));
            }
        }
    }
    contour
}
