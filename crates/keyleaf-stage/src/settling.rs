//! Whether a stage has settled, as its figures tell.

use keyleaf::Statistics;

/// Frames without a change after which nothing will change: a request, and a merge, take two passes each.
const QUIET_FRAMES: u32 = 4;
/// The same while wishes are unmet, so that the pressure has had its turn.
const STARVED_QUIET_FRAMES: u32 = 12;

/// Watches the figures of a stage for the end of its changes.
#[derive(Debug, Clone, Copy, Default)]
pub struct Settling {
    unchanged: u32,
    pressure: f32,
    /// Passes of the latest figures that count.
    passes: u32,
    is_settled: bool,
}

impl Settling {
    /// Begins again: view or settings changed after `passes` passes. Figures up to there tell nothing any more.
    pub fn restart(&mut self, passes: u32) {
        *self = Self {
            passes,
            ..Self::default()
        };
    }

    /// Takes the figures of a frame, once each; whether nothing will change any more.
    pub fn observe(&mut self, statistics: &Statistics) -> bool {
        if statistics.passes <= self.passes {
            return self.is_settled;
        }
        let is_still = statistics.splits + statistics.merges == 0 && statistics.threshold_factor == self.pressure;
        self.passes = statistics.passes;
        self.unchanged = if is_still { self.unchanged + 1 } else { 0 };
        self.pressure = statistics.threshold_factor;
        let enough = if statistics.unmet == 0 {
            QUIET_FRAMES
        } else {
            STARVED_QUIET_FRAMES
        };
        self.is_settled = self.unchanged >= enough;
        self.is_settled
    }

    /// Whether nothing will change any more.
    pub fn is_settled(&self) -> bool {
        self.is_settled
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn statistics(passes: u32, splits: u32, unmet: u32) -> Statistics {
        Statistics {
            leaves: 4,
            visible: 4,
            triangles: 64,
            splits,
            merges: 0,
            unmet,
            starved: unmet,
            capacity: 64,
            threshold_factor: 1.0,
            passes,
            rebuilds: 0,
            table_load: 0.1,
            lost: 0,
        }
    }

    #[test]
    fn settles_after_quiet_frames_and_not_by_the_same_frame_seen_again() {
        let mut settling = Settling::default();
        settling.restart(10);
        assert!(
            !(0..100).any(|_| settling.observe(&statistics(10, 0, 0))),
            "figures from before"
        );
        settling.observe(&statistics(11, 3, 0));
        let seen: Vec<bool> = (12..20).map(|pass| settling.observe(&statistics(pass, 0, 0))).collect();
        assert_eq!(seen, [false, false, false, true, true, true, true, true]);
        settling.restart(19);
        assert!(
            !(0..100).any(|_| settling.observe(&statistics(20, 0, 0))),
            "one frame, often"
        );
    }

    #[test]
    fn unmet_wishes_take_longer() {
        let mut settling = Settling::default();
        let first = (1..40).find(|&pass| settling.observe(&statistics(pass, 0, 5)));
        assert_eq!(first, Some(1 + STARVED_QUIET_FRAMES));
    }
}
