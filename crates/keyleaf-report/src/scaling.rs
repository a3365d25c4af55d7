//! Scaling on paper: from what a leaf costs here to frame time and memory for other sizes on other devices.
//!
//! The model is a line with two terms, as the update is bound by memory: every leaf moves the same bytes in a frame, and every pass has
//! a start that no size avoids:
//!
//! time = passes · start + leaves · bytes moved a leaf / (bandwidth · efficiency)
//!
//! It leaves out what is not proportional to leaves: pixels, the surface's evaluation where that is dear, and caches, which make sizes
//! that fit them faster than the line.

use crate::slope::{Slope, power_law};
use crate::table::bytes;
use serde::{Deserialize, Serialize};

/// A class of devices.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DeviceClass {
    /// What it is, with an example.
    pub name: String,
    /// Peak bandwidth of its memory, 10⁹ bytes a second.
    pub gigabytes_per_second: f64,
    /// Where that figure comes from.
    pub source: String,
}

/// What the prediction starts from.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CostModel {
    /// Bytes that a leaf moves in a frame, reads and writes of update and draw together.
    pub moved_per_leaf: f64,
    /// Bytes that a leaf occupies.
    pub kept_per_leaf: f64,
    /// Bytes that are there without leaves: surface tables, textures.
    pub kept_fixed: f64,
    /// Dispatches and draws a frame.
    pub passes: f64,
    /// Microseconds that each of them takes to start, barriers included.
    pub start_us: f64,
    /// The part of the peak bandwidth that is reached.
    pub efficiency: f64,
}

/// A size on a device.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Prediction {
    /// Leaves.
    pub leaves: f64,
    /// Milliseconds a frame.
    pub ms: f64,
    /// Bytes of memory.
    pub bytes: f64,
}

/// A measured size beside what is predicted of it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Check {
    /// Leaves.
    pub leaves: f64,
    /// Milliseconds that were measured.
    pub measured_ms: f64,
    /// Milliseconds of the line through the measured sizes but the largest, over the measured: whether time is a line.
    pub line_ratio: Option<f64>,
    /// Milliseconds of the model over the measured: whether the assumptions hold. Only where the device's bandwidth is known.
    pub model_ratio: Option<f64>,
}

/// The whole table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scaling {
    /// What was assumed, a sentence each.
    pub assumptions: Vec<String>,
    /// A row a device: predictions for [`SIZES`].
    pub devices: Vec<(DeviceClass, Vec<Prediction>)>,
    /// Measured sizes against predictions.
    pub checks: Vec<Check>,
    /// How measured time grows with leaves; an exponent of 1 is what the model assumes.
    pub growth: Option<Slope>,
}

/// Leaves that are predicted.
pub const SIZES: [f64; 4] = [1e5, 1e6, 1e7, 1e8];

/// Classes of devices with their peak bandwidth, by the makers' figures.
pub fn device_classes() -> Vec<DeviceClass> {
    const CLASSES: [(&str, f64, &str); 7] = [
        (
            "phone, LPDDR5X (Snapdragon 8 Gen 3)",
            76.8,
            "64 bit x 4800 MHz, Qualcomm's product brief",
        ),
        ("handheld, LPDDR5 (Steam Deck)", 88.0, "Valve: 128 bit x 5500 MT/s"),
        (
            "laptop, unified memory (Apple M3)",
            102.4,
            "Apple: 100 GB/s, 128 bit x 6400 MT/s",
        ),
        (
            "laptop or desktop GPU (GeForce RTX 3060, 12 GB)",
            360.0,
            "NVIDIA: 192 bit x 15 Gbit/s",
        ),
        ("desktop GPU (Radeon RX 7900 XTX)", 960.0, "AMD: 384 bit x 20 Gbit/s"),
        ("desktop GPU (GeForce RTX 4090)", 1008.0, "NVIDIA: 384 bit x 21 Gbit/s"),
        ("server GPU (H200)", 4800.0, "NVIDIA: 4.8 TB/s, HBM3e"),
    ];
    let class = |(name, gigabytes_per_second, source): (&str, f64, &str)| DeviceClass {
        name: name.to_owned(),
        gigabytes_per_second,
        source: source.to_owned(),
    };
    CLASSES.map(class).into()
}

impl CostModel {
    /// Milliseconds and bytes for a number of leaves on a device.
    pub fn predict(&self, leaves: f64, device: &DeviceClass) -> Prediction {
        let bytes_per_ms = device.gigabytes_per_second * 1e6 * self.efficiency;
        Prediction {
            leaves,
            ms: self.passes * self.start_us * 1e-3 + leaves * self.moved_per_leaf / bytes_per_ms,
            bytes: self.kept_fixed + leaves * self.kept_per_leaf,
        }
    }

    /// The efficiency that a measured cost a leaf means on a device of known bandwidth, at most 1: use it instead of an assumption.
    pub fn measured_efficiency(&self, us_per_leaf: f64, gigabytes_per_second: f64) -> f64 {
        (self.moved_per_leaf / (us_per_leaf * 1e-6) / (gigabytes_per_second * 1e9)).clamp(0.0, 1.0)
    }

