//! The wishes that the GPU publishes and the f64 twins of the metrics: they agree to 2^-16, and where they settle differs only by
//! nodes whose metric is that close to the threshold.

use crate::random::Random;
use crate::snapshot::forest;
use crate::surfaces;
use crate::world::{World, places, random_view, settings, size_of_box};
use glam::{DAffine3, DQuat, DVec3, UVec2};
use keyleaf::key::{Forest, Place};
use keyleaf::layout::state;
use keyleaf::surface::{Interpolation, Surface};
use keyleaf::{Metric, Projection, Settings, Threshold, View};
use std::collections::BTreeSet;
use std::sync::Arc;

const TOLERANCE: f64 = 1.0 / 65_536.0;

/// Follows the camera a few passes and compares every wish, requests included. Returns how many were compared.
fn compare(world: &mut World, view: &View, passes: u32, case: &str) -> usize {
    let mut compared = 0;
    let mut before = world.pass(view);
    let surface = Arc::clone(&world.surface);
    let capacity = world.quadtree.settings().capacity as usize;
    for _ in 0..passes {
        let requests = forest(surface.topology(), &before).decide(capacity).requests;
        let pressure = (-f64::from(before.control.pressure) / 16.0).exp2();
        let after = world.pass(view);
        for (leaf, word) in after.leaves.iter().zip(&after.states) {
            let place = leaf.place();
            let requested = requests.get(&place).copied().unwrap_or(0.0);
            let expected = (world.wish(view, &place) * pressure).max(requested.into());
            let published = f64::from(state::wish(*word));
            assert!(
                (published - expected).abs() <= TOLERANCE * expected,
                "{case}: {published} for {expected} of {place:?}"
            );
            compared += 1;
        }
        before = after;
    }
    compared
}

/// A view that is not so near that the f32 distance itself is off by 2^-18.
fn views(random: &mut Random, surface: &dyn Surface) -> Vec<View> {
    let (low, high) = surface.bounding_box();
    let size = size_of_box((low, high));
    let far = |random: &mut Random| {
        let mut view = random_view(random, surface);
        let outward = (view.eye - (low + high) / 2.0).try_normalize().unwrap_or(DVec3::Y);
        view.eye += outward * size;
        view
    };
    let mut views: Vec<View> = (0..4).map(|_| far(random)).collect();
    let orthographic = Projection::Orthographic {
        height: size / 3.0,
        near: -size,
        far: 4.0 * size,
    };
    views.push(View {
        projection: orthographic,
        ..views[0]
    });
    views
}

#[test]
fn published_wishes_are_those_of_the_f64_twin_to_two_to_the_minus_16() {
    let mut compared = 0;
    for (name, surface) in surfaces::all() {
        for metric in [Metric::Distance { factor: 0.06 }, Metric::Edge { pixels: 16.0 }] {
            // A bound of f32 heights is a bound, not a number to compare: bounds of displaced and mapped surfaces are rounded up.
            let is_exact = metric.name() == "distance"
                || [
                    "cube",
                    "tetrahedron",
                    "house",
                    "open mesh",
                    "terrain",
                    "house with noise",
                ]
                .contains(&name);
            if !is_exact {
                continue;
            }
            let settings = Settings {
                guard_factor: 1.0,
                ..settings(metric)
            };
            let placed = DAffine3::from_scale_rotation_translation(
                DVec3::splat(1.7),
                DQuat::from_rotation_z(0.4),
                DVec3::new(0.3, -0.2, 0.1),
            );
            for transform in [DAffine3::IDENTITY, placed] {
                let mut world = World::placed(&surface, transform, settings);
                for (i, view) in views(&mut Random(5), surface.as_ref()).into_iter().enumerate() {
                    compared += compare(&mut world, &view, 5, &format!("{name}, {}, view {i}", metric.name()));
                }
            }
        }
    }
    assert!(compared > 10_000, "{compared}");
}

/// The nodes that are split when these are the leaves.
fn split(leaves: impl IntoIterator<Item = Place>) -> BTreeSet<Place> {
    leaves
        .into_iter()
        .flat_map(|leaf| leaf.ancestors().collect::<Vec<_>>())
        .collect()
}

#[test]
fn settled_leaves_differ_from_the_f64_twins_only_where_the_metric_is_at_the_threshold() {
    let surfaces: [(&str, Arc<dyn Surface>); 3] = [
        ("house", surfaces::flat(&crate::meshes::house())),
        ("open mesh", surfaces::flat(&crate::meshes::open())),
        ("height field", surfaces::height_field(33, Interpolation::Bicubic)),
    ];
    for (name, surface) in surfaces {
        for metric in [Metric::Distance { factor: 0.1 }, Metric::Edge { pixels: 24.0 }] {
            if name == "height field" && metric.name() == "edge" {
                continue; // sizes are bounds there: see above
            }
            let mut world = World::new(
                &surface,
                Settings {
                    guard_factor: 1.0,
                    ..settings(metric)
                },
            );
            for view in views(&mut Random(9), surface.as_ref()) {
                let snapshot = world.passes(&view, 40);
                assert_eq!(snapshot.control.starved, 0);
                let settled = places(&snapshot);
                let twin = Forest::new(surface.topology(), 31);
                let with = |factor: f64| split(twin.coarsest_balanced(|node| world.wish(&view, node) * factor));
                let (least, most) = (with(1.0 - TOLERANCE), with(1.0 + TOLERANCE));
                let found = split(settled.iter().copied());
                assert!(
                    least.is_subset(&found) && found.is_subset(&most),
                    "{name}, {}",
                    metric.name()
                );
            }
        }
    }
}

