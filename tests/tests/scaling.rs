//! How many leaves a threshold gives.

use crate::surfaces;
use crate::world::{World, settings};
use glam::{DVec3, UVec2};
use keyleaf::surface::Interpolation;
use keyleaf::{Metric, Settings, View};

#[test]
fn half_the_edge_length_gives_about_four_times_the_leaves() {
    let surface = surfaces::height_field(129, Interpolation::Bicubic);
    let view = View::look_at(
        DVec3::new(120.0, 330.0, -60.0),
        DVec3::new(500.0, 100.0, -500.0),
        1.0,
        1.0,
        UVec2::new(1280, 720),
    );
    let with = |pixels| Settings {
        capacity: 400_000,
        max_level: 25,
        ..settings(Metric::Edge { pixels })
    };
    let mut world = World::new(&surface, with(34.0));
    let mut last: Option<f64> = None;
    for pixels in [34.0, 17.0, 8.5] {
        world.quadtree.set_settings(with(pixels)).expect("in range");
        let snapshot = world.passes(&view, 40);
        assert_eq!(
            (
                snapshot.control.starved,
                snapshot.control.last_splits,
                snapshot.control.last_merges
            ),
            (0, 0, 0)
        );
        let leaves = f64::from(snapshot.control.leaves);
        if let Some(coarser) = last {
            println!(
                "{pixels} pixels: {leaves} leaves, {:.2} times those of twice the length",
                leaves / coarser
            );
            assert!(
                coarser > 10_000.0,
                "the law holds from 10,000 leaves on, here are {coarser}"
            );
            assert!((3.4..=4.6).contains(&(leaves / coarser)), "{coarser} to {leaves}");
        }
        last = Some(leaves);
    }
}

#[test]
fn a_base_grid_draws_edges_of_the_same_length_with_fewer_leaves() {
    let surface = surfaces::height_field(129, Interpolation::Bicubic);
    let view = View::look_at(
        DVec3::new(120.0, 330.0, -60.0),
        DVec3::new(500.0, 100.0, -500.0),
        1.0,
        1.0,
        UVec2::new(1280, 720),
    );
    let leaves = [0u32, 1, 2].map(|base_grid| {
        let settings = Settings {
            capacity: 200_000,
            max_level: 25,
            base_grid,
            ..settings(Metric::Edge { pixels: 24.0 })
        };
        f64::from(World::new(&surface, settings).passes(&view, 40).control.leaves)
    });
    for pair in leaves.windows(2) {
        assert!((3.0..5.0).contains(&(pair[0] / pair[1])), "{leaves:?}");
    }
}

#[test]
fn the_controller_finds_a_target_of_leaves() {
    let surface = surfaces::height_field(65, Interpolation::Bicubic);
    let view = View::look_at(
        DVec3::new(120.0, 330.0, -60.0),
        DVec3::new(500.0, 100.0, -500.0),
        1.0,
        1.0,
        UVec2::new(1280, 720),
    );
    for (pixels, target_leaves) in [(4.0, 6000), (60.0, 6000), (8.0, 500)] {
        let settings = Settings {
            capacity: 40_000,
            max_level: 25,
            target_leaves,
            ..settings(Metric::Edge { pixels })
        };
        let mut world = World::new(&surface, settings);
        world.passes(&view, 250);
        for _ in 0..10 {
            let leaves = f64::from(world.pass(&view).control.leaves) / f64::from(target_leaves);
            assert!(
                (0.8..1.25).contains(&leaves),
                "{leaves} of the target of {target_leaves}, from {pixels} pixels"
            );
        }
    }
}
