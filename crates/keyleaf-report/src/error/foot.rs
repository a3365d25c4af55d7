//! The nearest point of a surface, from a point near it.

use super::MeasureError;
use super::domain::Domain;
use glam::{DVec2, DVec3};
use keyleaf_key::{ONE, RootPoint};
use keyleaf_surface::{Surface, SurfaceFrame};

/// A point of a surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Foot {
    pub at: RootPoint,
    pub frame: SurfaceFrame,
}

/// Steps on one face; near a surface each gains some digits.
const STEPS: u32 = 12;
/// Faces that a search may enter.
const CROSSINGS: u32 = 4;
/// A part of the squared distance; gains below it end the search.
const GAIN: f64 = 1e-8;

/// A point to which the nearest one is sought.
pub(super) struct Search<'a, F> {
    pub surface: &'a dyn Surface,
    /// [`Surface::frame`] or [`Surface::drawn`].
    pub evaluate: F,
    pub target: DVec3,
}

impl<F: Fn(RootPoint) -> SurfaceFrame> Search<'_, F> {
    fn distance(&self, foot: &Foot) -> f64 {
        foot.frame.position.distance(self.target)
    }

    /// A point of the surface that is at least as near as the start, and, where the surface is not bent more than the distance allows,
    /// the nearest in the neighbourhood of the start.
    pub fn nearest(&self, start: Foot) -> Result<Foot, MeasureError> {
        let mut best = self.on_face(start)?;
        for _ in 0..CROSSINGS {
            let mut better = None;
            for at in self.across(best.at).into_iter().flatten() {
                let frame = (self.evaluate)(at);
                let found = self.on_face(Foot { at, frame })?;
                if self.distance(&found) < self.distance(better.as_ref().unwrap_or(&best)) * (1.0 - GAIN) {
                    better = Some(found);
                }
            }
            match better {
                Some(found) => best = found,
                None => break,
            }
        }
        Ok(best)
    }

    /// The same point on the faces, or roots of a polygon, that meet there: two at a corner, one on an edge.
    fn across(&self, at: RootPoint) -> [Option<RootPoint>; 2] {
        let topology = self.surface.topology();
        let RootPoint { face, root, x, y } = at;
        let corners = topology.corner_count(face);
        let (before, after) = ((root + corners - 1) % corners, (root + 1) % corners);
        let twin = |root, x, y| {
            let twin = topology.twin(face, root)?;
            Some(RootPoint {
                face: twin.face,
                root: twin.root,
                x: y,
                y: x,
            })
        };
        let is_fan = matches!(Domain::of(topology, at), Domain::Root { .. });
        let in_root = |root, x, y| is_fan.then_some(RootPoint { face, root, x, y });
        match (x, y) {
            (ONE, _) => [twin(root, x, y), twin(before, 0, ONE).or(in_root(before, 0, ONE))],
            (_, ONE) => [twin(root, x, y), twin(after, ONE, 0).or(in_root(after, ONE, 0))],
            _ if at.is_on_mesh_edge() => [twin(root, x, y), None],
            (_, 0) => [in_root(before, 0, x), (x == 0).then(|| in_root(after, 0, 0)).flatten()],
            (0, _) => [in_root(after, y, 0), None],
            _ => [None, None],
        }
    }

    fn on_face(&self, start: Foot) -> Result<Foot, MeasureError> {
        let domain = Domain::of(self.surface.topology(), start.at);
        let mut foot = start;
        for _ in 0..STEPS {
            let at = domain.parameters(foot.at);
            let before = self.distance(&foot);
            let (step, gain) = self.step(domain, at, &foot)?;
            if gain <= GAIN * before * before {
                break;
            }
            let mut next = None;
            // As far as the face goes, then ever shorter; last, beyond it and back to the nearest side.
            let room = domain.room(at, step);
            for part in [1.0, 0.5, 0.25, 0.125].map(|part| part * room).into_iter().chain([1.0]) {
                let there = domain.point(self.surface, at + step * part)?;
                let candidate = Foot {
                    at: there,
                    frame: (self.evaluate)(there),
                };
                if self.distance(&candidate) < before {
                    next = Some(candidate);
                    break;
                }
            }
            let Some(next) = next else {
                break;
            };
            foot = next;
        }
        Ok(foot)
    }

    /// The Gauss-Newton step for |S(u, v) − target|², along the boundary where it would lead out, and by how much that square should
    /// fall.
    fn step(&self, domain: Domain, at: DVec2, foot: &Foot) -> Result<(DVec2, f64), MeasureError> {
        let [du, dv] = domain.derivatives(self.surface, &self.evaluate, at, &foot.frame)?;
        let rest = self.target - foot.frame.position;
        let slope = DVec2::new(du.dot(rest), dv.dot(rest));
        let (e, f, g) = (du.length_squared(), du.dot(dv), dv.length_squared());
        // Where derivatives vanish or are parallel, as at poles: a little damping keeps the step finite.
        let damping = 1e-12 * (e + g) + f64::MIN_POSITIVE;
        let (e, g) = (e + damping, g + damping);
        let determinant = e * g - f * f;
        let step = DVec2::new(g * slope.x - f * slope.y, e * slope.y - f * slope.x) / determinant;
        let step = if step.is_finite() { step } else { DVec2::ZERO };
        let step = match domain.wall(at, step) {
            Some(along) => {
                let tangent = du * along.x + dv * along.y;
                along * (tangent.dot(rest) / (tangent.length_squared() + damping))
            }
            None => step,
        };
        Ok((step, slope.dot(step)))
    }
}