/// What samples of an f32 surface can be off by, in units of its largest coordinate.
const SAMPLE_ERROR: f64 = 32.0 / 16_777_216.0;

#[test]
fn sampled_metrics_agree_with_their_twins_up_to_the_rounding_of_the_samples() {
    let metrics = [
        Metric::Deviation { pixels: 0.5 },
        Metric::Boundary {
            pixels: 60.0,
            boundary_pixels: 15.0,
        },
        Metric::LocalArea { pixels: 60.0 },
        Metric::LinearApproximation { pixels: 0.5 },
        Metric::DistanceTest(Threshold::Pixels(0.5)),
        Metric::DistanceTest(Threshold::Units(0.01)),
        Metric::FlatTest(Threshold::Pixels(0.5)),
        Metric::FlatTest(Threshold::Units(0.99)),
        Metric::LengthTest(Threshold::Pixels(30.0)),
        Metric::LengthTest(Threshold::Units(0.1)),
    ];
    for (name, surface) in surfaces::patches() {
        let (low, high) = surface.bounding_box();
        let largest = low.abs().max(high.abs()).max_element();
        for metric in metrics {
            // Without the guard band: whether a ball touches it is a matter of rounding.
            let settings = Settings {
                guard_factor: 1.0,
                ..settings(metric)
            };
            let mut world = World::new(&surface, settings);
            for view in views(&mut Random(5), surface.as_ref()) {
                let snapshot = world.passes(&view, 12);
                assert_eq!(snapshot.control.lost, 0);
                let pressure = (-f64::from(snapshot.control.pressure) / 16.0).exp2();
                for (leaf, word) in snapshot.leaves.iter().zip(&snapshot.states).step_by(7) {
                    let place = leaf.place();
                    let truth = world.wish(&view, &place) * pressure;
                    let published = f64::from(state::wish(*word));
                    // A request may raise a wish.
                    let error = (truth - published).max(if published <= 1.0 { published - truth } else { 0.0 });
                    // The angle of the flat test is off by the rounding of a sample over the length of the edge.
                    let length = surface.bound(&place).size;
                    let sample = match metric {
                        Metric::FlatTest(Threshold::Units(_)) => {
                            let angle = SAMPLE_ERROR * largest / length;
                            4.0 * (2.0 * metric.size(settings.base_grid).of(surface.as_ref(), &place)).sqrt() * angle
                                + angle * angle
                        }
                        _ => SAMPLE_ERROR * largest,
                    };
                    let room = TOLERANCE * truth + world.wish_of_size(&view, &place, sample) * pressure;
                    assert!(
                        error <= room,
                        "{name}, {}: {published} for {truth} of {place:?}",
                        metric.name()
                    );
                }
            }
        }
    }
}

#[test]
fn each_pass_of_gpu_and_f64_twin_alike_unless_the_metric_is_at_the_threshold() {
    let surface = surfaces::flat(&crate::meshes::cube());
    let settings = Settings {
        guard_factor: 1.0,
        ..settings(Metric::Distance { factor: 0.08 })
    };
    for view in views(&mut Random(21), surface.as_ref()) {
        let mut world = World::new(&surface, settings);
        let mut twin = Forest::new(surface.topology(), 31);
        world.frame(&view);
        twin.publish(|node| world.wish(&view, node));
        for pass in 0..20 {
            let found = places(&world.pass(&view));
            twin.update(|node| world.wish(&view, node), settings.capacity as usize);
            let expected: BTreeSet<Place> = twin.leaves.keys().copied().collect();
            let at_threshold = |place: &Place| {
                place
                    .ancestors()
                    .chain([*place])
                    .any(|node| (world.wish(&view, &node) - 1.0).abs() <= TOLERANCE)
            };
            let differing: Vec<&Place> = found
                .symmetric_difference(&expected)
                .filter(|place| !at_threshold(place))
                .collect();
            assert!(differing.is_empty(), "pass {pass}: {differing:?}");
            if found != expected {
                break; // histories have parted at the threshold
            }
        }
    }
}

#[test]
fn the_distance_metric_gives_the_level_of_its_formula() {
    // Khoury 2.1: LoD = -log2(distance tan(fovy / 2) / (sqrt 2 factor)); a leaf is the first level that is not below it.
    let surface = surfaces::flat(&crate::meshes::cube());
    let (factor, fov, distance) = (0.5f32, 0.9f64, 40.0f64);
    let view = View::look_at(
        DVec3::new(0.5, 0.5, distance),
        DVec3::splat(0.5),
        fov,
        0.1,
        UVec2::new(200, 200),
    );
    let mut world = World::new(
        &surface,
        Settings {
            guard_factor: 1.0,
            ..settings(Metric::Distance { factor: factor * 16.0 })
        },
    );
    let snapshot = world.passes(&view, 20);
    let lod = |d: f64| -(d * (fov / 2.0).tan() / (std::f64::consts::SQRT_2 * f64::from(factor) * 16.0)).log2();
    for leaf in &snapshot.leaves {
        let place = leaf.place();
        let centre = surface.bound(&place).centre;
        let here = lod(centre.distance(view.eye)).ceil();
        // Balance may ask for more, never for less.
        assert!(f64::from(place.level) >= here, "{place:?}: {here}");
        assert!(f64::from(place.level) <= here + 2.0, "{place:?}: {here}");
    }
}
