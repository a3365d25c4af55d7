//! Whether a rendered picture of positions shows the triangles that were emitted: what ties the other checks to the raster path.
//!
//! Of some hundred pixels, spread evenly at random, each that shows a surface must hold a point that lies on an emitted triangle and
//! in that pixel, with no other triangle clearly in front of it; each that shows none must have none behind it. "Clearly": by the
//! rays through the middle and the corners of the pixel alike, so that silhouettes may fall to either side.

use super::{FindingKind, Findings, Sight};
use glam::{DVec2, DVec3, UVec2};
use keyleaf::key::Key;
use keyleaf::{Projection, View};
use rayon::prelude::*;
use std::sync::Arc;

/// Rounding of positions on the GPU, as a part of their distance from the origin of its coordinates.
const ROUNDING: f64 = 1e-6;
/// How far from its pixel's middle a position may be seen, in pixels.
const OFF_CENTRE: f64 = 0.75;

/// A drawn leaf, in world axes relative to the eye.
struct Patch {
    key: Key,
    vertices: Vec<DVec3>,
    /// Whether triangles show from behind.
    is_two_sided: bool,
    indices: Arc<[u16]>,
    centre: DVec3,
    radius: f64,
}

/// The triangles that a picture should show.
pub struct PictureCheck {
    view: View,
    patches: Vec<Patch>,
    rounding: f64,
}

impl PictureCheck {
    /// An empty scene seen by `view`.
    pub fn new(view: &View) -> Self {
        Self {
            view: *view,
            patches: Vec::new(),
            rounding: 0.0,
        }
    }

    /// Adds a drawn leaf: its vertices, and three indices a triangle, which leaves share; `is_two_sided` says whether triangles show
    /// from behind.
    pub fn add(&mut self, key: Key, positions: &[[f32; 3]], indices: &Arc<[u16]>, sight: &Sight, is_two_sided: bool) {
        let vertices: Vec<DVec3> = positions.iter().map(|p| sight.from_eye(*p)).collect();
        let centre = vertices.iter().sum::<DVec3>() / vertices.len().max(1) as f64;
        let radius = vertices.iter().map(|v| v.distance(centre)).fold(0.0, f64::max);
        // What is far from the eye or from the origin is rounded by as much.
        let farthest = positions
            .iter()
            .flatten()
            .fold(0.0, |far: f64, c| far.max(f64::from(c.abs())));
        self.rounding = self.rounding.max(ROUNDING * farthest * sight.stretch());
        self.patches.push(Patch {
            key,
            vertices,
            is_two_sided,
            indices: Arc::clone(indices),
            centre,
            radius,
        });
    }

    /// Compares `samples` pixels of a picture of the channel `position`: four floats a pixel, row by row from the top.
    pub fn check(&self, size: UVec2, pixels: &[[f32; 4]], samples: u32, findings: &mut Findings) {
        let count = u64::from(size.x) * u64::from(size.y);
        // A low-discrepancy sequence: multiples of the golden ratio.
        let chosen: Vec<u64> = (0..u64::from(samples).min(count))
            .map(|i| ((i.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32) * count) >> 32)
            .collect();
        let wrong: Vec<(Option<Key>, String)> = chosen
            .par_iter()
            .filter_map(|&index| {
                let pixel = UVec2::new((index % u64::from(size.x)) as u32, (index / u64::from(size.x)) as u32);
                let problem = self.pixel(pixel, *pixels.get(index as usize)?)?;
                Some((problem.0, format!("pixel ({}, {}) {}", pixel.x, pixel.y, problem.1)))
            })
            .collect();
        for (key, text) in wrong {
            findings.add(FindingKind::Picture, key, || text);
        }
    }

    /// What is wrong with a pixel.
    fn pixel(&self, pixel: UVec2, [x, y, z, is_surface]: [f32; 4]) -> Option<(Option<Key>, String)> {
        let middle = pixel.as_dvec2() + 0.5;
        if is_surface == 0.0 {
            let (key, depth) = self.clear_hit(middle, f64::INFINITY)?;
            return Some((
                Some(key),
                format!("shows nothing, but a triangle is there at depth {depth}"),
            ));
        }
        let shown = DVec3::new(x.into(), y.into(), z.into());
        if !shown.is_finite() {
            return Some((None, format!("holds {shown}")));
        }
        let (at, depth) = self.project(shown);
        let off = (at - middle).abs().max_element();
        let tolerance = self.footprint(depth) + self.rounding;
        if depth <= 0.0 || off * self.footprint(depth) > OFF_CENTRE * self.footprint(depth) + self.rounding {
            return Some((None, format!("holds {shown}, which is seen at {at}")));
        }
        let distance = self.distance(shown, tolerance);
        if distance > tolerance {
            return Some((
                None,
                format!("holds {shown}, which lies on no triangle (within {tolerance})"),
            ));
        }
        let (key, hit) = self.clear_hit(middle, depth - 2.0 * tolerance)?;
        Some((
            Some(key),
            format!("shows depth {depth}, but there is a triangle in front of it at {hit}"),
        ))
    }

