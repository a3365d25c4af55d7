//! Why a model could not be tessellated.

use crate::Side;
use glam::DVec2;
use std::fmt;

/// Why a model could not be tessellated. Surfaces are counted from 0.
#[derive(Clone, Debug, PartialEq)]
pub enum BaselineError {
    /// The knots of a surface span no domain.
    Knots {
        /// The surface.
        surface: usize,
        /// 0 for u, 1 for v.
        direction: usize,
    },
    /// A join is not mutual, leads nowhere, or joins a side with itself.
    Join {
        /// The surface that names its neighbour.
        surface: usize,
        /// Its side.
        side: Side,
        /// The neighbour that it names.
        other: usize,
        /// The side of the neighbour.
        other_side: Side,
    },
    /// Joined sides have knots so close together that they cannot be told from rounding.
    CloseKnots {
        /// The surface.
        surface: usize,
        /// Its side.
        side: Side,
    },
    /// A point of a surface is NaN or infinite.
    Point {
        /// The surface.
        surface: usize,
        /// Its parameters.
        at: DVec2,
    },
    /// A setting is out of range.
    Setting {
        /// Its name.
        name: &'static str,
        /// What it is.
        value: f64,
        /// What it may be.
        expected: &'static str,
    },
    /// More than 32-bit indices can count.
    TooLarge {
        /// What there is too much of.
        what: &'static str,
    },
}

impl fmt::Display for BaselineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Knots { surface, direction } => write!(
                f,
                "surface {surface} has no domain in {}; expected at least two finite, increasing knots",
                ["u", "v"][(*direction).min(1)]
            ),
            Self::Join {
                surface,
                side,
                other,
                other_side,
            } => write!(
                f,
                "side {side:?} of surface {surface} is joined to side {other_side:?} of surface {other}, which is the same side, \
                 does not exist, or does not name it in return"
            ),
            Self::CloseKnots { surface, side } => {
                write!(
                    f,
                    "knots along side {side:?} of surface {surface} are too close together; remove one of them"
                )
            }
            Self::Point { surface, at } => {
                write!(f, "surface {surface} has no finite position at ({}, {})", at.x, at.y)
            }
            Self::Setting { name, value, expected } => write!(f, "{name} is {value}; expected {expected}"),
            Self::TooLarge { what } => write!(f, "there are more {what} than 32 bits can count"),
        }
    }
}

impl std::error::Error for BaselineError {}
