//! Fills voids with the smoothest surface through the samples around them.
//!
//! The solution of Laplace's equation with the border as given values: it has no bumps of its own and stays between
//! the lowest and the highest sample of the border. A first guess comes from a pyramid of averages (Gortler et al.,
//! *The Lumigraph*, 1996, section 3.5, "push-pull"), then over-relaxation makes it smooth. Time O(samples) for the
//! pyramid and O(voids) for each of [`SWEEPS`] sweeps.

use super::voids::neighbours;

/// Sweeps of successive over-relaxation.
const SWEEPS: usize = 120;
/// Its factor; between 1 and 2, larger spreads faster.
const OVER_RELAXATION: f64 = 1.7;

/// Replaces the samples under `mask`; at least one sample must not be under it.
pub(super) fn fill(samples: &mut [f32], mask: &[bool], width: usize) {
    let height = samples.len() / width;
    let guess = push_pull(samples, mask, width, height);
    let voids: Vec<usize> = (0..samples.len()).filter(|&i| mask[i]).collect();
    let mut work: Vec<f64> = guess;
    for _ in 0..SWEEPS {
        for &at in &voids {
            let (sum, count) =
                neighbours(at, width, height).fold((0.0, 0), |(sum, count), n| (sum + work[n], count + 1));
            let mean = sum / f64::from(count);
            work[at] += OVER_RELAXATION * (mean - work[at]);
        }
    }
    for (region, low, high) in regions(samples, mask, width, height) {
        for at in region {
            samples[at] = (work[at] as f32).clamp(low, high);
        }
    }
}

/// The connected voids, each with the lowest and highest sample of its border.
fn regions(samples: &[f32], mask: &[bool], width: usize, height: usize) -> Vec<(Vec<usize>, f32, f32)> {
    let mut seen = vec![false; samples.len()];
    let mut regions = Vec::new();
    for start in 0..samples.len() {
        if !mask[start] || std::mem::replace(&mut seen[start], true) {
            continue;
        }
        let (mut low, mut high) = (f32::INFINITY, f32::NEG_INFINITY);
        let mut region = vec![start];
        let mut next = 0;
        while let Some(&at) = region.get(next) {
            next += 1;
            for neighbour in neighbours(at, width, height) {
                if !mask[neighbour] {
                    low = low.min(samples[neighbour]);
                    high = high.max(samples[neighbour]);
                } else if !std::mem::replace(&mut seen[neighbour], true) {
                    region.push(neighbour);
                }
            }
        }
        if low <= high {
            regions.push((region, low, high));
        }
    }
    regions
}

/// One level of the pyramid: sums of known samples and how many they are.
struct Level {
    width: usize,
    height: usize,
    sums: Vec<f64>,
    counts: Vec<f64>,
}

/// A value for every sample: itself, or for a void the average of the smallest block of 2^k × 2^k that has samples.
fn push_pull(samples: &[f32], mask: &[bool], width: usize, height: usize) -> Vec<f64> {
    let known = |i: usize| {
        if mask[i] {
            (0.0, 0.0)
        } else {
            (f64::from(samples[i]), 1.0)
        }
    };
    let (sums, counts) = (0..samples.len()).map(known).unzip();
    let mut levels = vec![Level {
        width,
        height,
        sums,
        counts,
    }];
    while let Some(level) = levels.last().filter(|l| l.width * l.height > 1) {
        let (w, h) = (level.width.div_ceil(2), level.height.div_ceil(2));
        let (mut sums, mut counts) = (vec![0.0; w * h], vec![0.0; w * h]);
        for row in 0..level.height {
            for column in 0..level.width {
                let (from, to) = (row * level.width + column, row / 2 * w + column / 2);
                sums[to] += level.sums[from];
                counts[to] += level.counts[from];
            }
        }
        levels.push(Level {
            width: w,
            height: h,
            sums,
            counts,
        });
    }
    let mut values: Vec<f64> = Vec::new();
    let mut coarse_width = 1;
    for level in levels.iter().rev() {
        let at = |i: usize| {
            let (row, column) = (i / level.width, i % level.width);
            let above = values.get(row / 2 * coarse_width + column / 2).copied().unwrap_or(0.0);
            if level.counts[i] > 0.0 {
                level.sums[i] / level.counts[i]
            } else {
                above
            }
        };
        values = (0..level.width * level.height).map(at).collect();
        coarse_width = level.width;
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hole_in_a_slope_is_filled_with_the_slope() {
        let width = 20;
        let slope = |i: usize| (3 * (i % width) + 2 * (i / width)) as f32;
        let mut samples: Vec<f32> = (0..400).map(slope).collect();
        let hole = |i: usize| (5..15).contains(&(i % width)) && (5..15).contains(&(i / width));
        let mask: Vec<bool> = (0..400).map(hole).collect();
        samples
            .iter_mut()
            .zip(&mask)
            .for_each(|(s, void)| *s = if *void { 0.0 } else { *s });
        fill(&mut samples, &mask, width);
        for (i, sample) in samples.iter().enumerate() {
            assert!((sample - slope(i)).abs() < 0.01, "{i}: {sample}");
        }
    }

    #[test]
    fn filled_samples_stay_between_their_border() {
        let width = 31;
        let noise = |i: usize| ((i * 7919) % 997) as f32;
        let mut samples: Vec<f32> = (0..width * width).map(noise).collect();
        // Long thin voids, one along the edge of the map.
        let mask: Vec<bool> = (0..width * width)
            .map(|i| i / width == 12 || i % width == 30 || i % 97 == 0)
            .collect();
        let before = samples.clone();
        fill(&mut samples, &mask, width);
        for (region, low, high) in regions(&before, &mask, width, width) {
            assert!(region.iter().all(|&i| (low..=high).contains(&samples[i])));
        }
        let untouched = |i: usize| mask[i] || samples[i] == before[i];
        assert!((0..samples.len()).all(untouched));
    }
}
