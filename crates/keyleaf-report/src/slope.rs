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
    /// The fitted y.
    pub fn at(&self, x: f64) -> f64 {
        self.factor * x.powf(self.exponent)
    }
}

/// A step whose slope is below this part of the median of those before it is on the floor.
const FLAT: f64 = 0.5;
/// Points nearer than this factor to the floor are mixed of both, and left out.
const ABOVE_FLOOR: f64 = 3.0;

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

/// The power law of an error that falls as x falls, until rounding holds it up.
///
/// From the coarsest point on, the floor begins where the local slope falls below half the median of those before; it is the median of
/// the errors from there. What is less than three times above it is left out of the fit. `None` for fewer than two points that count.
///
/// ```
/// use keyleaf_report::slope::falling_error;
/// let error = |edge: f64| 0.125 * edge * edge + 1e-7;
/// let points: Vec<(f64, f64)> = (0..16).map(|i| 0.5f64.powi(i)).map(|x| (x, error(x))).collect();
/// let slope = falling_error(&points).unwrap();
/// assert!((slope.exponent - 2.0).abs() < 0.05);
/// assert!((slope.floor.unwrap() / 1e-7 - 1.0).abs() < 0.1);
/// ```
pub fn falling_error(points: &[(f64, f64)]) -> Option<Slope> {
    let mut sorted: Vec<(f64, f64)> = points.iter().copied().filter(|p| p.0 > 0.0 && p.1 > 0.0).collect();
    sorted.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut slopes: Vec<f64> = Vec::new();
    let mut floor = None;
    for (i, pair) in sorted.windows(2).enumerate() {
        let run = (pair[0].0 / pair[1].0).ln();
        if run <= 0.0 {
            continue;
        }
        let local = (pair[0].1 / pair[1].1).ln() / run;
        let usual = crate::statistics::median(&slopes);
        if slopes.len() >= 2 && usual.is_some_and(|usual| usual > 0.0 && local < FLAT * usual) {
            let rest: Vec<f64> = sorted[i + 1..].iter().map(|p| p.1).collect();
            floor = crate::statistics::median(&rest);
            break;
        }
        slopes.push(local);
    }
    let least = floor.map_or(0.0, |floor| ABOVE_FLOOR * floor);
    let above: Vec<(f64, f64)> = sorted.into_iter().filter(|p| p.1 >= least).collect();
    Some(Slope {
        floor,
        ..power_law(&above)?
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
    fn the_order_of_points_does_not_matter() {
        let error = |x: f64| x * x + 1e-6;
        let mut points: Vec<(f64, f64)> = (0..14).map(|i| 0.5f64.powi(i)).map(|x| (x, error(x))).collect();
        let before = falling_error(&points).unwrap();
        points.reverse();
        assert_eq!(falling_error(&points).unwrap(), before);
        assert!(before.points < 14 && before.floor.is_some());
    }
}
