//! Percentiles, the spread of a median, and differences of what was measured in pairs.
//!
//! Frames of a flight are neither normal nor independent: a few are long, and what slows one slows the next. So there are no means and
//! standard deviations here, but order statistics, and pairs are compared in blocks of consecutive frames.

use serde::{Deserialize, Serialize};

/// A closed interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Interval {
    /// Its lower end.
    pub low: f64,
    /// Its upper end.
    pub high: f64,
}

impl Interval {
    /// Whether a value lies in it, ends included.
    pub fn contains(&self, value: f64) -> bool {
        (self.low..=self.high).contains(&value)
    }
}

/// The probability with which intervals of this crate are meant to hold the median.
pub const CONFIDENCE: f64 = 0.95;

/// The value of the least rank that at least the part `q` (0..=1) of the sorted values do not exceed (*nearest rank*): a value that was
/// measured, never one between two. `None` if there are none.
pub fn percentile(sorted: &[f64], q: f64) -> Option<f64> {
    let rank = (q * sorted.len() as f64).ceil() as usize;
    sorted.get(rank.clamp(1, sorted.len().max(1)) - 1).copied()
}

/// The median by nearest rank; the values need not be sorted.
pub fn median(values: &[f64]) -> Option<f64> {
    percentile(&sorted(values), 0.5)
}

/// The values in ascending order.
pub fn sorted(values: &[f64]) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted
}

/// The narrowest symmetric interval of order statistics that holds the median of the distribution with at least the probability
/// `confidence`, whatever the distribution, if the values are independent. `None` if there are too few: 6 are needed for 95 %.
///
/// Of n values, the k-th least exceeds the median with the probability that fewer than k of n fair coins show heads.
pub fn median_interval(values: &[f64], confidence: f64) -> Option<Interval> {
    let sorted = sorted(values);
    let n = sorted.len();
    let allowed = (1.0 - confidence) / 2.0;
    let mut log_probability = -(n as f64) * std::f64::consts::LN_2;
    let mut below = 0.0;
    let mut k = 0;
    while k < n / 2 {
        below += log_probability.exp();
        if below > allowed {
            break;
        }
        log_probability += ((n - k) as f64 / (k + 1) as f64).ln();
        k += 1;
    }
    let low = *sorted.get(k.checked_sub(1)?)?;
    let high = *sorted.get(n - k)?;
    Some(Interval { low, high })
}

/// A change between two runs of the same frames, as a part of the first: 0.05 is 5 % more.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PairedChange {
    /// Median of the first run.
    pub before: f64,
    /// Median of the second run.
    pub after: f64,
    /// The median over the frames of after / before, less 1.
    pub change: f64,
    /// Where that median may lie: see [`paired_change`].
    pub interval: Interval,
}

/// Blocks of consecutive frames whose medians are compared.
const BLOCKS: usize = 12;

/// Compares two runs frame by frame. Both must have measured the same views in the same order; the shorter length counts.
///
/// The interval is the wider of two: of the median of the frames' ratios ([`median_interval`]), and of the medians of 12 blocks of
/// consecutive frames, as a machine that is slow for a while slows neighbouring frames together. With fewer than 12 frames it is all
/// that was seen. Frames in which either run took no time do not count. `None` if none are left.
pub fn paired_change(before: &[f64], after: &[f64]) -> Option<PairedChange> {
    let pairs = before.iter().zip(after).filter(|(b, a)| **b > 0.0 && **a > 0.0);
    let changes: Vec<f64> = pairs.map(|(b, a)| a / b - 1.0).collect();
    let all = sorted(&changes);
    let whole = Interval {
        low: *all.first()?,
        high: *all.last()?,
    };
    let interval = match (changes.len() >= BLOCKS).then(|| block_interval(&changes)).flatten() {
        Some(blocks) => {
            let frames = median_interval(&changes, CONFIDENCE).unwrap_or(whole);
            Interval {
                low: frames.low.min(blocks.low),
                high: frames.high.max(blocks.high),
            }
        }
        None => whole,
    };
    Some(PairedChange {
        before: median(before)?,
        after: median(after)?,
        change: percentile(&all, 0.5)?,
        interval,
    })
}

fn block_interval(changes: &[f64]) -> Option<Interval> {
    let bounds = |i: usize| i * changes.len() / BLOCKS;
    let medians: Option<Vec<f64>> = (0..BLOCKS)
        .map(|i| median(&changes[bounds(i)..bounds(i + 1)]))
        .collect();
    median_interval(&medians?, CONFIDENCE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_are_values_that_were_measured() {
        let sorted: Vec<f64> = (1..=100).map(f64::from).collect();
        let at = [0.0, 0.5, 0.95, 0.99, 1.0].map(|q| percentile(&sorted, q).unwrap());
        assert_eq!(at, [1.0, 50.0, 95.0, 99.0, 100.0]);
        assert_eq!(percentile(&[7.0], 0.99), Some(7.0));
        assert_eq!(percentile(&[], 0.5), None);
    }

    #[test]
    fn ranks_of_the_median_interval_are_those_of_the_tables() {
        // Conover, Practical Nonparametric Statistics: 95 % for n = 6, 10, 20, 100 are ranks 1, 2, 6, 40 from both ends.
        for (n, rank) in [(6, 1), (10, 2), (20, 6), (100, 40)] {
            let values: Vec<f64> = (1..=n).map(f64::from).collect();
            let found = median_interval(&values, 0.95).unwrap();
            assert_eq!((found.low, found.high), (f64::from(rank), f64::from(n + 1 - rank)));
        }
        assert_eq!(median_interval(&[1.0, 2.0, 3.0, 4.0, 5.0], 0.95), None);
        assert!(median_interval(&vec![1.0; 100_000], 0.95).is_some());
    }

    /// Numbers between 0 and 1 that look random.
    fn noise(i: usize) -> f64 {
        ((i as f64 * 12.9898).sin() * 43758.5453).rem_euclid(1.0)
    }

    #[test]
    fn a_slower_run_is_told_from_noise_and_equal_ones_are_not() {
        let cost = |i: usize| 2.0 + (i as f64 / 20.0).sin();
        let run = |seed: usize, factor: f64| -> Vec<f64> {
            (0..120)
                .map(|i| factor * cost(i) * (1.0 + 0.1 * noise(i + seed)))
                .collect()
        };
        let same = paired_change(&run(0, 1.0), &run(500, 1.0)).unwrap();
        assert!(same.interval.contains(0.0), "{same:?}");
        let slower = paired_change(&run(0, 1.0), &run(500, 1.1)).unwrap();
        assert!(slower.interval.low > 0.0 && slower.interval.contains(0.1), "{slower:?}");
    }

    #[test]
    fn a_machine_that_is_slow_for_a_while_widens_the_interval() {
        let steady = vec![1.0; 120];
        let slow_for_a_third: Vec<f64> = (0..120).map(|i| if i < 40 { 1.3 } else { 1.0 }).collect();
        let change = paired_change(&steady, &slow_for_a_third).unwrap();
        assert!(
            change.interval.contains(0.0) && change.interval.high > 0.29,
            "{change:?}"
        );
    }

    #[test]
    fn frames_without_time_do_not_count() {
        assert_eq!(paired_change(&[0.0], &[1.0]), None);
        let change = paired_change(&[0.0, 2.0], &[5.0, 4.0]).unwrap();
        assert_eq!((change.change, change.interval.low), (1.0, 1.0));
    }
}
