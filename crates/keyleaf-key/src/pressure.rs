//! The threshold that rises while a full buffer leaves wishes unmet (ARCHITECTURE section 4). Twin: `shaders/passes/copy.wgsl`.

use crate::forest::{Buckets, bucket};

/// Unchanged passes after which the pressure may move a step.
const PATIENCE: u32 = 3;

/// Passes since its last step after which it may move although leaves still change: the camera moves.
const PATIENCE_IN_MOTION: u32 = 16;

/// Steps of pressure that double the threshold.
const STEPS_PER_OCTAVE: f64 = 4.0;

/// A leaf that splits adds so many.
const ADDED_BY_SPLIT: usize = 3;

/// What a pass left: the numbers that move [`Pressure`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Census {
    /// Leaves that the pass split or merged.
    pub changed: usize,
    /// Leaves there are now.
    pub leaves: usize,
    /// Leaves whose wish is above 1, but which the capacity does not admit.
    pub starved: usize,
    /// Leaves whose wish would be above 1 if the pressure were a step lower.
    pub nearly: usize,
}

impl Census {
    /// Counts the wishes that the leaves published, after a pass that changed `changed` leaves, for room for `capacity` leaves.
    pub fn of(wishes: impl IntoIterator<Item = f32>, changed: usize, capacity: usize) -> Self {
        let a_step_lower = (-1.0 / STEPS_PER_OCTAVE).exp2();
        let wishes: Vec<f32> = wishes.into_iter().collect();
        let nearly = wishes
            .iter()
            .filter(|w| **w <= 1.0 && f64::from(**w) > a_step_lower)
            .count();
        let leaves = wishes.len();
        let lowest = Buckets::of(wishes.iter().copied()).lowest_admitted(capacity.saturating_sub(leaves));
        let starved = wishes.iter().filter(|w| **w > 1.0 && bucket(**w) < lowest).count();
        Self {
            changed,
            leaves,
            starved,
            nearly,
        }
    }
}

/// Raises the effective threshold, for splits and merges alike, in steps of 2^(1/4) while wishes do not fit the capacity, and
/// lowers it while they do. Without it a full buffer stays as it is for good: nothing merges to pay for what is more urgent.
///
/// Departure from the executable model, which lowers it only when the next step fits twice over: after a jump that rule could
/// leave the pressure three steps too high, or cycle. Here a lower step is tried, and one that failed is not tried again before
/// [`Pressure::forget`], so that a fresh start and a jump end at the same step: the lowest whose leaves fit.
///
/// ```
/// use keyleaf_key::{Census, Pressure};
/// let mut pressure = Pressure::default();
/// for _ in 0..3 {
///     pressure.observe(Census { changed: 0, leaves: 100, starved: 7, nearly: 0 }, 101);
/// }
/// assert_eq!(pressure.steps(), 1);
/// assert_eq!(pressure.scale(), 0.5_f64.powf(0.25)); // multiplies the metric
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Pressure {
    steps: u32,
    unchanged_passes: u32,
    passes_since_step: u32,
    /// A step at which wishes did not fit, for the present view.
    failed: Option<u32>,
}

impl Pressure {
    /// How many steps the threshold is raised.
    pub fn steps(&self) -> u32 {
        self.steps
    }

    /// The factor 2^(-steps/4) on every metric.
    pub fn scale(&self) -> f64 {
        (-f64::from(self.steps) / STEPS_PER_OCTAVE).exp2()
    }

    /// The view has changed: what did not fit may fit now, and what fitted has yet to be seen.
    pub fn forget(&mut self) {
        self.failed = None;
        self.unchanged_passes = 0;
    }

