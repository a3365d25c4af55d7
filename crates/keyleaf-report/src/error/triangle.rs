//! Triangles as they are drawn.

use super::MeasureError;
use super::domain::Domain;
use glam::DVec3;
use keyleaf_key::{ONE, RootPoint, Topology};

/// A vertex of a drawn triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawnVertex {
    /// Face and parameters.
    pub at: RootPoint,
    /// Object-space position. For what a GPU drew: its f32 position plus the origin of its coordinates.
    pub position: DVec3,
    /// Normal that shading interpolates; any length but 0.
    pub normal: DVec3,
}

/// A drawn triangle: its corners lie on one face, counter-clockwise as seen from outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawnTriangle {
    /// The corners.
    pub corners: [DrawnVertex; 3],
}

impl DrawnTriangle {
    /// Positions of the corners.
    pub fn positions(&self) -> [DVec3; 3] {
        self.corners.map(|corner| corner.position)
    }

    /// Twice the area, in the direction of the outside.
    pub fn area_vector(&self) -> DVec3 {
        let [a, b, c] = self.positions();
        (b - a).cross(c - a)
    }

    /// The longest edge.
    pub fn longest_edge(&self) -> f64 {
        let [a, b, c] = self.positions();
        a.distance(b).max(b.distance(c)).max(c.distance(a))
    }

    /// Position and normal at barycentric weights.
    pub(super) fn at(&self, weights: [f64; 3]) -> (DVec3, DVec3) {
        let [a, b, c] = &self.corners;
        let mix = |a: DVec3, b: DVec3, c: DVec3| a * weights[0] + b * weights[1] + c * weights[2];
        (
            mix(a.position, b.position, c.position),
            mix(a.normal, b.normal, c.normal),
        )
    }

    /// The domain that it lies in, and its corners there.
    pub(super) fn domain(&self, triangle: usize, topology: &Topology) -> Result<Domain, MeasureError> {
        for corner in &self.corners {
            let RootPoint { face, root, x, y } = corner.at;
            if face >= topology.face_count() || !topology.has_root(face, root) || x > ONE || y > ONE - x {
                return Err(MeasureError::Outside { triangle, face, root });
            }
            if !corner.position.is_finite() || !corner.normal.is_finite() {
                return Err(MeasureError::NotFinite { triangle });
            }
        }
        let domain = Domain::of(topology, self.corners[0].at);
        let is_shared = self
            .corners
            .iter()
            .all(|corner| Domain::of(topology, corner.at) == domain);
        is_shared
            .then_some(domain)
            .ok_or(MeasureError::AcrossFaces { triangle })
    }
}
