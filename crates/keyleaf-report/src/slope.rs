//! How fast one quantity falls or grows with another, on logarithmic axes.

use serde::{Deserialize, Serialize};

/// y = `factor` · x^`exponent`, by least squares of the logarithms.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Slope {
    /// The power of x.
    pub exponent: f64,
    /// y at x = 1.
    pub factor: f64,
    /// Where the curve ends to fall: y below which rounding, not x, decides. `None` if it falls to the end.
    pub floor: Option<f64>,
    /// Points that the fit is of.
    pub points: usize,
    /// The root mean square of the logarithms (base 10) that the fit leaves.
    pub residual: f64,
}

impl Slope {
    /// The fitted y, without the floor.
    pub fn at(&self, x: f64) -> f64 {
        self.factor * x.powf(self.exponent)
    }
}

/// Points nearer than this factor to the floor say little of the power, and are left out of its fit.
const ABOVE_FLOOR: f64 = 2.0;
/// Floors that are tried, from a hundredth of the least value to four times it.
const FLOORS: i32 = 160;
/// A floor is believed if it leaves less than this part of what the fit without one leaves.
const BELIEVED: f64 = 0.5;
/// What a fit may leave without a floor being looked for: 1 %.
const GOOD: f64 = 0.004;

/// The power law of points, all of them. `None` for fewer than two different x; points that are not above 0 do not count.
pub fn power_law(points: &[(f64, f64)]) -> Option<Slope> {
    let is_positive = |p: &&(f64, f64)| p.0 > 0.0 && p.1 > 0.0 && p.0.is_finite() && p.1.is_finite();
    let logs: Vec<(f64, f64)> = points
        .iter()
        .filter(is_positive)
        .map(|(x, y)| (x.log10(), y.log10()))
        .collect();
    let count = logs.len() as f64;
    let mean = |value: fn(&(f64, f64)) -> f64| logs.iter().map(value).sum::<f64>() / count;
    let (mean_x, mean_y) = (mean(|p| p.0), mean(|p| p.1));
    let spread: f64 = logs.iter().map(|p| (p.0 - mean_x).powi(2)).sum();
    if logs.len() < 2 || spread < 1e-12 {
        return None;
    }
    let exponent = logs.iter().map(|p| (p.0 - mean_x) * (p.1 - mean_y)).sum::<f64>() / spread;
    let start = mean_y - exponent * mean_x;
    let squares: f64 = logs.iter().map(|p| (p.1 - start - exponent * p.0).powi(2)).sum();
    Some(Slope {
        exponent,
        factor: 10f64.powf(start),
        floor: None,
        points: logs.len(),
        residual: (squares / count).sqrt(),
    })
}

/// The power law of an error that falls as x falls, until rounding holds it up: y = factor · x^exponent + floor.
///
/// Of many floors the one is taken that fits the logarithms of all points best; for each the power is fitted to the points that are
/// above twice the floor, less the floor. Without one that halves what is left of the errors, there is none. `None` for fewer than two
/// points that count.
///
/// ```
/// use keyleaf_report::slope::falling_error;
/// let error = |edge: f64| 0.125 * edge * edge + 1e-7;
/// let points: Vec<(f64, f64)> = (0..16).map(|i| 0.5f64.powi(i)).map(|x| (x, error(x))).collect();
/// let slope = falling_error(&points).unwrap();
/// assert!((slope.exponent - 2.0).abs() < 0.01);
/// assert!((slope.floor.unwrap() / 1e-7 - 1.0).abs() < 0.05);
/// ```
pub fn falling_error(points: &[(f64, f64)]) -> Option<Slope> {
    let is_positive = |p: &(f64, f64)| p.0 > 0.0 && p.1 > 0.0 && p.0.is_finite() && p.1.is_finite();
    let points: Vec<(f64, f64)> = points.iter().copied().filter(is_positive).collect();
    let without = power_law(&points)?;
    if points.len() < 4 || without.residual < GOOD {
        return Some(without);
    }
    let least = points.iter().map(|p| p.1).fold(f64::INFINITY, f64::min);
    let floors = (0..FLOORS).map(|i| least * 10f64.powf(2.6 * f64::from(i) / f64::from(FLOORS - 1) - 2.0));
    let fits = floors.filter_map(|floor| with_floor(&points, floor));
    let best = fits.min_by(|a, b| a.residual.total_cmp(&b.residual));
    let is_believed = |fit: &Slope| fit.residual < BELIEVED * without.residual && fit.exponent > 0.0;
    Some(best.filter(is_believed).unwrap_or(without))
}