    /// World units that a pixel covers at a depth.
    fn footprint(&self, depth: f64) -> f64 {
        match self.view.projection {
            Projection::Perspective { .. } => depth.abs() / self.view.pixels_per_unit(),
            Projection::Orthographic { .. } => 1.0 / self.view.pixels_per_unit(),
        }
    }

    /// Where a point relative to the eye is seen, in pixels from the top left, and its depth.
    fn project(&self, p: DVec3) -> (DVec2, f64) {
        let seen = self.view.orientation.inverse() * p;
        let scale = 1.0 / self.footprint(-seen.z);
        let half = self.view.viewport.as_dvec2() / 2.0;
        (half + DVec2::new(seen.x, -seen.y) * scale, -seen.z)
    }

    /// Start and direction, of unit depth, of the ray through a point of the picture.
    fn ray(&self, at: DVec2) -> (DVec3, DVec3) {
        let offset = (at - self.view.viewport.as_dvec2() / 2.0) / self.view.pixels_per_unit();
        let offset = DVec3::new(offset.x, -offset.y, 0.0);
        let turn = |v| self.view.orientation * v;
        match self.view.projection {
            Projection::Perspective { .. } => (DVec3::ZERO, turn(offset + DVec3::NEG_Z)),
            Projection::Orthographic { .. } => (turn(offset), turn(DVec3::NEG_Z)),
        }
    }

    fn near(&self) -> f64 {
        match self.view.projection {
            Projection::Perspective { near, .. } | Projection::Orthographic { near, .. } => near,
        }
    }

    /// A triangle before `far` that all five rays of a pixel hit: its leaf, and the least depth.
    fn clear_hit(&self, middle: DVec2, far: f64) -> Option<(Key, f64)> {
        const RAYS: [[f64; 2]; 5] = [[0.0, 0.0], [-0.5, -0.5], [0.5, -0.5], [-0.5, 0.5], [0.5, 0.5]];
        let rays = RAYS.map(|offset| self.ray(middle + DVec2::from(offset)));
        let (start, direction) = rays[0];
        let mut hits: [Option<(f64, Key)>; 5] = [None; 5];
        for patch in &self.patches {
            // The corners' rays leave the middle one by less than a pixel.
            let along = (patch.centre - start).dot(direction) / direction.length_squared();
            let off = (start + direction * along).distance(patch.centre);
            if off > patch.radius + 2.0 * self.footprint(along.abs() + patch.radius) {
                continue;
            }
            for triangle in patch.triangles() {
                for (hit, (start, direction)) in hits.iter_mut().zip(rays) {
                    let near = self.near() + 1e-6 * self.near().abs() + self.rounding;
                    if let Some((depth, is_front)) = intersect(start, direction, triangle)
                        && (is_front || patch.is_two_sided)
                        && (near..far).contains(&depth)
                        && hit.is_none_or(|(before, _)| depth < before)
                    {
                        *hit = Some((depth, patch.key));
                    }
                }
            }
        }
        let all: Option<Vec<(f64, Key)>> = hits.into_iter().collect();
        all?.first().map(|(depth, key)| (*key, *depth))
    }

    /// Distance to the nearest triangle; what is farther than `enough` may be reported as infinite.
    fn distance(&self, p: DVec3, enough: f64) -> f64 {
        let near = self
            .patches
            .iter()
            .filter(|patch| patch.centre.distance(p) <= patch.radius + enough);
        let triangles = near.flat_map(Patch::triangles);
        triangles
            .map(|triangle| distance_to_triangle(p, triangle))
            .fold(f64::INFINITY, f64::min)
    }
}

impl Patch {
    fn triangles(&self) -> impl Iterator<Item = [DVec3; 3]> + '_ {
        let vertex = |i: u16| self.vertices.get(usize::from(i)).copied().unwrap_or(DVec3::NAN);
        self.indices.as_chunks::<3>().0.iter().map(move |t| t.map(vertex))
    }
}

/// Where a ray meets a triangle, in lengths of its direction, and whether from the front (Möller and Trumbore 1997).
fn intersect(start: DVec3, direction: DVec3, [a, b, c]: [DVec3; 3]) -> Option<(f64, bool)> {
    let (ab, ac) = (b - a, c - a);
    let p = direction.cross(ac);
    let determinant = ab.dot(p);
    let to_start = start - a;
    let u = to_start.dot(p) / determinant;
    let q = to_start.cross(ab);
    let v = direction.dot(q) / determinant;
    // NaN, of a degenerate triangle, fails all of these.
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then_some((ac.dot(q) / determinant, determinant > 0.0))
}

/// Ericson, *Real-Time Collision Detection*, 5.1.5.
fn distance_to_triangle(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let (ab, ac, bc) = (b - a, c - a, c - b);
    let segment = |from: DVec3, along: DVec3| {
        let t = ((p - from).dot(along) / along.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        p.distance(from + along * t)
    };
    let normal = ab.cross(ac);
    let inside = ab.cross(normal).dot(p - a) <= 0.0
        && bc.cross(normal).dot(p - b) <= 0.0
        && (-ac).cross(normal).dot(p - c) <= 0.0;
    if inside && normal != DVec3::ZERO {
        return normal.normalize().dot(p - a).abs();
    }
    segment(a, ab).min(segment(a, ac)).min(segment(b, bc))
}
