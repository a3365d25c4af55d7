//! How many leaves there are of each level, read from the device when the quadtrees have settled.

use keyleaf::headless::Headless;
use keyleaf::{Statistics, View};
use keyleaf_stage::Stage;

/// Leaves by level.
#[derive(Debug, Clone, Default)]
pub struct Levels {
    /// Leaves of each level, from 0 on; all surfaces together.
    pub counts: Vec<u32>,
    /// What was last counted.
    counted: Option<(u32, u32, View)>,
}

impl Levels {
    /// Counts, unless what has settled was counted already. Waits for the device.
    pub fn count(&mut self, gpu: &Headless, stage: &Stage, statistics: &Statistics, view: &View) {
        let now = Some((statistics.leaves, statistics.visible, *view));
        if self.counted == now {
            return;
        }
        self.counted = now;
        self.counts.clear();
        for object in &stage.objects {
            let Ok(leaves) = object.quadtree.read_leaves(&gpu.device, &gpu.queue) else {
                return;
            };
            for leaf in leaves {
                let level = leaf.place().level as usize;
                if self.counts.len() <= level {
                    self.counts.resize(level + 1, 0);
                }
                self.counts[level] += 1;
            }
        }
    }

    /// Forgets what was counted.
    pub fn forget(&mut self) {
        *self = Self::default();
    }
}
