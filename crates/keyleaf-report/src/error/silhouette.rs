//! Contours: where a surface turns from front to back.
//!
//! That of the surface is where (du × dv) · (eye − p) = 0: every drawn triangle's lattice is searched for changes of sign, and the
//! crossings are refined on the surface; and where that sign differs between both sides of a triangle's edge, as at creases. That of
//! triangles are the edges between one that faces the eye and one that does not. Both are compared as curves in the picture. Contours
//! that nearer parts hide count as well; boundaries do not, as culling makes some.

use super::domain::Domain;
use super::lattice::{along_edges, cells, lattice};
use super::measure::Sum;
use super::tree::Tree;
use super::{DrawnTriangle, Measure, MeasureError, ScreenView, Truth};
use glam::{DVec2, DVec3};
use keyleaf_surface::{Surface, SurfaceFrame};
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
    let found: Vec<Found> = pairs
        .par_chunks(256)
        .map(|piece| {
            let mut found = Found::default();
            piece
                .iter()
                .try_for_each(|(t, domain)| contour.add(t, **domain, intervals, &mut found))?;
            Ok(found)
        })
        .collect::<Result<_, MeasureError>>()?;
    let (segments, edges): (Vec<_>, Vec<_>) = found.into_iter().map(|found| (found.segments, found.edges)).unzip();
    let mut of_surface: Vec<Segment> = segments.into_iter().flatten().collect();
    add_creases(edges.into_iter().flatten(), view, &mut of_surface);
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

/// The ends of an edge by their bits, the smaller first.
type EdgeKey = [[u64; 3]; 2];

/// Whether the first end is the first of the key.
fn edge_key(from: DVec3, to: DVec3) -> (EdgeKey, bool) {
    let bits = |p: DVec3| (p + 0.0).to_array().map(f64::to_bits);
    let (from, to) = (bits(from), bits(to));
    if from <= to {
        ([from, to], true)
    } else {
        ([to, from], false)
    }
}

/// The surface along a drawn triangle's edge that lies on a mesh edge, on the triangle's side, in the direction of the key.
struct EdgeSide {
    key: EdgeKey,
    points: Vec<Seen>,
}

/// A point of the surface.
#[derive(Clone, Copy)]
struct Seen {
    position: DVec3,
    /// That of the surface, however it is shaded.
    normal: DVec3,
    /// The cosine between it and the way to the eye.
    facing: f64,
}

/// Two normals with a smaller cosine, 1.4e-4 radians, are those of a crease.
const CREASE: f64 = 1.0 - 1e-8;

/// What some triangles have of the surface's contour.
#[derive(Default)]
struct Found {
    segments: Vec<Segment>,
    edges: Vec<EdgeSide>,
}

