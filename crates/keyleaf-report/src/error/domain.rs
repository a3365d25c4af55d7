//! Parameters in which a point moves over a face.

use super::MeasureError;
use glam::{DVec2, DVec3};
use keyleaf_key::{ONE, RootPoint, Topology};
use keyleaf_surface::{Surface, SurfaceFrame, root_point};

/// A convex piece of parameters: those of a face ([`Surface::face_coord`]), or, for a polygon of more than four corners, of one root.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Domain {
    /// u, v ≥ 0, u + v ≤ 1.
    Triangle { face: u32 },
    /// The unit square.
    Square { face: u32 },
    /// The weights x, y ≥ 0, x + y ≤ 1 of a root.
    Root { face: u32, root: u32 },
}

/// Step of numerical derivatives in a root; faces of more than four corners are flat or nearly so.
const STEP: f64 = 1e-6;

impl Domain {
    pub fn of(topology: &Topology, at: RootPoint) -> Self {
        let RootPoint { face, root, .. } = at;
        match topology.corner_count(face) {
            3 => Self::Triangle { face },
            4 => Self::Square { face },
            _ => Self::Root { face, root },
        }
    }

    /// The parameters of a point of it.
    pub fn parameters(self, at: RootPoint) -> DVec2 {
        let [x, y, z] = [at.x, at.y, at.z()].map(|weight| f64::from(weight) / f64::from(ONE));
        match self {
            Self::Root { .. } => DVec2::new(x, y),
            Self::Triangle { .. } => {
                let mut weights = [z / 3.0; 3];
                weights[at.root as usize % 3] += x;
                weights[(at.root as usize + 1) % 3] += y;
                DVec2::new(weights[1], weights[2])
            }
            Self::Square { .. } => {
                const CORNERS: [DVec2; 4] = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
                let corner = |i: u32| CORNERS[i as usize % 4];
                corner(at.root) * x + corner(at.root + 1) * y + 0.5 * z
            }
        }
    }

    /// The nearest parameters inside, as a point.
    pub fn point(self, surface: &dyn Surface, at: DVec2) -> Result<RootPoint, MeasureError> {
        let DVec2 { x: u, y: v } = self.clamp(at);
        match self {
            Self::Root { face, root } => {
                let fixed = |weight: f64| (weight * f64::from(ONE)).round() as u32;
                let x = fixed(u);
                Ok(RootPoint {
                    face,
                    root,
                    x,
                    y: fixed(v).min(ONE - x),
                })
            }
            Self::Triangle { face } | Self::Square { face } => {
                root_point(surface.topology(), face, u, v).map_err(|error| MeasureError::Parameter(error.to_string()))
            }
        }
    }

    /// The nearest point inside, but of a triangle's corner regions.
    pub fn clamp(self, at: DVec2) -> DVec2 {
        let at = at.clamp(DVec2::ZERO, DVec2::ONE);
        let excess = at.x + at.y - 1.0;
        if matches!(self, Self::Square { .. }) || excess <= 0.0 {
            return at;
        }
        let u = (at.x - excess / 2.0).clamp(0.0, 1.0);
        DVec2::new(u, 1.0 - u)
    }

    /// The part of a step, at most 1, that stays inside.
    pub fn room(self, at: DVec2, step: DVec2) -> f64 {
        let until = |distance: f64, speed: f64| {
            if speed > distance {
                distance.max(0.0) / speed
            } else {
                1.0
            }
        };
        let low = until(at.x, -step.x).min(until(at.y, -step.y));
        if self.is_square() {
            low.min(until(1.0 - at.x, step.x)).min(until(1.0 - at.y, step.y))
        } else {
            low.min(until(1.0 - at.x - at.y, step.x + step.y))
        }
    }

    /// The direction along the boundary that a step from `at` would leave by; `None` if it stays inside at first.
    pub fn wall(self, at: DVec2, step: DVec2) -> Option<DVec2> {
        const NEAR: f64 = 1e-12;
        if (at.x <= NEAR && step.x < 0.0) || (self.is_square() && at.x >= 1.0 - NEAR && step.x > 0.0) {
            return Some(DVec2::Y);
        }
        if (at.y <= NEAR && step.y < 0.0) || (self.is_square() && at.y >= 1.0 - NEAR && step.y > 0.0) {
            return Some(DVec2::X);
        }
        let leaves = !self.is_square() && at.x + at.y >= 1.0 - NEAR && step.x + step.y > 0.0;
        leaves.then_some(DVec2::new(1.0, -1.0))
    }

    /// Whether these points lie on one mesh edge.
    pub fn has_edge(self, ends: [DVec2; 2]) -> bool {
        let all = |is_there: fn(DVec2) -> bool| ends.into_iter().all(is_there);
        match self {
            Self::Square { .. } => {
                all(|p| p.x == 0.0) || all(|p| p.x == 1.0) || all(|p| p.y == 0.0) || all(|p| p.y == 1.0)
            }
            Self::Triangle { .. } => all(|p| p.x == 0.0) || all(|p| p.y == 0.0) || all(|p| p.x + p.y == 1.0),
            Self::Root { .. } => all(|p| p.x + p.y == 1.0),
        }
    }

    fn is_square(self) -> bool {
        matches!(self, Self::Square { .. })
    }

    /// Derivatives by these parameters.
    pub fn derivatives(
        self,
        surface: &dyn Surface,
        evaluate: impl Fn(RootPoint) -> SurfaceFrame,
        at: DVec2,
        frame: &SurfaceFrame,
    ) -> Result<[DVec3; 2], MeasureError> {
        if !matches!(self, Self::Root { .. }) {
            return Ok([frame.du, frame.dv]);
        }
        // Inwards, so that the step stays in the root.
        let along = |axis: DVec2| -> Result<DVec3, MeasureError> {
            let sign = if at.dot(axis) > 0.5 || at.x + at.y + STEP > 1.0 {
                -1.0
            } else {
                1.0
            };
            let there = self.point(surface, at + axis * (sign * STEP))?;
            let moved = (self.parameters(there) - at).dot(axis);
            let difference = evaluate(there).position - frame.position;
            Ok(if moved == 0.0 { DVec3::ZERO } else { difference / moved })
        };
        Ok([along(DVec2::X)?, along(DVec2::Y)?])
    }
}
