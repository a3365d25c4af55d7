//! One quantity over the frames of a run.

use crate::statistics::{Interval, median_interval, percentile, sorted};
use serde::{Deserialize, Serialize};

/// A quantity over the frames. Percentiles are by nearest rank ([`percentile`](crate::statistics::percentile)).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// The median.
    pub p50: f64,
    /// 95 % of the frames have no more.
    pub p95: f64,
    /// 99 % of the frames have no more.
    pub p99: f64,
    /// The greatest.
    pub max: f64,
    /// The arithmetic mean.
    pub mean: f64,
    /// Frame by frame; empty where only the summary was kept.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub samples: Vec<f64>,
}

impl Series {
    /// Of all samples; zeros if there are none.
    pub fn new(samples: impl IntoIterator<Item = f64>) -> Self {
        let samples: Vec<f64> = samples.into_iter().collect();
        let ranked = sorted(&samples);
        let at = |q| percentile(&ranked, q).unwrap_or(0.0);
        Self {
            p50: at(0.5),
            p95: at(0.95),
            p99: at(0.99),
            max: at(1.0),
            mean: samples.iter().sum::<f64>() / samples.len().max(1) as f64,
            samples,
        }
    }

    /// Where the median may lie ([`median_interval`]); `None` for fewer than six samples.
    pub fn median_interval(&self) -> Option<Interval> {
        median_interval(&self.samples, crate::statistics::CONFIDENCE)
    }

    /// The sums of two quantities, frame by frame.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        Self::new(self.samples.iter().zip(&other.samples).map(|(a, b)| a + b))
    }

    /// What is wrong with it, if it is of so many frames.
    pub(super) fn problem(&self, frames: usize) -> Option<String> {
        let values = [self.p50, self.p95, self.p99, self.max, self.mean];
        if values.iter().chain(&self.samples).any(|v| !v.is_finite() || *v < 0.0) {
            return Some("holds a value below 0".to_owned());
        }
        if !(self.p50 <= self.p95 && self.p95 <= self.p99 && self.p99 <= self.max) {
            return Some("has percentiles that fall".to_owned());
        }
        let count = self.samples.len();
        (count != 0 && count != frames)
            .then(|| format!("has {count} samples; expected one for each of {frames} frames"))
    }
}
