//! What every leaf decides from the published values alone: the twin of the update pass's first half.

use super::{Buckets, Changes, Forest, Published};
use crate::neighbour::{h, x, y};
use crate::{Place, Topology};

impl Forest<'_> {
    /// What the leaves do next, when there is room for `capacity` leaves. Reads [`Forest::leaves`] only.
    ///
    /// A leaf *wants* to split if its wish is above 1 and its bucket of priority is admitted.
    /// - It splits iff the other half of its diamond wants to as well and neither is blocked.
    /// - If it is blocked, it requests that its blocker C(n), and the other half of that diamond, be split first.
    /// - The children of a diamond's halves merge iff all eight are leaves that would merge and do not want to split, and no
    ///   child along the outer legs of the diamond is split or wants to be.
    ///
    /// On a boundary of the mesh the missing half of a diamond agrees with everything.
    pub fn decide(&self, capacity: usize) -> Changes {
        let wishes = self
            .leaves
            .iter()
            .map(|(leaf, published)| self.open_wish(*leaf, *published));
        let free = capacity.saturating_sub(self.leaves.len());
        let pass = Pass {
            forest: self,
            lowest_admitted: Buckets::of(wishes).lowest_admitted(free),
        };
        let mut changes = Changes::default();
        for (&leaf, &published) in &self.leaves {
            if pass.admits(leaf, published) {
                if let Some(blocker) = self.blocker(leaf) {
                    for half in std::iter::once(blocker).chain(h(self.topology, blocker)) {
                        let request = changes.requests.entry(half).or_default();
                        *request = request.max(published.wish);
                    }
                } else if h(self.topology, leaf).is_none_or(|other| pass.wants(other) && !self.is_blocked(other)) {
                    changes.splits.push(leaf);
                }
            } else if let Some((parent, 0)) = leaf.ascend()
                && pass.may_merge(parent)
            {
                changes.merges.push(parent);
            }
        }
        changes
    }

    /// The wish of a leaf that may still split.
    fn open_wish(&self, leaf: Place, published: Published) -> f32 {
        if leaf.level < self.max_level {
            published.wish
        } else {
            0.0
        }
    }
}

/// What is fixed during one pass.
struct Pass<'a> {
    forest: &'a Forest<'a>,
    lowest_admitted: usize,
}

impl Pass<'_> {
    /// Whether this leaf wants to split and is admitted.
    fn admits(&self, leaf: Place, published: Published) -> bool {
        let wish = self.forest.open_wish(leaf, published);
        wish > 1.0 && super::bucket(wish) >= self.lowest_admitted
    }

    /// Whether this node is a leaf that wants to split and is admitted.
    fn wants(&self, node: Place) -> bool {
        self.forest
            .leaves
            .get(&node)
            .is_some_and(|published| self.admits(node, *published))
    }

    /// Whether the node and the other half of its diamond become leaves.
    fn may_merge(&self, node: Place) -> bool {
        self.half_may_merge(node) && h(self.forest.topology, node).is_none_or(|other| self.half_may_merge(other))
    }

    fn half_may_merge(&self, half: Place) -> bool {
        let leaves = &self.forest.leaves;
        let would_merge = |child| {
            leaves
                .get(&child)
                .is_some_and(|published| published.merge && !self.wants(child))
        };
        // A finer node across a leg would be two levels finer than the result.
        let stays_unsplit = |child| leaves.contains_key(&child) && !self.wants(child);
        half.children().into_iter().all(would_merge)
            && across_legs(self.forest.topology, half)
                .into_iter()
                .all(|(across, along_leg)| {
                    leaves.contains_key(&across)
                        || along_leg
                            .map(|digit| across.child(digit))
                            .into_iter()
                            .all(stays_unsplit)
                })
    }
}

/// The nodes across the two legs of a node, each with the digits of its children along that leg. Where a node is split and (I2)
/// holds, both exist: as leaves or as split nodes.
fn across_legs(topology: &Topology, node: Place) -> [(Place, [u32; 2]); 2] {
    [(x(topology, node), [0, 1]), (y(topology, node), [2, 3])]
}
