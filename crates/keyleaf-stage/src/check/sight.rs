//! Which vertices and triangles a view surely sees.

use glam::{DAffine3, DQuat, DVec3};
use keyleaf::{Projection, View};

/// A view in the coordinates of emitted vertices.
#[derive(Debug, Clone, Copy)]
pub struct Sight {
    world_from_emitted: DAffine3,
    eye: DVec3,
    view_from_world: DQuat,
    projection: Projection,
    aspect: f64,
}

/// How far inside the view volume a vertex must lie, as a part of its half width: more than single precision can get wrong.
const MARGIN: f64 = 0.01;

/// Sine of the angle between a triangle and a ray above which single precision does not turn the triangle round.
const GRAZING: f64 = 1e-3;

impl Sight {
    /// What `view` sees of vertices relative to `origin` in object space.
    pub fn new(view: &View, world_from_object: &DAffine3, origin: DVec3) -> Self {
        Self {
            world_from_emitted: *world_from_object * DAffine3::from_translation(origin),
            eye: view.eye,
            view_from_world: view.orientation.inverse(),
            projection: view.projection,
            aspect: view.aspect(),
        }
    }

    /// The vertex in world axes, relative to the eye.
    pub fn from_eye(&self, vertex: [f32; 3]) -> DVec3 {
        self.world_from_emitted
            .transform_point3(DVec3::from(vertex.map(f64::from)))
            - self.eye
    }

    /// By how much lengths grow from object to world space, at most.
    pub fn stretch(&self) -> f64 {
        let m = self.world_from_emitted.matrix3;
        [m.x_axis, m.y_axis, m.z_axis]
            .iter()
            .map(|axis| axis.length_squared())
            .sum::<f64>()
            .sqrt()
    }

    /// Whether a triangle, counter-clockwise seen from its front, shows its front to the eye by more than rounding. Its corners are not
    /// asked to be in view.
    pub fn surely_faces(&self, triangle: [[f32; 3]; 3]) -> bool {
        let [a, b, c] = triangle.map(|vertex| self.from_eye(vertex));
        let normal = (b - a).cross(c - a);
        let ray = match self.projection {
            Projection::Perspective { .. } => a,
            Projection::Orthographic { .. } => self.view_from_world.inverse() * DVec3::NEG_Z,
        };
        // Corners are rounded: a triangle must be larger than that to have a side.
        let rounding = f64::from(f32::EPSILON) * self.largest(triangle);
        let is_solid = normal.length() > 64.0 * rounding * ((b - a).length() + (c - a).length());
        is_solid && -normal.dot(ray) > GRAZING * normal.length() * ray.length()
    }

    /// The largest coordinate, of corners before they are placed and after.
    fn largest(&self, triangle: [[f32; 3]; 3]) -> f64 {
        let emitted = triangle
            .into_iter()
            .flatten()
            .fold(0.0, |most: f64, c| most.max(f64::from(c.abs())));
        let placed = triangle.iter().map(|&vertex| self.from_eye(vertex).abs().max_element());
        placed.fold(emitted * self.stretch(), f64::max)
    }

    /// Whether a vertex lies inside the view volume by more than rounding.
    pub fn surely_sees(&self, vertex: [f32; 3]) -> bool {
        let seen = self.view_from_world * self.from_eye(vertex);
        let depth = -seen.z;
        let (half_y, low, high) = match self.projection {
            Projection::Perspective { fov_y, near } => (depth * (fov_y / 2.0).tan(), near, f64::INFINITY),
            Projection::Orthographic { height, near, far } => (height / 2.0, near, far),
        };
        let reach = (1.0 - MARGIN) * half_y;
        let slack = MARGIN * half_y;
        depth > low + slack && depth < high - slack && seen.y.abs() < reach && seen.x.abs() < reach * self.aspect
    }
}
