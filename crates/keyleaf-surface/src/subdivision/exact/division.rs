//! How the cells of a scheme are divided, and what they are where nothing irregular is left.

use super::super::bspline::{self, Jet};
use super::super::cell::{SquarePoint, TrianglePoint};
use super::super::loop_scheme::{self, Part};
use super::super::refinement::Child;
use super::super::ring::Ring;
use super::super::stencil::{Stencil, Vector};
use super::super::{Creasing, box_spline, catmull_clark};
use crate::{LoopWeights, SubdivisionScheme};
use glam::DVec3;

/// Cells that have four children.
pub trait Division {
    /// A point of a cell.
    type Point: Copy;

    fn scheme(&self) -> SubdivisionScheme;

    fn child(&self, ring: &Ring, child: usize) -> Child;

    /// Where the cell is a spline, its control points.
    fn control_points(ring: &Ring) -> Option<Vec<Stencil>>;

    fn evaluate<V: Vector>(points: &[V], at: Self::Point) -> Jet<V>;

    /// The corner where the point lies.
    fn corner(at: Self::Point) -> Option<usize>;

    /// The child with the point, the point in it, and the rate of its parameters by those of the cell.
    fn descend(at: Self::Point) -> (usize, Self::Point, f64);

    /// By the parameters of the cell, from the tangents of a corner towards the next and the previous one.
    fn derivatives(corner: usize, tangents: [DVec3; 2]) -> [DVec3; 2];
}

/// Quads of Catmull-Clark surfaces; child k is the one at corner k.
pub struct Squares(pub Creasing);

impl Division for Squares {
    type Point = SquarePoint;

    fn scheme(&self) -> SubdivisionScheme {
        SubdivisionScheme::CatmullClark
    }

    fn child(&self, ring: &Ring, child: usize) -> Child {
        catmull_clark::child(ring, child, self.0)
    }

    fn control_points(ring: &Ring) -> Option<Vec<Stencil>> {
        bspline::control_points(ring).map(|rows| rows.into_iter().flatten().collect())
    }

    fn evaluate<V: Vector>(points: &[V], at: SquarePoint) -> Jet<V> {
        let rows = std::array::from_fn(|j| std::array::from_fn(|i| points[4 * j + i]));
        let [u, v] = at.to_f64();
        bspline::evaluate(&rows, u, v)
    }

    fn corner(at: SquarePoint) -> Option<usize> {
        at.corner()
    }

    fn descend(at: SquarePoint) -> (usize, SquarePoint, f64) {
        let (corner, inner) = at.descend();
        (corner, inner, 2.0)
    }

    fn derivatives(corner: usize, [next, previous]: [DVec3; 2]) -> [DVec3; 2] {
        match corner {
            0 => [next, previous],
            1 => [-previous, next],
            2 => [-next, -previous],
            _ => [previous, -next],
        }
    }
}

/// Triangles of Loop surfaces; child k < 3 is the one at corner k, child 3 the one in the middle.
pub struct Triangles(pub LoopWeights, pub Creasing);

impl Division for Triangles {
    type Point = TrianglePoint;

    fn scheme(&self) -> SubdivisionScheme {
        SubdivisionScheme::Loop(self.0)
    }

    fn child(&self, ring: &Ring, child: usize) -> Child {
        let part = if child < 3 { Part::Corner(child) } else { Part::Middle };
        loop_scheme::child(ring, part, self.0, self.1)
    }

    fn control_points(ring: &Ring) -> Option<Vec<Stencil>> {
        box_spline::control_points(ring).map(Vec::from)
    }

    fn evaluate<V: Vector>(points: &[V], at: TrianglePoint) -> Jet<V> {
        box_spline::evaluate(&std::array::from_fn(|k| points[k]), at.to_f64())
    }

    fn corner(at: TrianglePoint) -> Option<usize> {
        at.corner()
    }

    fn descend(at: TrianglePoint) -> (usize, TrianglePoint, f64) {
        match at.descend() {
            (Part::Corner(corner), inner) => (corner, inner, 2.0),
            (Part::Middle, inner) => (3, inner, -2.0),
        }
    }

    fn derivatives(corner: usize, [next, previous]: [DVec3; 2]) -> [DVec3; 2] {
        match corner {
            0 => [next, previous],
            1 => [-previous, next - previous],
            _ => [previous - next, -next],
        }
    }
}
