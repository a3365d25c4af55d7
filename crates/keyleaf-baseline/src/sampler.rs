//! What a tessellator asks of a model of parametric surfaces.

use crate::BaselineError;
use glam::{DVec2, DVec3};

/// A model: parametric surfaces over rectangles, and how their sides meet.
///
/// A surface is a Bézier patch (two knots a direction) or a NURBS surface (all its distinct knots). Its domain runs
/// from the first to the last knot in either direction.
///
/// Sides that are joined trace the same curve at the same *normalised* parameter (0 at the first knot, 1 at the last),
/// or at 1 minus it if they are joined in reverse. The tessellators take the points of a joined side from one of the
/// two surfaces, so that a mismatch within modelling tolerance moves the seam but does not open it. A side all of whose
/// points coincide, such as the pole of a sphere, is found by sampling and becomes one vertex.
pub trait Sampler {
    /// How many surfaces there are. They are counted from 0.
    fn surfaces(&self) -> usize;

    /// The position of a point of a surface. `at` lies in its domain.
    fn point(&self, surface: usize, at: DVec2) -> DVec3;

    /// The distinct knots in u and in v: at least two, increasing.
    fn spans(&self, surface: usize) -> [Vec<f64>; 2];

    /// What lies beyond a side of a surface. Joins are mutual.
    fn boundary(&self, surface: usize, side: Side) -> Boundary;
}

/// One of the four sides of a domain. A side runs in the direction in which its own parameter grows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Side {
    /// u is the first knot; runs along v.
    UMin,
    /// u is the last knot; runs along v.
    UMax,
    /// v is the first knot; runs along u.
    VMin,
    /// v is the last knot; runs along u.
    VMax,
}

impl Side {
    /// All four, in the order of their numbers.
    pub const ALL: [Side; 4] = [Side::UMin, Side::UMax, Side::VMin, Side::VMax];

    /// 0 if the side runs along u, 1 if along v.
    pub(crate) fn runs_along(self) -> usize {
        match self {
            Side::VMin | Side::VMax => 0,
            Side::UMin | Side::UMax => 1,
        }
    }

    /// The point of the unit square at `t` of the side.
    pub(crate) fn at(self, t: f64) -> DVec2 {
        match self {
            Side::UMin => DVec2::new(0.0, t),
            Side::UMax => DVec2::new(1.0, t),
            Side::VMin => DVec2::new(t, 0.0),
            Side::VMax => DVec2::new(t, 1.0),
        }
    }
}

/// What lies beyond a side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Boundary {
    /// Nothing: the surface ends here.
    Free,
    /// A side of a surface, which may be another side of the same one.
    Joined {
        /// The other surface.
        surface: usize,
        /// Its side.
        side: Side,
        /// Whether the two sides run in opposite directions.
        reversed: bool,
    },
}

/// Two sides that are joined, each pair once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Join {
    pub a: (usize, Side),
    pub b: (usize, Side),
    pub reversed: bool,
}

/// The joins of a model, after a check that they are mutual.
pub(crate) fn joins(sampler: &dyn Sampler) -> Result<Vec<Join>, BaselineError> {
    let surfaces = sampler.surfaces();
    if u32::try_from(surfaces).is_err() {
        return Err(BaselineError::TooLarge { what: "surfaces" });
    }
    let mut joins = Vec::new();
    for surface in 0..surfaces {
        for side in Side::ALL {
            let Boundary::Joined {
                surface: other,
                side: other_side,
                reversed,
            } = sampler.boundary(surface, side)
            else {
                continue;
            };
            let back = Boundary::Joined {
                surface,
                side,
                reversed,
            };
            if (other, other_side) == (surface, side)
                || other >= surfaces
                || sampler.boundary(other, other_side) != back
            {
                return Err(BaselineError::Join {
                    surface,
                    side,
                    other,
                    other_side,
                });
            }
            if (surface, side) < (other, other_side) {
                joins.push(Join {
                    a: (surface, side),
                    b: (other, other_side),
                    reversed,
                });
            }
        }
    }
    Ok(joins)
}