    /// Takes in what a pass left, when there is room for `capacity` leaves.
    pub fn observe(&mut self, census: Census, capacity: usize) {
        self.unchanged_passes = if census.changed > 0 {
            0
        } else {
            self.unchanged_passes.saturating_add(1)
        };
        self.passes_since_step = self.passes_since_step.saturating_add(1);
        let is_calm = self.unchanged_passes >= PATIENCE;
        if !is_calm && self.passes_since_step < PATIENCE_IN_MOTION {
            return;
        }
        if census.starved > 0 {
            self.failed = is_calm.then_some(self.steps);
            self.step_to(self.steps.saturating_add(1));
        } else if let Some(lower) = self.steps.checked_sub(1) {
            let free = capacity.saturating_sub(census.leaves);
            let needed = ADDED_BY_SPLIT.saturating_mul(census.nearly);
            // In motion there is no time to try: only what fits twice over.
            let fits = if is_calm {
                self.failed != Some(lower) && needed <= free
            } else {
                2 * needed <= free
            };
            if fits {
                self.step_to(lower);
            }
        }
    }

    fn step_to(&mut self, steps: u32) {
        self.steps = steps;
        self.unchanged_passes = 0;
        self.passes_since_step = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FREE: Census = Census {
        changed: 0,
        leaves: 880,
        starved: 0,
        nearly: 0,
    };
    const STARVED: Census = Census {
        changed: 0,
        leaves: 990,
        starved: 20,
        nearly: 0,
    };

    fn observe(pressure: &mut Pressure, census: Census, passes: usize) {
        for _ in 0..passes {
            pressure.observe(census, 1000);
        }
    }

    fn after_steps(steps: u32) -> Pressure {
        Pressure {
            steps,
            ..Pressure::default()
        }
    }

    #[test]
    fn three_unchanged_passes_with_unmet_wishes_raise_a_step() {
        let mut pressure = Pressure::default();
        observe(&mut pressure, STARVED, 2);
        observe(&mut pressure, Census { changed: 4, ..STARVED }, 1);
        observe(&mut pressure, STARVED, 2);
        assert_eq!(pressure.steps(), 0);
        observe(&mut pressure, STARVED, 1 + 3 * 3);
        assert_eq!(pressure.steps(), 4);
        assert_eq!(pressure.scale(), 0.5);
    }

    #[test]
    fn it_falls_only_when_the_splits_of_the_next_lower_step_fit() {
        let mut pressure = after_steps(2);
        observe(&mut pressure, Census { nearly: 41, ..FREE }, 10);
        assert_eq!(pressure.steps(), 2);
        observe(&mut pressure, Census { nearly: 40, ..FREE }, 1);
        assert_eq!(pressure.steps(), 1);
        observe(&mut pressure, FREE, 9);
        assert_eq!(pressure.steps(), 0);
    }

    #[test]
    fn a_step_that_failed_is_not_tried_again_until_the_view_changes() {
        let mut pressure = after_steps(3);
        observe(&mut pressure, STARVED, 3);
        assert_eq!(pressure.steps(), 4);
        observe(&mut pressure, FREE, 40);
        assert_eq!(pressure.steps(), 4);
        pressure.forget();
        observe(&mut pressure, FREE, 3);
        assert_eq!(pressure.steps(), 3);
    }

    #[test]
    fn in_motion_it_moves_every_sixteen_passes() {
        let mut pressure = Pressure::default();
        observe(&mut pressure, Census { changed: 9, ..STARVED }, 15);
        assert_eq!(pressure.steps(), 0);
        observe(&mut pressure, Census { changed: 9, ..STARVED }, 1);
        assert_eq!(pressure.steps(), 1);
        observe(
            &mut pressure,
            Census {
                changed: 9,
                nearly: 21,
                ..FREE
            },
            40,
        );
        assert_eq!(pressure.steps(), 1);
        observe(
            &mut pressure,
            Census {
                changed: 9,
                nearly: 20,
                ..FREE
            },
            1,
        );
        assert_eq!(pressure.steps(), 0);
    }

    #[test]
    fn the_census_counts_what_is_not_admitted_and_what_nearly_wishes() {
        let wishes = [0.0, 0.84, 0.841, 1.0, 1.000_01, 1.5, 7.0];
        assert_eq!(
            Census::of(wishes, 3, 16),
            Census {
                changed: 3,
                leaves: 7,
                starved: 0,
                nearly: 2
            }
        );
        assert_eq!(Census::of(wishes, 3, 15).starved, 2);
        assert_eq!(Census::of(wishes, 3, 9).starved, 3);
    }
}
