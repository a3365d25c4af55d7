//! Greatest value and root mean square.

use serde::{Deserialize, Serialize};

/// What is told of an error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Measure {
    /// The greatest of all samples.
    pub max: f64,
    /// The root mean square over the area.
    pub rms: f64,
}

impl Measure {
    /// Both divided by a length.
    #[must_use]
    pub fn over(self, length: f64) -> Self {
        Self {
            max: self.max / length,
            rms: self.rms / length,
        }
    }

    /// The greater of each.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self {
            max: self.max.max(other.max),
            rms: self.rms.max(other.rms),
        }
    }
}

/// A measure while samples come in.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sum {
    max: f64,
    squares: f64,
    weight: f64,
}

impl Sum {
    /// Adds a sample; one of weight 0 counts for the maximum alone.
    pub fn add(&mut self, value: f64, weight: f64) {
        self.max = self.max.max(value);
        self.squares += weight * value * value;
        self.weight += weight;
    }

    /// Adds the samples of another one.
    pub fn join(&mut self, other: &Self) {
        self.max = self.max.max(other.max);
        self.squares += other.squares;
        self.weight += other.weight;
    }

    /// The measure. Of samples without weight, as all triangles may be degenerate, the mean is 0.
    pub fn measure(&self) -> Measure {
        Measure {
            max: self.max,
            rms: if self.weight > 0.0 {
                (self.squares / self.weight).sqrt()
            } else {
                0.0
            },
        }
    }
}