    fn assumptions(&self) -> Vec<String> {
        vec![
            format!(
                "a leaf moves {:.0} bytes a frame and keeps {:.0}",
                self.moved_per_leaf, self.kept_per_leaf
            ),
            format!("{} are there without leaves", bytes(self.kept_fixed)),
            format!("{:.0} passes start in {} µs each", self.passes, self.start_us),
            format!("{:.0} % of the peak bandwidth are reached", 100.0 * self.efficiency),
            "time is proportional to bytes: no caches, no cost of pixels, no dear surfaces".to_owned(),
        ]
    }
}

/// The table for some devices, checked against measured (leaves, milliseconds) of the device at hand; `at_hand` is its class, if its
/// bandwidth is known.
///
/// A line is fitted to all measured sizes but the largest, if there are three at least, so that the largest tests an extrapolation.
pub fn scaling(
    model: &CostModel,
    devices: &[DeviceClass],
    measured: &[(f64, f64)],
    at_hand: Option<&DeviceClass>,
) -> Scaling {
    let row = |device: &DeviceClass| {
        let predictions = SIZES.map(|leaves| model.predict(leaves, device));
        (device.clone(), predictions.into())
    };
    let is_measured = |point: &(f64, f64)| point.0 > 0.0 && point.1 > 0.0;
    let mut sizes: Vec<(f64, f64)> = measured.iter().copied().filter(is_measured).collect();
    sizes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let fitted = if sizes.len() > 2 { sizes.len() - 1 } else { sizes.len() };
    let line = fit_line(&sizes[..fitted]);
    let check = |&(leaves, measured_ms): &(f64, f64)| Check {
        leaves,
        measured_ms,
        line_ratio: line.map(|(start, per_leaf)| (start + per_leaf * leaves) / measured_ms),
        model_ratio: at_hand.map(|device| model.predict(leaves, device).ms / measured_ms),
    };
    Scaling {
        assumptions: model.assumptions(),
        devices: devices.iter().map(row).collect(),
        checks: sizes.iter().map(check).collect(),
        growth: power_law(&sizes),
    }
}

/// Start and cost a leaf, neither below 0, by least squares of relative errors. `None` for fewer than two sizes.
pub fn fit_line(measured: &[(f64, f64)]) -> Option<(f64, f64)> {
    // Divided by the measured time: a / y + b x / y ≈ 1.
    let points = measured
        .iter()
        .filter(|(x, y)| *x > 0.0 && *y > 0.0 && x.is_finite() && y.is_finite());
    let rows: Vec<(f64, f64)> = points.map(|(x, y)| (1.0 / y, x / y)).collect();
    let sum = |f: fn(&(f64, f64)) -> f64| rows.iter().map(f).sum::<f64>();
    let (pp, pq, qq) = (sum(|r| r.0 * r.0), sum(|r| r.0 * r.1), sum(|r| r.1 * r.1));
    let (p, q) = (sum(|r| r.0), sum(|r| r.1));
    let determinant = pp * qq - pq * pq;
    if rows.len() < 2 || determinant <= 1e-12 * pp * qq {
        return None;
    }
    let (start, per_leaf) = ((p * qq - q * pq) / determinant, (q * pp - p * pq) / determinant);
    Some(match (start < 0.0, per_leaf < 0.0) {
        (true, _) => (0.0, q / qq),
        (_, true) => (p / pp, 0.0),
        _ => (start, per_leaf),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const MODEL: CostModel = CostModel {
        moved_per_leaf: 100.0,
        kept_per_leaf: 120.0,
        kept_fixed: 1e6,
        passes: 12.0,
        start_us: 5.0,
        efficiency: 0.5,
    };

    #[test]
    fn time_and_memory_are_the_lines_of_the_model() {
        let device = DeviceClass {
            name: String::new(),
            gigabytes_per_second: 100.0,
            source: String::new(),
        };
        let million = MODEL.predict(1e6, &device);
        assert!((million.ms - (0.06 + 2.0)).abs() < 1e-12);
        assert_eq!(million.bytes, 121e6);
        assert!((MODEL.measured_efficiency(0.002, 100.0) - 0.5).abs() < 1e-12);
        assert_eq!(MODEL.measured_efficiency(1e-9, 100.0), 1.0);
    }

    #[test]
    fn what_follows_the_model_is_predicted_and_what_does_not_shows() {
        let sizes = [1e3, 1e4, 1e5, 1e6];
        let device = &device_classes()[0];
        let exact = sizes.map(|leaves| (leaves, model_time(leaves, device)));
        let table = scaling(&MODEL, &device_classes(), &exact, Some(device));
        let is_one = |ratio: Option<f64>| (ratio.unwrap() - 1.0).abs() < 1e-9;
        assert!(
            table
                .checks
                .iter()
                .all(|check| is_one(check.line_ratio) && is_one(check.model_ratio)),
            "{table:?}"
        );
        assert_eq!(table.devices.len(), device_classes().len());
        let quadratic = sizes.map(|leaves| (leaves, 1e-9 * leaves * leaves));
        let table = scaling(&MODEL, &device_classes(), &quadratic, None);
        assert!((table.growth.unwrap().exponent - 2.0).abs() < 1e-9);
        // The line through the smaller sizes does not reach the largest.
        assert!(table.checks[3].line_ratio.unwrap() < 0.2 && table.checks[3].model_ratio.is_none());
        assert_eq!(scaling(&MODEL, &[], &exact[..1], None).checks[0].line_ratio, None);
    }

    fn model_time(leaves: f64, device: &DeviceClass) -> f64 {
        MODEL.predict(leaves, device).ms
    }
}
