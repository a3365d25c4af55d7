//! What joining a model found.

use super::Side;
use glam::DVec3;

/// A side of a surface, or of a piece of it beside a tear. In the surface's own parameters, whether it was transposed or not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Boundary {
    /// The surface, counted from 0.
    pub surface: u32,
    /// Which side.
    pub side: Side,
    /// The knot at which it lies.
    pub at: f64,
}

/// Why a boundary is not joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unjoined {
    /// No other boundary has the same curve with the same knots.
    Free,
    /// No other boundary is the same curve with the same knots, but one lies along it, within a thousandth of the diagonal of the
    /// model's box: there may be a gap to see.
    Apart,
    /// Two other boundaries on the same curve are joined already.
    Crowded,
    /// With this join the surfaces would have only one side, as a Möbius strip has.
    NotOrientable,
}

/// A point into which boundaries collapse.
#[derive(Clone, Debug, PartialEq)]
pub struct Pole {
    /// Where, in object space.
    pub position: DVec3,
    /// The KSQuads with an edge that is this point, ascending.
    pub faces: Vec<u32>,
}

/// How the surfaces of a model were joined. The joined edges have equal bits on the GPU; all others are boundaries.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JoinReport {
    /// Pairs of boundaries that are equal, up to rounding.
    pub exact: u32,
    /// Pairs of boundaries within the tolerance, whose control points were made equal.
    pub snapped: u32,
    /// The farthest that a control point was moved, object units.
    pub largest_move: f64,
    /// Boundaries that are joined to none, in the order of the surfaces.
    pub unjoined: Vec<(Boundary, Unjoined)>,
    /// Points into which boundaries collapse.
    pub poles: Vec<Pole>,
    /// Surfaces whose u and v were exchanged, so that neighbours have the same side up. Ascending.
    pub transposed: Vec<u32>,
}

impl JoinReport {
    /// How many boundaries lie along another that they could not be joined with.
    pub fn gaps(&self) -> usize {
        self.unjoined.iter().filter(|(_, why)| *why != Unjoined::Free).count()
    }
}
