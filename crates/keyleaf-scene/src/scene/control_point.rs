//! A control point of a scene file: `(x, y, z)`, or `(x, y, z, w)` with its weight.

use std::fmt;

use serde::de::{Error, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A control point of a Bézier or NURBS surface: `(x, y, z)`, or `(x, y, z, w)` for a weight other than 1.
///
/// The position is that of the point itself, not multiplied by the weight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ControlPoint {
    /// Metres, object space.
    pub position: [f64; 3],
    /// At least 0; some of the points of every two spans weigh more.
    pub weight: f64,
}

impl Serialize for ControlPoint {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let [x, y, z] = self.position;
        if self.weight == 1.0 {
            (x, y, z).serialize(serializer)
        } else {
            (x, y, z, self.weight).serialize(serializer)
        }
    }
}

impl<'de> Deserialize<'de> for ControlPoint {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_tuple(4, Numbers)
    }
}

struct Numbers;

impl<'de> Visitor<'de> for Numbers {
    type Value = ControlPoint;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a control point (x, y, z) or (x, y, z, w)")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut numbers: A) -> Result<ControlPoint, A::Error> {
        let mut position = [0.0; 3];
        for (index, coordinate) in position.iter_mut().enumerate() {
            let number = numbers.next_element()?;
            *coordinate = number.ok_or_else(|| Error::invalid_length(index, &self))?;
        }
        let weight = numbers.next_element()?.unwrap_or(1.0);
        Ok(ControlPoint { position, weight })
    }
}
