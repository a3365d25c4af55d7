//! The threshold that rises while a full buffer leaves wishes unmet (DESIGN section 4).

/// Unchanged passes after which the pressure may move a step.
const PATIENCE: u32 = 3;

/// Steps of pressure that double the threshold.
const STEPS_PER_OCTAVE: f64 = 4.0;

/// Room that must be free for each leaf that the next lower step may split: three new leaves, and as many to spare.
const ROOM_PER_SPLIT: usize = 6;

/// What a pass left: the numbers that move [`Pressure`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Census {
    /// Leaves that the pass split or merged.
    pub changed: usize,
    /// Leaves there are now.
    pub leaves: usize,
    /// Leaves whose wish is above 1: they should split.
    pub over: usize,
    /// Leaves whose wish would be above 1 if the pressure were a step lower.
    pub nearly: usize,
}

impl Census {
    /// Counts the wishes that the leaves published, after a pass that changed `changed` leaves.
    pub fn of(wishes: impl IntoIterator<Item = f32>, changed: usize) -> Self {
        let a_step_lower = (-1.0 / STEPS_PER_OCTAVE).exp2();
        let mut census = Self {
            changed,
            ..Self::default()
        };
        for wish in wishes {
            census.leaves += 1;
            if wish > 1.0 {
                census.over += 1;
            } else if f64::from(wish) > a_step_lower {
                census.nearly += 1;
            }
        }
        census
    }
}

/// Raises the effective threshold, for splits and merges alike, in steps of 2^(1/4) while wishes do not fit the capacity, and
/// lowers it when the splits of the next lower step fit with room to spare. Without it a full buffer stays as it is for good:
/// nothing merges to pay for what is more urgent.
///
/// ```
/// use keyleaf_key::{Census, Pressure};
/// let mut pressure = Pressure::default();
/// for _ in 0..3 {
///     pressure.observe(Census { changed: 0, leaves: 100, over: 7, nearly: 0 }, 101);
/// }
/// assert_eq!(pressure.steps(), 1);
/// assert_eq!(pressure.scale(), 0.5_f64.powf(0.25)); // multiplies the metric
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Pressure {
    steps: u32,
    unchanged_passes: u32,
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

    /// Takes in what a pass left, when there is room for `capacity` leaves.
    pub fn observe(&mut self, census: Census, capacity: usize) {
        self.unchanged_passes = if census.changed > 0 {
            0
        } else {
            self.unchanged_passes.saturating_add(1)
        };
        if self.unchanged_passes < PATIENCE {
            return;
        }
        let free = capacity.saturating_sub(census.leaves);
        if census.over > 0 {
            self.steps = self.steps.saturating_add(1);
            self.unchanged_passes = 0;
        } else if self.steps > 0 && ROOM_PER_SPLIT.saturating_mul(census.nearly) <= free {
            self.steps -= 1;
            self.unchanged_passes = 0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn observe(pressure: &mut Pressure, census: Census, passes: usize) {
        for _ in 0..passes {
            pressure.observe(census, 1000);
        }
    }

    #[test]
    fn three_unchanged_passes_with_unmet_wishes_raise_a_step() {
        let mut pressure = Pressure::default();
        let starved = Census {
            changed: 0,
            leaves: 990,
            over: 20,
            nearly: 0,
        };
        observe(&mut pressure, starved, 2);
        observe(
            &mut pressure,
            Census {
                changed: 4,
                ..starved
            },
            1,
        );
        observe(&mut pressure, starved, 2);
        assert_eq!(pressure.steps(), 0);
        observe(&mut pressure, starved, 1 + 3 * 3);
        assert_eq!(pressure.steps(), 4);
        assert_eq!(pressure.scale(), 0.5);
    }

    #[test]
    fn it_falls_only_when_the_next_lower_step_fits_with_room_to_spare() {
        let mut pressure = Pressure {
            steps: 2,
            unchanged_passes: 0,
        };
        observe(
            &mut pressure,
            Census {
                changed: 0,
                leaves: 880,
                over: 0,
                nearly: 21,
            },
            10,
        );
        assert_eq!(pressure.steps(), 2);
        observe(
            &mut pressure,
            Census {
                changed: 0,
                leaves: 880,
                over: 0,
                nearly: 20,
            },
            1,
        );
        assert_eq!(pressure.steps(), 1);
        observe(
            &mut pressure,
            Census {
                changed: 0,
                leaves: 880,
                over: 0,
                nearly: 0,
            },
            9,
        );
        assert_eq!(pressure.steps(), 0);
    }

    #[test]
    fn the_census_counts_wishes_on_both_sides_of_the_threshold() {
        let census = Census::of([0.0, 0.84, 0.841, 1.0, 1.000_01, 7.0], 3);
        assert_eq!(
            census,
            Census {
                changed: 3,
                leaves: 6,
                over: 2,
                nearly: 2
            }
        );
    }
}