/// The fit for one floor; `None` if it leaves too few points to tell a power.
fn with_floor(points: &[(f64, f64)], floor: f64) -> Option<Slope> {
    let above: Vec<(f64, f64)> = points
        .iter()
        .filter(|p| p.1 > ABOVE_FLOOR * floor)
        .map(|p| (p.0, p.1 - floor))
        .collect();
    if above.len() < 3 {
        return None;
    }
    let law = power_law(&above)?;
    let squares: f64 = points
        .iter()
        .map(|p| ((law.at(p.0) + floor) / p.1).log10().powi(2))
        .sum();
    Some(Slope {
        floor: Some(floor),
        residual: (squares / points.len() as f64).sqrt(),
        ..law
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_is_found_exactly() {
        let points: Vec<(f64, f64)> = [1.0, 10.0, 50.0].map(|x: f64| (x, 3.0 * x.powf(1.5))).into();
        let slope = power_law(&points).unwrap();
        assert!((slope.exponent - 1.5).abs() < 1e-12 && (slope.factor - 3.0).abs() < 1e-12);
        assert!(slope.residual < 1e-12 && (slope.at(4.0) - 24.0).abs() < 1e-9);
        assert_eq!(power_law(&[(1.0, 2.0)]), None);
        assert_eq!(power_law(&[(2.0, 2.0), (2.0, 3.0), (f64::NAN, 1.0), (1.0, 0.0)]), None);
    }

    #[test]
    fn without_a_floor_none_is_reported() {
        let points: Vec<(f64, f64)> = (0..8).map(|i| 0.5f64.powi(i)).map(|x| (x, x * x)).collect();
        let slope = falling_error(&points).unwrap();
        assert_eq!((slope.floor, slope.points), (None, 8));
    }

    #[test]
    fn noise_is_no_floor_and_a_noisy_floor_is_found() {
        let noise = |i: i32| 1.0 + 0.2 * ((f64::from(i) * 12.9898).sin() * 43758.5453).rem_euclid(1.0);
        let points = |floor: f64| -> Vec<(f64, f64)> {
            let point = |i: i32| (0.5f64.powi(i), (0.25f64.powi(i) + floor) * noise(i));
            (0..12).map(point).collect()
        };
        let slope = falling_error(&points(0.0)).unwrap();
        assert!(
            slope.floor.is_none() && (slope.exponent - 2.0).abs() < 0.05,
            "{slope:?}"
        );
        let slope = falling_error(&points(1e-4)).unwrap();
        assert!((slope.exponent - 2.0).abs() < 0.1, "{slope:?}");
        assert!((0.8e-4..1.5e-4).contains(&slope.floor.unwrap()), "{slope:?}");
    }

    #[test]
    fn the_order_of_points_does_not_matter() {
        let error = |x: f64| x * x + 1e-6;
        let mut points: Vec<(f64, f64)> = (0..14).map(|i| 0.5f64.powi(i)).map(|x| (x, error(x))).collect();
        let before = falling_error(&points).unwrap();
        points.reverse();
        let after = falling_error(&points).unwrap();
        assert!((after.exponent - before.exponent).abs() < 1e-12 && after.floor == before.floor);
        assert!(before.points < 14 && before.floor.is_some());
    }
}
