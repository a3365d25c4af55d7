//! What must hold of the forest, whatever the metric, the capacity and the mesh.

use crate::meshes;
use crate::metrics::{self, Kind, Metric};
use keyleaf_key::forest::{cracks, wish};
use keyleaf_key::{Forest, Place, Pressure, Site, Topology, neighbour};
use proptest::prelude::*;
use std::collections::BTreeSet;

fn assert_closed(forest: &Forest<'_>) {
    assert_eq!(forest.invariants(), []);
    assert_eq!(forest.cracks(), []);
}

fn leaves(forest: &Forest<'_>) -> BTreeSet<Place> {
    forest.leaves.keys().copied().collect()
}

/// Passes within which an unstarved forest settles (ARCHITECTURE section 3) when priorities fall off smoothly.
fn settling_passes(max_level: u32) -> u32 {
    2 * max_level + 8
}

/// The same when neighbours have nothing to do with each other: each new level may find a leaf that is blocked by a chain of
/// coarser ones, which takes a pass a level up and another down. Seen: 24 passes for level 5, 10 for level 3.
fn settling_passes_of_noise(max_level: u32) -> u32 {
    max_level * (max_level + 2) + 8
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn no_pass_cracks_loses_or_doubles_a_leaf_or_exceeds_the_capacity(
        mesh in meshes::random(),
        jumps in prop::collection::vec((metrics::any_kind(), 0.1..4.0_f64, 1..12_usize), 1..5),
        room in prop_oneof![Just(usize::MAX), 0..500_usize],
    ) {
        let topology = mesh.topology();
        let mut forest = Forest::new(&topology, 5);
        let capacity = forest.leaves.len().saturating_add(room);
        for (metric, scale, passes) in jumps {
            let metric = metric.on(&topology);
            for _ in 0..passes {
                forest.update(|node| metric(node) * scale, capacity);
                assert_closed(&forest);
                // Whichever vertices between free leaves pairs leave out.
                let is_enough = |between: Site| format!("{between:?}").bytes().map(u32::from).sum::<u32>() % 3 == 0;
                assert_eq!(cracks(&topology, forest.drawn_with_pairs(is_enough)), []);
                prop_assert!(forest.leaves.len() <= capacity);
            }
        }
    }

    #[test]
    fn unstarved_the_forest_settles_in_the_coarsest_balanced_refinement_whatever_it_was_before(
        mesh in meshes::random(),
        jumps in prop::collection::vec((metrics::nested(), 0.1..4.0_f64, 0..8_usize), 0..4),
        metric in metrics::nested(),
    ) {
        const MAX_LEVEL: u32 = 5;
        let topology = mesh.topology();
        let mut forest = Forest::new(&topology, MAX_LEVEL);
        for (metric, scale, passes) in jumps {
            let metric = metric.on(&topology);
            for _ in 0..passes {
                forest.update(|node| metric(node) * scale, usize::MAX);
            }
        }
        let there = metric.on(&topology);
        for _ in 0..settling_passes_of_noise(MAX_LEVEL) {
            forest.update(&there, usize::MAX);
        }
        prop_assert_eq!(leaves(&forest), forest.coarsest_balanced(&there));
        prop_assert_eq!(forest.update(&there, usize::MAX).leaves_changed(), 0);
        assert_closed(&forest);
    }
}

/// Large near one point of root 0 of face 0, so that the leaves about it are at the deepest level.
fn near_a_point(topology: &Topology, node: Place) -> f64 {
    const AT: [f64; 2] = [0x2aaa_aaab_u32 as f64 + 0.5, 0x1234_5677_u32 as f64 + 0.5];
    let nearness = |half: Place| {
        let middle = half.middle();
        let distance = (f64::from(middle.x) - AT[0]).hypot(f64::from(middle.y) - AT[1]);
        if (half.face, half.root) == (0, 0) {
            2.0 * f64::from(half.unit()) / distance
        } else {
            0.0
        }
    };
    let of_diamond = neighbour::h(topology, node).map_or(0.0, nearness).max(nearness(node));
    node.parent()
        .map_or(of_diamond, |parent| of_diamond.min(near_a_point(topology, parent)))
}

#[test]
fn a_fly_in_to_level_31_and_back_stays_closed_and_settles_in_time() {
    let topology = meshes::house().topology();
    let metric = |node: &Place| near_a_point(&topology, *node);
    let mut forest = Forest::new(&topology, 31);
    let roots = leaves(&forest);
    for _ in 0..settling_passes(31) {
        forest.update(metric, usize::MAX);
        assert_closed(&forest);
    }
    assert!(forest.leaves.keys().any(|leaf| leaf.level == 31 && leaf.unit() == 1));
    assert_eq!(leaves(&forest), forest.coarsest_balanced(metric));
    for _ in 0..settling_passes(31) {
        forest.update(|_| 0.5, usize::MAX);
        assert_closed(&forest);
    }
    assert_eq!(leaves(&forest), roots);
}

