//! Axes: from values to places, and their ticks.

/// How an axis counts.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What it says.
    pub title: String,
    /// Whether equal steps are equal ratios.
    pub logarithmic: bool,
}

impl Axis {
    /// An axis of ratios.
    pub fn logarithmic(title: &str) -> Self {
        let title = title.to_owned();
        Self {
            title,
            logarithmic: true,
        }
    }

    /// An axis of differences.
    pub fn linear(title: &str) -> Self {
        let title = title.to_owned();
        Self {
            title,
            logarithmic: false,
        }
    }
}

/// A tick: its value, and what it says; nothing for one between others.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    pub value: f64,
    pub text: Option<String>,
}

/// An axis with its range, and the places of its ends.
pub(super) struct Scale {
    logarithmic: bool,
    /// Ends of the range; of their logarithms where the axis is logarithmic.
    range: [f64; 2],
    places: [f64; 2],
}

impl Scale {
    /// A scale that shows all values that it can, with some room around them.
    pub fn new(axis: &Axis, values: impl Iterator<Item = f64>, places: [f64; 2]) -> Self {
        let logarithmic = axis.logarithmic;
        let shown = values.filter(|v| v.is_finite() && (!logarithmic || *v > 0.0));
        let shown = shown.map(|v| if logarithmic { v.log10() } else { v });
        let (low, high) = shown.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        let [low, high] = if low <= high { [low, high] } else { [0.0, 1.0] };
        let least = if logarithmic { 0.5 } else { 1e-3 * high.abs().max(1e-3) };
        let room = (0.06 * (high - low)).max((least - (high - low)) / 2.0);
        Self {
            logarithmic,
            range: [low - room, high + room],
            places,
        }
    }

    /// A linear scale from 0.
    pub fn from_zero(high: f64, places: [f64; 2]) -> Self {
        Self {
            logarithmic: false,
            range: [0.0, if high > 0.0 { high } else { 1.0 }],
            places,
        }
    }

    /// The place of a value; `None` for what a logarithmic axis cannot show.
    pub fn place(&self, value: f64) -> Option<f64> {
        let value = match self.logarithmic {
            true if value > 0.0 => value.log10(),
            true => return None,
            false => value,
        };
        let part = (value - self.range[0]) / (self.range[1] - self.range[0]);
        part.is_finite()
            .then(|| self.places[0] + part * (self.places[1] - self.places[0]))
    }

    /// Ticks in the range, ascending, of which `most` or fewer have texts.
    pub fn ticks(&self, most: usize) -> Vec<Tick> {
        if self.logarithmic {
            self.decades(most)
        } else {
            self.even(most)
        }
    }

    /// Decades, with 2 and 5 where there are few, and every other one where there are many.
    fn decades(&self, most: usize) -> Vec<Tick> {
        let [low, high] = self.range;
        let span = high - low;
        let stride = (span / most as f64).ceil().max(1.0) as i32;
        let labelled: &[u32] = match () {
            () if span < 0.9 && most >= 5 => &[1, 2, 3, 5, 7],
            () if 3.0 * span <= most as f64 => &[1, 2, 5],
            () => &[1],
        };
        let mut ticks = Vec::new();
        for decade in low.floor() as i32..=high.ceil() as i32 {
            for digit in 1..=9u32 {
                let value = f64::from(digit) * 10f64.powi(decade);
                let log = value.log10();
                if log < low || log > high {
                    continue;
                }
                let has_text = labelled.contains(&digit) && decade.rem_euclid(stride) == 0;
                if digit == 1 || span < 6.0 {
                    ticks.push(Tick {
                        value,
                        text: has_text.then(|| power(digit, decade)),
                    });
                }
            }
        }
        ticks
    }

    fn even(&self, most: usize) -> Vec<Tick> {
        let [low, high] = self.range;
        let rough = (high - low) / most.max(1) as f64;
        let decade = 10f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 2.5, 5.0, 10.0]
            .map(|s| s * decade)
            .into_iter()
            .find(|s| *s >= rough * (1.0 - 1e-9));
        let step = step.unwrap_or(10.0 * decade);
        let decimals = (0..6)
            .find(|d| ((step * 10f64.powi(*d)).fract()).abs() < 1e-9)
            .unwrap_or(6);
        let first = (low / step - 1e-9).ceil() as i64;
        let last = (high / step + 1e-9).floor() as i64;
        let tick = |i: i64| Tick {
            value: i as f64 * step,
            text: Some(format!("{:.*}", decimals as usize, i as f64 * step)),
        };
        (first..=last).map(tick).collect()
    }
}

/// A digit times a power of ten: 0.02, 500, 3·10⁻⁷.
fn power(digit: u32, decade: i32) -> String {
    match decade {
        -3..=-1 => format!(
            "{:.*}",
            decade.unsigned_abs() as usize,
            f64::from(digit) * 10f64.powi(decade)
        ),
        0..=4 => crate::table::thousands(f64::from(digit) * 10f64.powi(decade)),
        _ => {
            let exponent: String = decade.to_string().chars().map(superscript).collect();
            if digit == 1 {
                format!("10{exponent}")
            } else {
                format!("{digit}·10{exponent}")
            }
        }
    }
}

fn superscript(c: char) -> char {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    c.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(values: [f64; 2], logarithmic: bool, most: usize) -> Vec<String> {
        let axis = Axis {
            title: String::new(),
            logarithmic,
        };
        let scale = Scale::new(&axis, values.into_iter(), [0.0, 100.0]);
        scale.ticks(most).into_iter().filter_map(|tick| tick.text).collect()
    }

    #[test]
    fn logarithmic_axes_have_decades() {
        assert_eq!(
            texts([1e-7, 1e-1], true, 7),
            ["10⁻⁷", "10⁻⁶", "10⁻⁵", "10⁻⁴", "0.001", "0.01", "0.1"]
        );
        assert_eq!(texts([0.9, 12.0], true, 6), ["1", "2", "5", "10"]);
        assert_eq!(texts([1e3, 1e8], true, 3).len(), 3);
        assert_eq!(texts([4.0, 5.0], true, 6), ["3", "5", "7"]);
    }

    #[test]
    fn linear_axes_have_round_steps() {
        assert_eq!(texts([31.0, 58.0], false, 7), ["30", "35", "40", "45", "50", "55"]);
        assert_eq!(texts([0.0, 0.5], false, 5), ["0.0", "0.2", "0.4"]);
    }

    #[test]
    fn places_run_along_the_axis_and_what_cannot_be_shown_has_none() {
        let axis = Axis::logarithmic("");
        let scale = Scale::new(&axis, [1.0, 100.0, 0.0, f64::NAN].into_iter(), [0.0, 100.0]);
        let [a, b, c] = [1.0, 10.0, 100.0].map(|v| scale.place(v).unwrap());
        assert!((b - 50.0).abs() < 1e-9 && (a + c - 100.0).abs() < 1e-9 && a > 0.0);
        assert_eq!(scale.place(0.0), None);
        assert!(Scale::new(&axis, [5.0].into_iter(), [0.0, 1.0]).place(5.0).is_some());
        assert!(Scale::new(&axis, std::iter::empty(), [0.0, 1.0]).ticks(5).len() > 1);
    }
}
