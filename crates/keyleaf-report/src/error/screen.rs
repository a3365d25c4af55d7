//! Errors as a picture shows them, in pixels.

use super::measure::Sum;
use super::{Measure, Silhouette};
use glam::{DMat4, DVec2, DVec3, DVec4};
use serde::{Deserialize, Serialize};

/// A camera, as object space sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScreenView {
    clip_from_object: DMat4,
    half_size: DVec2,
    /// What projects to no pixel: the eye (w ≠ 0), or the direction to it (w = 0). Of any sign and length.
    eye: DVec4,
}

/// Errors in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScreenError {
    /// Between where a point of a triangle and the surface's nearest point are seen. Means are over the pixels that triangles cover,
    /// hidden ones too.
    pub shift: Measure,
    /// The distance between the same two points if it were seen from the side.
    pub side_on: Measure,
    /// Samples in the picture.
    pub samples: usize,
    /// Between contours; `None` where triangles or surface have none in the picture. It takes the triangles on both sides of a contour:
    /// those of back faces must be given as well.
    pub silhouette: Option<Silhouette>,
}

impl ScreenView {
    /// A view by `clip_from_object` = clip_from_world · world_from_object, any convention of depth, onto a picture of so many pixels.
    /// The eye follows from the matrix, also for parallel projections.
    pub fn new(clip_from_object: DMat4, size: [u32; 2]) -> Self {
        let [x, y, w] = [0, 1, 3].map(|row| clip_from_object.row(row));
        let without = |column: usize| {
            let rows = [x, y, w].map(|row| {
                let rest: Vec<f64> = (0..4).filter(|i| *i != column).map(|i| row[i]).collect();
                DVec3::new(rest[0], rest[1], rest[2])
            });
            rows[0].dot(rows[1].cross(rows[2]))
        };
        Self {
            clip_from_object,
            half_size: DVec2::new(size[0].into(), size[1].into()) / 2.0,
            eye: DVec4::new(without(0), -without(1), without(2), -without(3)),
        }
    }

    /// Where a point is seen, in pixels from the picture's top left; `None` behind the eye.
    pub fn pixel(&self, p: DVec3) -> Option<DVec2> {
        let clip = self.clip_from_object * p.extend(1.0);
        let ndc = DVec2::new(clip.x, -clip.y) / clip.w;
        (clip.w > 0.0 && ndc.is_finite()).then(|| (ndc + 1.0) * self.half_size)
    }

    /// Whether a pixel lies in the picture.
    pub fn contains(&self, pixel: DVec2) -> bool {
        pixel.cmpge(DVec2::ZERO).all() && pixel.cmple(2.0 * self.half_size).all()
    }

    /// Pixels that a unit of length at a point covers at most, seen from the side: the greatest singular value of the derivative.
    pub fn pixels_per_unit(&self, p: DVec3) -> f64 {
        let clip = self.clip_from_object * p.extend(1.0);
        let [x, y, w] = [0, 1, 3].map(|row| self.clip_from_object.row(row).truncate());
        let row = |axis: DVec3, value: f64, half: f64| (axis - w * (value / clip.w)) * (half / clip.w);
        let (a, b) = (row(x, clip.x, self.half_size.x), row(y, clip.y, self.half_size.y));
        let (aa, ab, bb) = (a.length_squared(), a.dot(b), b.length_squared());
        ((aa + bb) / 2.0 + ((aa - bb) / 2.0).hypot(ab)).sqrt()
    }

    /// Pixels that a triangle covers, whichever side is seen; 0 if a corner is behind the eye.
    pub(super) fn area(&self, corners: [DVec3; 3]) -> f64 {
        match corners.map(|corner| self.pixel(corner)) {
            [Some(a), Some(b), Some(c)] => (b - a).perp_dot(c - a).abs() / 2.0,
            _ => 0.0,
        }
    }

    /// Changes its sign where a surface with this normal turns from front to back.
    pub(super) fn facing(&self, p: DVec3, normal: DVec3) -> f64 {
        normal.dot(self.eye.truncate() - p * self.eye.w)
    }

    /// The same for a unit normal, over the length of the way to the eye; 0 where rounding decides the sign.
    pub(super) fn facing_cosine(&self, p: DVec3, normal: DVec3) -> f64 {
        const ROUNDING: f64 = 1e-12;
        let cosine = self.facing(p, normal) / (self.eye.truncate() - p * self.eye.w).length();
        if cosine.abs() > ROUNDING { cosine } else { 0.0 }
    }
}

/// Errors while samples come in.
#[derive(Default)]
pub(super) struct ScreenSums {
    shift: Sum,
    side_on: Sum,
    samples: usize,
}

impl ScreenSums {
    /// Adds a point of a triangle and the nearest one of the surface, if they are in the picture.
    pub fn add(&mut self, view: &ScreenView, drawn: DVec3, foot: DVec3, weight: f64) {
        let (Some(here), Some(there)) = (view.pixel(drawn), view.pixel(foot)) else {
            return;
        };
        if view.contains(here) {
            self.shift.add(here.distance(there), weight);
            self.side_on
                .add(drawn.distance(foot) * view.pixels_per_unit(foot), weight);
            self.samples += 1;
        }
    }

    pub fn join(&mut self, other: &Self) {
        self.shift.join(&other.shift);
        self.side_on.join(&other.side_on);
        self.samples += other.samples;
    }

    /// The error; `None` if nothing is in the picture.
    pub fn error(&self, silhouette: Option<Silhouette>) -> Option<ScreenError> {
        (self.samples > 0).then(|| ScreenError {
            shift: self.shift.measure(),
            side_on: self.side_on.measure(),
            samples: self.samples,
            silhouette,
        })
    }
}
