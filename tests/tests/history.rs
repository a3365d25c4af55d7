//! One view, one set of keys: unstarved, where the quadtree settles does not depend on what was before.

use crate::random::Random;
use crate::snapshot::findings;
use crate::surfaces;
use crate::world::{World, places, random_view, settings, size_of_box, uniform};
use glam::{DVec3, UVec2};
use keyleaf::key::Place;
use keyleaf::surface::Surface;
use keyleaf::{Metric, Settings, View};
use std::collections::BTreeSet;
use std::sync::Arc;

/// A view of some part of a surface from near by.
fn goal(surface: &dyn Surface) -> View {
    let (low, high) = surface.bounding_box();
    let size = size_of_box((low, high));
    let target = surface.point(surface.face_coord(0, 0.4, 0.35).expect("a point of face 0"));
    View::look_at(
        target + DVec3::new(0.03, 0.08, 0.05) * size,
        target,
        1.0,
        1e-4 * size,
        UVec2::new(400, 300),
    )
}

/// Settles within 2 * depth + 8 passes and stays: the depth is that of the deepest leaf before or after.
fn settle(world: &mut World, view: &View, depth_before: u32, case: &str) -> BTreeSet<Place> {
    let mut last_change = 0;
    let mut snapshot = world.pass(view);
    for pass in 2..=100 {
        snapshot = world.pass(view);
        assert_eq!(snapshot.control.starved, 0, "{case}: the test wants room");
        if snapshot.control.last_splits + snapshot.control.last_merges > 0 {
            last_change = pass;
        }
        if pass > last_change + 6 {
            break;
        }
    }
    let depth = snapshot
        .leaves
        .iter()
        .map(|leaf| leaf.place().level)
        .max()
        .unwrap_or(0)
        .max(depth_before);
    assert!(
        last_change <= 2 * depth + 8,
        "{case}: still changing in pass {last_change}, depth {depth}"
    );
    assert_eq!(findings(world.surface.topology(), &snapshot), [], "{case}");
    let settled = places(&snapshot);
    let later = world.passes(view, 5);
    assert_eq!((later.control.last_splits, later.control.last_merges), (0, 0), "{case}");
    assert!(places(&later) == settled, "{case}: it moved again");
    settled
}

fn deepest(world: &World) -> u32 {
    world
        .snapshot()
        .leaves
        .iter()
        .map(|leaf| leaf.place().level)
        .max()
        .unwrap_or(0)
}

fn check(name: &str, surface: &Arc<dyn Surface>, settings: Settings) {
    let view = goal(surface.as_ref());
    let fresh = settle(
        &mut World::new(surface, settings),
        &view,
        0,
        &format!("{name}, from the roots"),
    );
    assert!(fresh.len() > 100, "{name}: {} leaves", fresh.len());

    let mut world = World::new(surface, settings);
    world.set_leaves(&uniform(surface.as_ref(), 3));
    assert!(
        settle(&mut world, &view, 3, &format!("{name}, from level 3")) == fresh,
        "{name}, from level 3"
    );

    let mut random = Random(31);
    for round in 0..2 {
        let elsewhere = random_view(&mut random, surface.as_ref());
        let passes = 3 + random.below(20);
        world.passes(&elsewhere, passes);
        let depth = deepest(&world);
        let case = format!("{name}, round {round}");
        assert!(settle(&mut world, &view, depth, &case) == fresh, "{case}");
    }

    let leaves: Vec<Place> = fresh.iter().rev().copied().collect();
    world.set_leaves(&leaves);
    assert!(
        settle(&mut world, &view, 0, &format!("{name}, from the result")) == fresh,
        "{name}, from the result"
    );
}

#[test]
fn any_start_settles_in_the_same_leaves_on_every_surface() {
    for (name, surface) in surfaces::all() {
        check(
            name,
            &surface,
            Settings {
                capacity: 60_000,
                ..settings(Metric::Edge { pixels: 50.0 })
            },
        );
    }
}

#[test]
fn any_start_settles_in_the_same_leaves_with_the_distance_metric_and_a_base_grid() {
    let surface = surfaces::flat(&crate::meshes::house());
    let settings = Settings {
        capacity: 60_000,
        base_grid: 2,
        max_level: 29,
        ..settings(Metric::Distance { factor: 0.3 })
    };
    check("house", &surface, settings);
}

#[test]
fn lowering_the_level_limit_forgets_the_deeper_leaves() {
    let surface = surfaces::flat(&crate::meshes::cube());
    let limited = |max_level| Settings {
        max_level,
        ..settings(Metric::Edge { pixels: 50.0 })
    };
    let view = goal(surface.as_ref());
    let fresh = settle(&mut World::new(&surface, limited(4)), &view, 0, "from the roots");
    let mut world = World::new(&surface, limited(31));
    settle(&mut world, &view, 0, "without limit");
    let depth = deepest(&world);
    world.quadtree.set_settings(limited(4)).expect("in range");
    assert!(settle(&mut world, &view, depth, "limited") == fresh);
}

#[test]
fn two_runs_of_the_same_flight_hold_the_same_leaves_in_every_frame() {
    let surface = surfaces::height_field(33, keyleaf::surface::Interpolation::Bicubic);
    for capacity in [20_000, 400] {
        let settings = Settings {
            capacity,
            ..settings(Metric::Edge { pixels: 24.0 })
        };
        let mut runs = [World::new(&surface, settings), World::new(&surface, settings)];
        let mut random = Random(77);
        for frame in 0..30 {
            let view = random_view(&mut random, surface.as_ref());
            for _ in 0..1 + random.below(4) {
                let [first, second] = runs.each_mut().map(|world| world.pass(&view));
                assert!(places(&first) == places(&second), "frame {frame}, capacity {capacity}");
                let drawn = |s: &keyleaf::read_back::Snapshot| {
                    s.visible
                        .iter()
                        .map(|slot| s.leaves[*slot as usize].place())
                        .collect::<BTreeSet<_>>()
                };
                assert!(
                    drawn(&first) == drawn(&second),
                    "frame {frame}, capacity {capacity}: what is drawn"
                );
            }
        }
    }
}

#[test]
fn two_runs_decide_the_same_in_whatever_slots_the_leaves_are() {
    // The same leaves, given in another order: everything but the slots must be equal.
    let surface = surfaces::flat(&crate::meshes::house());
    let mut leaves = uniform(surface.as_ref(), 2);
    let mut worlds = [
        World::new(&surface, settings(crate::world::EDGE)),
        World::new(&surface, settings(crate::world::EDGE)),
    ];
    worlds[0].set_leaves(&leaves);
    leaves.reverse();
    worlds[1].set_leaves(&leaves);
    let view = goal(surface.as_ref());
    for pass in 0..20 {
        let [first, second] = worlds.each_mut().map(|world| places(&world.pass(&view)));
        assert!(first == second, "pass {pass}");
    }
}
