//! Where a point of a face is: in a domain of the face, in cells of the quadtree, exactly.

use super::loop_scheme::Part;
use crate::quad_coord::{QuadCoord, UNIT};
use keyleaf_key::{ONE, RootPoint};

/// What barycentric coordinates add up to: 3 · 2³¹.
pub const WHOLE: u64 = 3 * ONE as u64;

/// A point of the unit square, in units of 2⁻³².
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SquarePoint {
    pub u: u64,
    pub v: u64,
}

impl SquarePoint {
    /// The corner at which the child with the point lies, and the point in the child.
    pub fn descend(self) -> (usize, Self) {
        let half = |x: u64| if 2 * x >= UNIT { (1, 2 * x - UNIT) } else { (0, 2 * x) };
        let ((right, u), (up, v)) = (half(self.u), half(self.v));
        let corner = [[0, 1], [3, 2]][up][right];
        (corner, Self { u, v })
    }

    /// The corner where the point lies.
    pub fn corner(self) -> Option<usize> {
        match (self.u, self.v) {
            (0, 0) => Some(0),
            (UNIT, 0) => Some(1),
            (UNIT, UNIT) => Some(2),
            (0, UNIT) => Some(3),
            _ => None,
        }
    }

    pub fn to_f64(self) -> [f64; 2] {
        [self.u, self.v].map(|x| x as f64 / UNIT as f64)
    }
}

/// A point of a triangle by barycentric coordinates, in units of 1/[`WHOLE`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TrianglePoint(pub [u64; 3]);

impl TrianglePoint {
    /// Of a point of a root of a triangle, whose centre has a third of every corner.
    pub fn of(at: RootPoint) -> Self {
        let mut weights = [u64::from(at.z()); 3];
        weights[at.root as usize % 3] += 3 * u64::from(at.x);
        weights[(at.root as usize + 1) % 3] += 3 * u64::from(at.y);
        Self(weights)
    }

    /// The child with the point, and the point in it.
    pub fn descend(self) -> (Part, Self) {
        let doubled = self.0.map(|weight| 2 * weight);
        match doubled.iter().position(|&weight| weight >= WHOLE) {
            Some(corner) => {
                let mut weights = doubled;
                weights[corner] -= WHOLE;
                (Part::Corner(corner), Self(weights))
            }
            None => (Part::Middle, Self(doubled.map(|weight| WHOLE - weight))),
        }
    }

    /// The corner where the point lies.
    pub fn corner(self) -> Option<usize> {
        self.0.iter().position(|&weight| weight == WHOLE)
    }

    pub fn to_f64(self) -> [f64; 3] {
        self.0.map(|weight| weight as f64 / WHOLE as f64)
    }
}

/// A point in a domain of a face of a Catmull-Clark surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DomainPoint {
    /// 0 for quads.
    pub domain: usize,
    /// The point.
    pub at: SquarePoint,
    /// The domain's parameters by the face's (see [`Surface::face_coord`](crate::Surface::face_coord)): ds/du, ds/dv, dt/du, dt/dv.
    pub rates: [[f64; 2]; 2],
}

impl DomainPoint {
    /// Quads are one domain. Of other faces domain r is the quad at corner r.
    pub fn of(at: RootPoint, corners: u32) -> Self {
        if corners == 4 {
            let QuadCoord { u, v } = QuadCoord::of(at);
            return Self {
                domain: 0,
                at: SquarePoint { u, v },
                rates: [[1.0, 0.0], [0.0, 1.0]],
            };
        }
        let is_first = at.x >= at.y;
        // At the centre the parameters of the roots differ; there it is domain 0.
        let root = if at.x == 0 && at.y == 0 { 0 } else { at.root };
        let along = u64::from(at.x.abs_diff(at.y));
        let sum = u64::from(at.x) + u64::from(at.y);
        let [near, far] = [along, sum].map(|x| UNIT - 2 * x);
        // x and y by the face's parameters, then the domain's by x and y.
        let [x, y] = root_rates(at, corners);
        let minus = [-x[0] + y[0], -x[1] + y[1]];
        let plus = [-x[0] - y[0], -x[1] - y[1]];
        if is_first {
            Self {
                domain: root as usize,
                at: SquarePoint { u: near, v: far },
                rates: [minus, plus],
            }
        } else {
            Self {
                domain: (root as usize + 1) % corners as usize,
                at: SquarePoint { u: far, v: near },
                rates: [plus, [x[0] - y[0], x[1] - y[1]]],
            }
        }
    }
}

/// dx/du, dx/dv, dy/du, dy/dv of the weights of a root of a triangle or a fan.
fn root_rates(at: RootPoint, corners: u32) -> [[f64; 2]; 2] {
    let [x, y] = [at.x, at.y].map(|weight| f64::from(weight) / f64::from(ONE));
    if corners == 3 {
        let corner: [[f64; 2]; 3] = [[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]];
        let of = |k: u32| corner[k as usize % 3];
        let opposite = of(at.root + 2);
        return [of(at.root), of(at.root + 1)].map(|own| [own[0] - opposite[0], own[1] - opposite[1]]);
    }
    let rim = x + y;
    let along = if rim > 0.0 { y / rim } else { 0.5 };
    [[-rim, along - 1.0], [rim, -along]]
}
