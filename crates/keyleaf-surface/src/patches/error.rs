//! Why a patch model could not be made.

use crate::SettingError;
use keyleaf_key::TopologyError;

/// Why numbers are no Bézier or NURBS surface, or surfaces no model. Everything is counted from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PatchError {
    /// A degree is not supported.
    #[error("the degree in {direction} is {degree}; expected 1 to 7")]
    Degree {
        /// "u" or "v".
        direction: &'static str,
        /// The degree.
        degree: u32,
    },
    /// A knot vector is too short for its degree.
    #[error("there are {found} knots in {direction}; degree {degree} needs at least {}", 2 * degree + 2)]
    KnotCount {
        /// "u" or "v".
        direction: &'static str,
        /// The degree.
        degree: u32,
        /// Knots that were given.
        found: usize,
    },
    /// A knot is NaN, infinite or too large.
    #[error("knot {index} in {direction} is {value}; expected a finite number of at most 1e15")]
    Knot {
        /// "u" or "v".
        direction: &'static str,
        /// The knot.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// A knot is less than the one before.
    #[error("knot {index} in {direction} is {value}, less than the knot before it, {before}")]
    KnotDecreases {
        /// "u" or "v".
        direction: &'static str,
        /// The knot.
        index: usize,
        /// Its value.
        value: f64,
        /// The knot before.
        before: f64,
    },
    /// A knot inside the domain is repeated too often.
    #[error(
        "the knot {value} in {direction}, first at {index}, is there {found} times; inside the domain at most degree + 1 = {most} are possible"
    )]
    Multiplicity {
        /// "u" or "v".
        direction: &'static str,
        /// The first of the equal knots.
        index: usize,
        /// Their value.
        value: f64,
        /// How many there are.
        found: usize,
        /// How many there may be.
        most: usize,
    },
    /// The first and last knot of the domain, at `degree` from both ends, are equal.
    #[error("the domain in {direction} is empty: knots {} and {} are both {at}", indices[0], indices[1])]
    EmptyDomain {
        /// "u" or "v".
        direction: &'static str,
        /// The knots at both ends of the domain.
        indices: [usize; 2],
        /// Their value.
        at: f64,
    },
    /// Two knots differ by so little that the ratio of spans overflows f32.
    #[error("knots {index} and {} in {direction} differ by only {length:e}; make them equal", index + 1)]
    ShortSpan {
        /// "u" or "v".
        direction: &'static str,
        /// The first of the two knots.
        index: usize,
        /// Their difference.
        length: f64,
    },
    /// The number of control points is not that which knots and degrees ask for.
    #[error("there are {found} {what}; knots and degrees ask for {} x {}", expected[0], expected[1])]
    PointCount {
        /// "control points" or "weights".
        what: &'static str,
        /// How many were given.
        found: usize,
        /// How many are expected in u and v: knots − degree − 1.
        expected: [usize; 2],
    },
    /// A coordinate is NaN, infinite, or too large for f32 arithmetic.
    #[error("control point {index} is ({x}, {y}, {z}); expected finite coordinates of at most 1e15")]
    Point {
        /// The control point.
        index: usize,
        /// Its position.
        x: f64,
        /// Its position.
        y: f64,
        /// Its position.
        z: f64,
    },
    /// A weight is negative, NaN, infinite or too large.
    #[error("the weight of control point {index} is {value}; expected a number from 0 to 1e15")]
    Weight {
        /// The control point.
        index: usize,
        /// Its weight.
        value: f64,
    },
    /// The control points of a KSQuad weigh nothing, so that it has no points.
    #[error("the control points of spans {} in u and {} in v weigh nothing", spans[0], spans[1])]
    NoWeight {
        /// The spans that are not empty, counted from the start of the domain.
        spans: [usize; 2],
    },
    /// A model without surfaces.
    #[error("the model has no surfaces")]
    Empty,
    /// A surface of a Bézier model has more than one patch.
    #[error("surface {surface} is not one Bézier patch: expected degree + 1 equal knots at both ends and none between")]
    NotBezier {
        /// The surface.
        surface: u32,
    },
    /// The tables have 24 bits for the length of a row and 32 for a control point.
    #[error("surface {surface} has too many control points: at most 2^24 - 1 fit a row, and 2^28 a model")]
    TooManyPoints {
        /// The surface at which the limit is passed.
        surface: u32,
    },
    /// The faces do not make up a surface.
    #[error(transparent)]
    Topology(#[from] TopologyError),
    /// A setting is out of range.
    #[error(transparent)]
    Setting(#[from] SettingError),
}