/// The parts of edges on whose sides the surface faces the eye here and not there.
fn add_creases(edges: impl Iterator<Item = EdgeSide>, view: &ScreenView, segments: &mut Vec<Segment>) {
    let mut first_sides: HashMap<EdgeKey, EdgeSide> = HashMap::new();
    for side in edges {
        let Some(other) = first_sides.remove(&side.key) else {
            first_sides.insert(side.key, side);
            continue;
        };
        for (own, others) in side.points.windows(2).zip(other.points.windows(2)) {
            let is_front = |ends: &[Seen]| ends[0].facing + ends[1].facing >= 0.0;
            let is_crease = own.iter().zip(others).any(|(a, b)| a.normal.dot(b.normal) < CREASE);
            if is_crease && is_front(own) != is_front(others) {
                let [from, to] = [0, 1].map(|i| view.pixel(own[i].position));
                segments.extend(from.zip(to).map(|(a, b)| [a, b]));
            }
        }
    }
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
        found: &mut Found,
    ) -> Result<(), MeasureError> {
        let corners = triangle.corners.map(|corner| domain.parameters(corner.at));
        let on_mesh_edge = [0, 1, 2].map(|k| domain.has_edge([corners[k], corners[(k + 1) % 3]]));
        if !on_mesh_edge.contains(&true) && self.is_far(domain, corners)? {
            return Ok(());
        }
        let [a, b, c] = corners;
        let parameters: Vec<DVec2> = lattice(intervals)
            .iter()
            .map(|p| a * p.weights[0] + b * p.weights[1] + c * p.weights[2])
            .collect();
        let points = parameters.iter().map(|at| self.seen(domain, *at));
        let points: Vec<Seen> = points.collect::<Result<_, MeasureError>>()?;
        let ends = triangle.positions();
        for (k, along) in along_edges(intervals).into_iter().enumerate() {
            if !on_mesh_edge[k] {
                continue; // no crease inside a face
            }
            let (key, is_forward) = edge_key(ends[k], ends[(k + 1) % 3]);
            let mut side = EdgeSide {
                key,
                points: along.iter().map(|&i| points[i]).collect(),
            };
            if !is_forward {
                side.points.reverse();
            }
            found.edges.push(side);
        }
        let is_front = |i: usize| points[i].facing >= 0.0;
        if (0..points.len()).all(is_front) || !(0..points.len()).any(is_front) {
            return Ok(());
        }
        for cell in cells(intervals) {
            let mut ends = Vec::new();
            for [i, j] in [[0, 1], [1, 2], [2, 0]].map(|edge| edge.map(|k: usize| cell[k])) {
                if is_front(i) != is_front(j) {
                    let p = self.crossing(domain, [i, j].map(|i| parameters[i]), [i, j].map(|i| points[i].facing))?;
                    ends.extend(self.view.pixel(p));
                }
            }
            if let [from, to] = ends[..] {
                found.segments.push([from, to]);
            }
        }
        Ok(())
    }

    /// Whether the surface over a triangle faces one way, as far as the corners tell: all normals by more than they differ.
    fn is_far(&self, domain: Domain, corners: [DVec2; 3]) -> Result<bool, MeasureError> {
        let [a, b, c] = corners.map(|at| self.seen(domain, at));
        let ends = [a?, b?, c?];
        let spread = [[0, 1], [1, 2], [2, 0]].map(|[i, j]| ends[i].normal.distance(ends[j].normal));
        let spread = spread.into_iter().fold(0.0, f64::max);
        Ok(ends.iter().all(|end| end.facing > spread) || ends.iter().all(|end| end.facing < -spread))
    }

    fn seen(&self, domain: Domain, at: DVec2) -> Result<Seen, MeasureError> {
        let SurfaceFrame {
            position,
            du,
            dv,
            normal,
        } = self.truth.frame(self.surface, domain.point(self.surface, at)?);
        // Polygons may be shaded by other normals than their own. At poles there is only the normal.
        let across = du.cross(dv).normalize_or_zero();
        let normal = if across.dot(normal) > 0.0 { across } else { normal };
        Ok(Seen {
            position,
            normal,
            facing: self.view.facing_cosine(position, normal),
        })
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
            let value = self.seen(domain, at(t))?.facing;
            if (value >= 0.0) == (below >= 0.0) {
                (low, below, above) = (t, value, above / 2.0);
            } else {
                (high, above, below) = (t, value, below / 2.0);
            }
        }
        let t = if below.abs() <= above.abs() { low } else { high };
        Ok(self.seen(domain, at(t))?.position)
    }
}

/// Edges between a triangle that faces the eye and one that does not. Edges are the same where their ends have the same bits, as they
/// have on a closed surface.
fn contour_edges(triangles: &[DrawnTriangle], view: &ScreenView) -> Vec<Segment> {
    let mut sides: HashMap<EdgeKey, [bool; 2]> = HashMap::new();
    let mut contour = Vec::new();
    for triangle in triangles {
        let normal = triangle.area_vector();
        if normal == DVec3::ZERO {
            continue;
        }
        let [a, b, c] = triangle.positions();
        let is_front = view.facing(a, normal) >= 0.0;
        for [from, to] in [[a, b], [b, c], [c, a]] {
            let seen = sides.entry(edge_key(from, to).0).or_default();
            let was_contour = seen[0] && seen[1];
            seen[usize::from(is_front)] = true;
            if seen[0] && seen[1] && !was_contour {
                contour.extend(view.pixel(from).zip(view.pixel(to)).map(|(a, b)| [a, b]));
            }
        }
    }
    contour
}
