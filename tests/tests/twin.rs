//! The GPU and the CPU twin decide the same: fed with the wishes that the GPU published, `keyleaf_key::Forest` arrives at exactly the
//! leaves, and the pair flags, of the GPU's next pass. Wishes are integers here: nothing is rounded on either side.

use crate::random::Random;
use crate::snapshot::{findings, forest};
use crate::world::{World, places, random_view, settings};
use crate::{meshes, surfaces};
use keyleaf::key::Place;
use keyleaf::layout::state;
use keyleaf::read_back::Snapshot;
use keyleaf::surface::Surface;
use keyleaf::{Metric, Settings, View};
use std::collections::BTreeMap;
use std::sync::Arc;

/// What a run of passes did, so that a test can tell that it tried something.
#[derive(Default, Debug)]
struct Tally {
    splits: usize,
    merges: usize,
    requests: usize,
    starved: usize,
    most_leaves: usize,
}

/// Runs passes and compares each with the twin.
fn follow(world: &mut World, before: &mut Snapshot, view: &View, passes: u32, tally: &mut Tally, case: &str) {
    let surface = Arc::clone(&world.surface);
    let topology = surface.topology();
    let capacity = world.quadtree.settings().capacity as usize;
    for pass in 0..passes {
        let after = world.pass(view);
        let mut twin = forest(topology, before);
        let changes = twin.decide(capacity);
        tally.splits += changes.splits.len();
        tally.merges += changes.merges.len();
        tally.requests += changes.requests.len();
        tally.starved += after.control.starved as usize;
        tally.most_leaves = tally.most_leaves.max(after.leaves.len());
        assert_eq!(
            after.control.last_splits as usize,
            changes.splits.len(),
            "{case}, pass {pass}: splits"
        );
        assert_eq!(
            after.control.last_merges as usize,
            changes.merges.len(),
            "{case}, pass {pass}: merges"
        );
        let requests = changes.requests.clone();
        twin.apply(changes);
        let expected: Vec<Place> = twin.leaves.keys().copied().collect();
        assert!(
            places(&after).iter().copied().eq(expected),
            "{case}, pass {pass}: leaves"
        );
        assert_eq!(
            after.leaves.len(),
            twin.leaves.len(),
            "{case}, pass {pass}: a leaf twice"
        );
        let words: BTreeMap<Place, u32> = after
            .leaves
            .iter()
            .map(|leaf| leaf.place())
            .zip(after.states.iter().copied())
            .collect();
        for (place, word) in &words {
            assert_eq!(
                word & state::PAIR != 0,
                twin.is_blocked(*place),
                "{case}, pass {pass}: pair flag of {place:?}"
            );
        }
        for (place, asked) in &requests {
            // What was asked is published, unless the leaf has changed or wishes more.
            let published = words.get(place).map(|word| state::wish(*word));
            assert!(
                published.is_none_or(|wish| wish >= *asked),
                "{case}, pass {pass}: {asked} of {place:?} is lost: {published:?}"
            );
        }
        *before = after;
    }
}

fn jumps(surface: &Arc<dyn Surface>, settings: Settings, random: &mut Random, case: &str, tally: &mut Tally) {
    let mut world = World::new(surface, settings);
    let mut last = world.pass(&random_view(random, surface.as_ref()));
    for jump in 0..3 {
        let view = random_view(random, surface.as_ref());
        let passes = 1 + random.below(14);
        follow(
            &mut world,
            &mut last,
            &view,
            passes,
            tally,
            &format!("{case}, jump {jump}"),
        );
    }
    assert_eq!(findings(surface.topology(), &last), [], "{case}");
}

fn random_settings(random: &mut Random, roots: u32) -> Settings {
    let metric = if random.below(2) == 0 {
        Metric::Edge {
            pixels: random.pick(&[10.0, 25.0, 60.0]),
        }
    } else {
        Metric::Distance {
            factor: random.pick(&[0.02, 0.05, 0.1]),
        }
    };
    let starved = roots + 1 + random.below(20);
    let capacity = random.pick(&[starved, 300.max(roots), 1500, 20_000]);
    Settings {
        capacity,
        guard_factor: random.pick(&[1.0, 0.125]),
        max_level: random.pick(&[6, 9, 31]),
        ..settings(metric)
    }
}

#[test]
fn gpu_and_twin_have_the_same_leaves_after_every_pass_on_random_meshes() {
    let mut tally = Tally::default();
    for seed in 0..24 {
        let mut random = Random(1000 + seed);
        let surface = surfaces::flat(&meshes::random(seed));
        let settings = random_settings(&mut random, surface.topology().half_edge_count());
        jumps(&surface, settings, &mut random, &format!("seed {seed}"), &mut tally);
    }
    println!("{tally:?}");
    assert!(
        tally.splits > 1000 && tally.merges > 100 && tally.requests > 100 && tally.starved > 100,
        "{tally:?}"
    );
}

#[test]
fn gpu_and_twin_have_the_same_leaves_after_every_pass_on_surfaces_of_every_kind() {
    let mut tally = Tally::default();
    for (seed, (name, surface)) in (0..).zip(surfaces::all()) {
        let mut random = Random(seed);
        for capacity in [surface.topology().half_edge_count() + 7, 1500] {
            let settings = Settings {
                capacity,
                ..settings(Metric::Edge { pixels: 20.0 })
            };
            jumps(
                &surface,
                settings,
                &mut random,
                &format!("{name}, capacity {capacity}"),
                &mut tally,
            );
        }
    }
    println!("{tally:?}");
}
