//! Control points of clamped boundaries that are made equal.

use super::classes::Classes;
use super::nurbs_surface::NurbsSurface;
use glam::DVec3;

/// Classes of control points, each by surface and index.
pub struct Welds {
    /// The number of the first control point of every surface.
    first: Vec<usize>,
    classes: Classes,
}

impl Welds {
    pub fn new(surfaces: &[NurbsSurface]) -> Self {
        let mut count = 0;
        let next = |surface: &NurbsSurface| {
            let first = count;
            count += surface.points().len();
            first
        };
        let first = surfaces.iter().map(next).collect();
        Self {
            first,
            classes: Classes::new(count),
        }
    }

    /// Puts two control points into one class.
    pub fn unite(&mut self, a: (usize, usize), b: (usize, usize)) {
        let [a, b] = [a, b].map(|(surface, index)| self.first[surface] + index);
        self.classes.unite(a, b);
    }

    /// Moves all members of a class to its first. The farthest that one was moved.
    pub fn apply(mut self, surfaces: &mut [NurbsSurface]) -> f64 {
        let mut positions: Vec<DVec3> = surfaces.iter().flat_map(|surface| surface.points()).copied().collect();
        let mut largest_move: f64 = 0.0;
        for place in 0..positions.len() {
            let target = positions[self.classes.first(place)];
            largest_move = largest_move.max(target.distance(positions[place]));
            positions[place] = target;
        }
        for (surface, &first) in surfaces.iter_mut().zip(&self.first) {
            for index in 0..surface.points().len() {
                surface.set_point(index, positions[first + index]);
            }
        }
        largest_move
    }
}
