//! The leaves of all roots and the parallel update that refines them: the CPU twin of the compute passes (ARCHITECTURE section 3).
//!
//! # Theory
//!
//! Two invariants of a leaf set keep what is drawn closed: (I1) a node is split iff its H-neighbour is; (I2) if a child of M
//! along the leg that M shares with N is split, N is split. With C(n) the neighbour of n's parent across n's outer leg
//! ([`across_outer_leg`]), the second one reads: when n is split, so is C(n). Hence one look-up a leaf, *is C(n) a leaf?*, tells
//! whether n may split and whether it is drawn as half of a pair.
//!
//! # Changes versus the papers
//!
//! The papers compare a leaf with the level that its neighbour *wishes*. Here every leaf publishes what it wishes, and a pass
//! later all decide from what is published about leaves that are there: no two leaves can disagree about a third, whatever the
//! metric, and no pass ever shows a crack.
//!
//! # Practice
//!
//! A pass is [`Forest::decide`] (reads only), [`Forest::apply`] (changes the leaves), [`Forest::publish`] (asks the metric).
//! [`Forest::update`] is the three together. A test feeds the wishes that a GPU published into [`Forest::leaves`] and compares
//! the decisions. [`Forest::invariants`] and [`Forest::cracks`] check the result, [`Forest::coarsest_balanced`] computes where an
//! unstarved forest settles under a nested metric.
//!
//! Cost: a few map look-ups a leaf and pass; nothing here is meant for a frame.

mod balanced;
mod check;
mod decide;
mod wish;

pub use check::{Crack, Violation, cracks, violations};
pub use wish::{BUCKETS, Buckets, bucket, quantise, wish};

use crate::neighbour::{about_right_angle, across_outer_leg};
use crate::{Census, MAX_LEVEL, Place, RootPoint, Site, Topology};
use std::collections::{BTreeMap, BTreeSet};

/// What a leaf published in the pass before, for the others to decide by.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Published {
    /// Its priority: the larger of metric over threshold and what a finer leaf requested, [quantised](quantise). Above 1 it
    /// should split.
    pub wish: f32,
    /// Whether its parent needs no split, so that it would rather merge. A leaf says so only when it has been there for a pass.
    pub merge: bool,
}

/// What a pass does to the leaves, all at once.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Changes {
    /// Leaves that split, each together with the other half of its diamond; ascending.
    pub splits: Vec<Place>,
    /// Nodes that become leaves in the place of their four children, each together with the other half of its diamond; ordered
    /// by their first children.
    pub merges: Vec<Place>,
    /// Leaves that must split before a finer one can, with the finer one's priority, for both halves of their diamonds.
    pub requests: BTreeMap<Place, f32>,
}

impl Changes {
    /// Number of leaves that disappear: those that split, and four for a merge.
    pub fn leaves_changed(&self) -> usize {
        self.splits.len() + 4 * self.merges.len()
    }
}

/// The leaves of every root of a mesh, with what they published.
///
/// ```
/// use keyleaf_key::{Forest, Topology};
/// let triangle = Topology::new(3, [[0, 1, 2]])?;
/// let mut forest = Forest::new(&triangle, 31);
/// forest.publish(|_| 1.5); // every leaf wishes to split
/// let changes = forest.decide(usize::MAX);
/// assert_eq!(changes.splits.len(), 3);
/// forest.apply(changes);
/// assert_eq!(forest.leaves.len(), 12);
/// # Ok::<(), keyleaf_key::TopologyError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Forest<'t> {
    topology: &'t Topology,
    max_level: u32,
    /// The leaves and what they published. Public, so that published values of another origin can be put in.
    pub leaves: BTreeMap<Place, Published>,
    /// What the last [`Forest::decide`] asked of leaves, to be published with their next wish.
    pub requests: BTreeMap<Place, f32>,
    /// Leaves that have not published yet.
    newcomers: BTreeSet<Place>,
}

impl<'t> Forest<'t> {
    /// All roots of the mesh as leaves. Leaves of `max_level`, at most [`MAX_LEVEL`], never split.
    pub fn new(topology: &'t Topology, max_level: u32) -> Self {
        Self::with_leaves(topology, max_level, topology.roots())
    }

    /// These leaves, which are taken to have been there for a pass and have published nothing. [`Forest::invariants`] tells
    /// whether they are a leaf set.
    pub fn with_leaves(topology: &'t Topology, max_level: u32, leaves: impl IntoIterator<Item = Place>) -> Self {
        Self {
            topology,
            max_level: max_level.min(MAX_LEVEL),
            leaves: leaves.into_iter().map(|leaf| (leaf, Published::default())).collect(),
            requests: BTreeMap::new(),
            newcomers: BTreeSet::new(),
        }
    }