/// A forest with less room than it needs.
struct Starved<'t> {
    forest: Forest<'t>,
    pressure: Pressure,
    capacity: usize,
}

impl<'t> Starved<'t> {
    fn new(topology: &'t Topology, max_level: u32, capacity: usize) -> Self {
        Self {
            forest: Forest::new(topology, max_level),
            pressure: Pressure::default(),
            capacity,
        }
    }

    fn run(&mut self, metric: &impl Fn(&Place) -> f64, passes: usize) {
        for _ in 0..passes {
            let scale = self.pressure.scale();
            let changes = self.forest.update(|node| metric(node) * scale, self.capacity);
            assert_closed(&self.forest);
            assert!(self.forest.leaves.len() <= self.capacity);
            self.pressure.observe(
                self.forest.census(changes.leaves_changed(), self.capacity),
                self.capacity,
            );
        }
    }

    fn worst_unmet(&self, metric: &impl Fn(&Place) -> f64) -> f64 {
        let open = self
            .forest
            .leaves
            .keys()
            .filter(|leaf| leaf.level < self.forest.max_level());
        open.map(metric).fold(0.0, f64::max)
    }
}

#[test]
fn starved_a_jump_ends_with_the_pressure_and_the_leaves_of_a_fresh_start() {
    let topology = meshes::cube().topology();
    for seed in 0..20 {
        let here = Metric::new(Kind::Distance, seed).on(&topology);
        let there = Metric::new(Kind::Distance, seed + 77).on(&topology);
        let (mut fresh, mut jumped) = (Starved::new(&topology, 4, 300), Starved::new(&topology, 4, 300));
        fresh.run(&there, 120);
        jumped.run(&here, 60);
        jumped.pressure.forget();
        jumped.run(&there, 180);
        assert_eq!(jumped.pressure.steps(), fresh.pressure.steps(), "seed {seed}");
        assert_eq!(leaves(&jumped.forest), leaves(&fresh.forest), "seed {seed}");
        assert!(
            jumped.worst_unmet(&there) * jumped.pressure.scale() <= 1.0001,
            "seed {seed}"
        );
    }
}

#[test]
fn a_smooth_metric_settles_within_two_passes_a_level_and_eight() {
    const MAX_LEVEL: u32 = 5;
    let topology = meshes::cube().topology();
    let mut forest = Forest::new(&topology, MAX_LEVEL);
    for seed in 0..12 {
        let metric = Metric::new(Kind::Distance, seed).on(&topology);
        for _ in 0..settling_passes(MAX_LEVEL) {
            forest.update(&metric, usize::MAX);
            assert_closed(&forest);
        }
        assert_eq!(leaves(&forest), forest.coarsest_balanced(&metric), "seed {seed}");
    }
}

#[test]
fn a_full_buffer_does_not_freeze() {
    let topology = meshes::cube().topology();
    let mut starved = Starved::new(&topology, 5, 200);
    starved.run(&Metric::new(Kind::Distance, 0).on(&topology), 60);
    let before = leaves(&starved.forest);
    starved.run(&Metric::new(Kind::Distance, 78).on(&topology), 60);
    assert_ne!(leaves(&starved.forest), before);
    assert!(starved.pressure.steps() > 0);
}

#[test]
fn metrics_that_are_no_numbers_neither_panic_nor_crack() {
    let topology = meshes::open().topology();
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, f64::MIN_POSITIVE] {
        let mut forest = Forest::new(&topology, 3);
        for _ in 0..8 {
            forest.update(|_| value, 10_000);
        }
        assert_closed(&forest);
        let all_split = wish(value) > 1.0;
        assert_eq!(
            forest.leaves.len(),
            topology.roots().count() * if all_split { 64 } else { 1 }
        );
    }
}

#[test]
fn a_leaf_that_is_new_publishes_no_merge_before_it_has_been_there_for_a_pass() {
    let topology = meshes::tetrahedron().topology();
    let mut forest = Forest::new(&topology, 4);
    forest.update(|_| 2.0, usize::MAX);
    forest.update(|_| 0.5, usize::MAX);
    assert!(forest.leaves.keys().all(|leaf| leaf.level == 1) && forest.leaves.values().all(|p| !p.merge));
    forest.update(|_| 0.5, usize::MAX);
    assert!(forest.leaves.keys().all(|leaf| leaf.level == 1) && forest.leaves.values().all(|p| p.merge));
    forest.update(|_| 0.5, usize::MAX);
    assert!(forest.leaves.keys().all(|leaf| leaf.level == 0));
}
