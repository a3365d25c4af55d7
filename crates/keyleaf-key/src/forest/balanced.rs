//! The coarsest refinement that satisfies a metric and both invariants, top down: another algorithm than the passes, which must
//! settle in the same set.

use super::{Forest, wish};
use crate::Place;
use crate::neighbour::{across_outer_leg, h};
use std::collections::BTreeSet;

impl Forest<'_> {
    /// The leaves in which an unstarved forest of this mesh and level limit settles under a nested metric, whatever it was
    /// before. `metric` as for [`Forest::update`].
    pub fn coarsest_balanced(&self, metric: impl Fn(&Place) -> f64) -> BTreeSet<Place> {
        let mut split = BTreeSet::new();
        let mut unseen: Vec<Place> = self.topology.roots().collect();
        while let Some(node) = unseen.pop() {
            if node.level < self.max_level && wish(metric(&node)) > 1.0 {
                self.split_with_all_that_it_needs(node, &mut split);
            }
            if split.contains(&node) {
                unseen.extend(node.children());
            }
        }
        let mut leaves = BTreeSet::new();
        let mut open: Vec<Place> = self.topology.roots().collect();
        while let Some(node) = open.pop() {
            if split.contains(&node) {
                open.extend(node.children());
            } else {
                leaves.insert(node);
            }
        }
        leaves
    }

    /// Adds a node to the split ones, its ancestors, and what (I1) and (I2) ask for each of them.
    fn split_with_all_that_it_needs(&self, node: Place, split: &mut BTreeSet<Place>) {
        let mut needed = vec![node];
        while let Some(node) = needed.pop() {
            if split.insert(node) {
                needed.extend(node.parent());
                needed.extend(h(self.topology, node));
                needed.extend(across_outer_leg(self.topology, node));
            }
        }
    }
}