    /// The mesh.
    pub fn topology(&self) -> &'t Topology {
        self.topology
    }

    /// The level whose leaves never split.
    pub fn max_level(&self) -> u32 {
        self.max_level
    }

    /// One pass: decide from what is published, apply it, publish anew. Returns what changed.
    ///
    /// `metric` is the priority of a node, metric over threshold: above 1 it should split. Both halves of a diamond should get
    /// the same answer, and no node a larger one than its parent (*nested*); without that the result stays free of cracks but
    /// depends on history. `capacity` is the number of leaves that there is room for; it is never exceeded, and a forest that
    /// exceeds it from the start only shrinks.
    pub fn update(&mut self, metric: impl Fn(&Place) -> f64, capacity: usize) -> Changes {
        let changes = self.decide(capacity);
        self.apply(changes.clone());
        self.publish(metric);
        changes
    }

    /// Every leaf publishes its wish and whether it would merge. Takes in the requests of the pass before and clears them.
    pub fn publish(&mut self, metric: impl Fn(&Place) -> f64) {
        for (leaf, published) in &mut self.leaves {
            let requested = self.requests.get(leaf).copied().unwrap_or(0.0);
            let may_split = leaf.level < self.max_level;
            *published = Published {
                wish: if may_split {
                    wish(metric(leaf)).max(requested)
                } else {
                    0.0
                },
                merge: !self.newcomers.contains(leaf)
                    && leaf
                        .parent()
                        .is_some_and(|parent| parent.level >= self.max_level || wish(metric(&parent)) <= 1.0),
            };
        }
        self.requests.clear();
        self.newcomers.clear();
    }

    /// Carries out what [`Forest::decide`] found for these very leaves, and keeps its requests for [`Forest::publish`].
    pub fn apply(&mut self, changes: Changes) {
        for leaf in changes.splits {
            self.leaves.remove(&leaf);
            for child in leaf.children() {
                self.add(child);
            }
        }
        for parent in changes.merges {
            for child in parent.children() {
                self.leaves.remove(&child);
            }
            self.add(parent);
        }
        self.requests = changes.requests;
    }

    fn add(&mut self, leaf: Place) {
        self.leaves.insert(leaf, Published::default());
        self.newcomers.insert(leaf);
    }

    /// Whether C(leaf) is a leaf: then this one may not split, and it is drawn as half of a pair.
    pub fn is_blocked(&self, leaf: Place) -> bool {
        self.blocker(leaf).is_some()
    }

    /// C(leaf), if it is a leaf.
    fn blocker(&self, leaf: Place) -> Option<Place> {
        across_outer_leg(self.topology, leaf).filter(|across| self.leaves.contains_key(across))
    }

    /// Whether the four nodes about the right angle of the leaf are leaves: then both pairs of them may be drawn as one triangle each, or none.
    pub fn is_free(&self, leaf: Place) -> bool {
        let about = about_right_angle(self.topology, leaf);
        about.is_some_and(|nodes| nodes.iter().all(|node| self.leaves.contains_key(node)))
    }

    /// The triangles that are drawn, those of pairs merged: corners in the order O, R, U.
    pub fn drawn(&self) -> impl Iterator<Item = [RootPoint; 3]> {
        self.drawn_with_pairs(|_| false)
    }

    /// The same where pairs of [free](Self::is_free) leaves are drawn as well if `is_enough` says so of the vertex between them.
    pub fn drawn_with_pairs(&self, is_enough: impl Fn(Site) -> bool) -> impl Iterator<Item = [RootPoint; 3]> {
        self.leaves.keys().filter_map(move |&leaf| {
            let between = Site::of(self.topology, leaf.at(0, 0));
            leaf.drawn(self.is_blocked(leaf) || self.is_free(leaf) && is_enough(between))
        })
    }

    /// What breaks the cover of the roots or an invariant, nothing after any number of passes.
    pub fn invariants(&self) -> Vec<Violation> {
        violations(self.topology, self.leaves.keys().copied())
    }

    /// The edges of the drawn triangles that do not match, none after any pass.
    pub fn cracks(&self) -> Vec<Crack> {
        cracks(self.topology, self.drawn())
    }

    /// What [`Pressure`](crate::Pressure) watches, after a pass that changed `changed` leaves, with room for `capacity`.
    pub fn census(&self, changed: usize, capacity: usize) -> Census {
        Census::of(self.leaves.values().map(|published| published.wish), changed, capacity)
    }
}
