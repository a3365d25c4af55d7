//! Leaves that are drawn two as one triangle where the metric is satisfied with that: as the f64 twin says, and without a crack.

use crate::random::Random;
use crate::snapshot::{drawn_slots, findings};
use crate::surfaces;
use crate::watertight::{check, draw};
use crate::world::{World, random_view, settings, size_of_box};
use glam::DVec3;
use keyleaf::key::Place;
use keyleaf::read_back::Snapshot;
use keyleaf::{BackFaces, Frame, Metric, Pairs, Settings, Threshold, View};

fn wished(metric: Metric, k: u32) -> Settings {
    Settings {
        base_grid: k,
        max_level: 31 - k,
        capacity: 4000,
        pairs: Pairs::Wished,
        ..settings(metric)
    }
}

/// Metric over threshold of the pair that a leaf may be half of, with the scale that the GPU got. Twin of `pairs_wished.wgsl`.
fn pair_wish(world: &World, view: &View, pressure: i32, leaf: &Place) -> Option<f64> {
    let settings = world.quadtree.settings();
    let size = settings
        .metric
        .size(settings.base_grid)
        .of_pair(world.surface.as_ref(), leaf)?;
    let frame = Frame::new(view, world.quadtree.world_from_object(), DVec3::ZERO, settings);
    let between = world.surface.drawn(leaf.at(0, 0)).position;
    let distance = if frame.without_distance == 1 {
        1.0
    } else {
        between.distance(view.eye).max(frame.near.into())
    };
    let pressure = (-f64::from(pressure) / 16.0).exp2();
    Some(size * f64::from(frame.wish_scale) * pressure / distance)
}

const METRICS: [Metric; 6] = [
    Metric::Edge { pixels: 30.0 },
    Metric::Distance { factor: 0.06 },
    Metric::LocalArea { pixels: 60.0 },
    Metric::Deviation { pixels: 1.0 },
    Metric::DistanceTest(Threshold::Pixels(1.0)),
    Metric::FlatTest(Threshold::Pixels(1.0)),
];

#[test]
fn free_leaves_are_pairs_where_the_f64_twin_says_so_and_nothing_cracks() {
    let (mut pairs, mut others, mut near) = (0, 0, 0);
    for (seed, (name, surface)) in (0..).zip(surfaces::all()) {
        // Bounds of f32 heights and texels are bounds, not numbers to compare.
        let is_exact = ![
            "cube with texture",
            "height field",
            "bilinear height field",
            "house with noise",
        ]
        .contains(&name);
        // Every metric on some, the first on all.
        let is_tried = ["house", "sphere", "terrain", "loop tetrahedron"].contains(&name);
        for metric in METRICS.into_iter().take(if is_tried { METRICS.len() } else { 1 }) {
            let mut world = World::new(&surface, wished(metric, 0));
            let mut random = Random(300 + seed);
            for passes in [14, 2] {
                let view = random_view(&mut random, surface.as_ref());
                // An update goes by the pressure of the one before.
                let pressure = world.passes(&view, passes - 1).control.pressure;
                let snapshot = world.pass(&view);
                let case = format!("{name}, {}, {passes} passes", metric.name());
                assert_eq!(findings(surface.topology(), &snapshot), [], "{case}");
                for (slot, leaf) in snapshot.leaves.iter().enumerate() {
                    if !snapshot.is_free(slot) {
                        continue;
                    }
                    let wish = pair_wish(&world, &view, pressure, &leaf.place()).expect("a pair");
                    if (wish - 1.0).abs() < 1e-3 {
                        near += 1;
                    } else if is_exact {
                        assert_eq!(snapshot.is_pair(slot), wish < 1.0, "{case}: {wish} of {leaf:?}");
                    }
                    let count = if snapshot.is_pair(slot) {
                        &mut pairs
                    } else {
                        &mut others
                    };
                    *count += 1;
                }
            }
        }
    }
    println!("{pairs} leaves in pairs, {others} free ones that are not, {near} at the threshold");
    assert!(
        pairs > 2_000 && others > 2_000 && near < others / 50,
        "{pairs}, {others}, {near}"
    );
}

#[test]
fn pairs_of_any_base_grid_meet_bit_by_bit() {
    for (seed, (name, surface)) in (0..).zip(surfaces::all()) {
        for k in 0..3 {
            let mut world = World::new(&surface, wished(Metric::Edge { pixels: 30.0 }, k));
            let mut random = Random(700 + 10 * seed + u64::from(k));
            for passes in [12, 1] {
                let view = random_view(&mut random, surface.as_ref());
                let snapshot = world.passes(&view, passes);
                let drawn = draw(&world, &snapshot);
                check(
                    surface.topology(),
                    &drawn,
                    &format!("{name}, base grid {k}, {passes} passes"),
                );
            }
        }
    }
}

/// How far the drawn triangles are from the surface, at most, in pixels: at random points of each.
fn farthest(world: &World, view: &View, snapshot: &Snapshot, random: &mut Random) -> (f64, usize) {
    let surface = world.surface.as_ref();
    let (mut farthest, mut free_pairs) = (0.0f64, 0);
    for &slot in &snapshot.visible {
        let place = snapshot.leaves[slot as usize].place();
        let Some(corners) = place.drawn(snapshot.is_pair(slot as usize)) else {
            continue;
        };
        free_pairs += usize::from(snapshot.is_pair(slot as usize) && snapshot.is_free(slot as usize));
        let positions = corners.map(|corner| surface.drawn(corner).position);
        for _ in 0..4 {
            let [u, v] = [random.unit(), random.unit()];
            let [u, v] = if u + v > 1.0 { [1.0 - u, 1.0 - v] } else { [u, v] };
            let weights = [1.0 - u - v, u, v];
            let [a, b] = [u, v].map(|part| (part * f64::from(place.unit())) as u32);
            let at = if snapshot.is_pair(slot as usize) {
                place.at_of_pair(a, b)
            } else {
                place.at(a, b)
            };
            let on = surface.drawn(at).position;
            let flat: DVec3 = positions.iter().zip(weights).map(|(&p, w)| p * w).sum();
            let pixels = view.pixels_per_unit() / on.distance(view.eye);
            farthest = farthest.max(on.distance(flat) * pixels);
        }
    }
    (farthest, free_pairs)
}

/// `deviation` is a promise: pairs keep it, and take fewer triangles.
#[test]
fn pairs_keep_the_promise_of_the_deviation_with_fewer_triangles() {
    let (mut all, mut pairs_of_roots) = ([0, 0], 0);
    for (name, surface) in [surfaces::patches(), surfaces::subdivided()]
        .concat()
        .into_iter()
        .step_by(2)
    {
        let mut random = Random(40);
        // From afar roots are pairs as well.
        for diagonals in [1.5, 1.5, 300.0] {
            let (low, high) = surface.bounding_box();
            let size = (high - low).length();
            let towards = random.point((DVec3::NEG_ONE, DVec3::ONE)).normalize();
            let view = View::look_at(
                (low + high) / 2.0 + diagonals * size * towards,
                (low + high) / 2.0,
                0.9,
                1e-3,
                glam::UVec2::new(640, 480),
            );
            for pixels in [2.0, 0.7] {
                let metric = Metric::Deviation { pixels };
                for (pairs, triangles) in Pairs::ALL.into_iter().zip(&mut all) {
                    let settings = Settings {
                        pairs,
                        capacity: 100_000,
                        ..wished(metric, 0)
                    };
                    let mut world = World::new(&surface, settings);
                    let snapshot = world.passes(&view, 20);
                    let (farthest, free) = farthest(&world, &view, &snapshot, &mut random);
                    // The distance is that of the vertex between the pairs, not that of the farthest triangle.
                    let pixels = f64::from(pixels * snapshot.statistics.threshold_factor);
                    assert!(
                        farthest < 1.1 * pixels,
                        "{name}: {farthest} of {pixels} px, {free} pairs"
                    );
                    *triangles += snapshot.visible.len();
                    let is_of_roots = |&&slot: &&u32| {
                        let slot = slot as usize;
                        snapshot.leaves[slot].place().level == 0 && snapshot.is_pair(slot)
                    };
                    pairs_of_roots += snapshot.visible.iter().filter(is_of_roots).count();
                }
            }
        }
    }
    println!(
        "{} triangles with forced pairs, {} with wished ones; {pairs_of_roots} pairs of roots",
        all[0], all[1]
    );
    assert!(
        all[1] * 10 < all[0] * 8 && pairs_of_roots > 10,
        "{all:?}, {pairs_of_roots}"
    );
}

/// Far away a face with four corners is two triangles, as one with three is three; near by nothing cracks on the way to that.
#[test]
fn faces_with_four_corners_are_two_triangles_far_away() {
    let mut faces_of_two = 0;
    for (seed, (name, surface)) in (0..).zip(surfaces::all()) {
        let topology = surface.topology();
        let corners = |face| topology.corner_count(face) as usize;
        let fewest = |face| if corners(face) == 4 { 2 } else { corners(face) };
        let (low, high) = surface.bounding_box();
        let (middle, size) = ((low + high) / 2.0, (high - low).length());
        let mut random = Random(900 + seed);
        let towards = random.point((DVec3::NEG_ONE, DVec3::ONE)).normalize();
        for (k, back_faces) in [(0, BackFaces::Drawn), (1, BackFaces::Leaves)] {
            let settings = Settings {
                back_faces,
                ..wished(Metric::Edge { pixels: 30.0 }, k)
            };
            let mut world = World::new(&surface, settings);
            for (times, passes) in [(1e4, 6), (10.0, 3), (0.6, 8), (1e4, 40)] {
                let from = middle + times * size * towards;
                let view = View::look_at(from, middle, 0.9, 1e-3, glam::UVec2::new(640, 480));
                let snapshot = world.passes(&view, passes);
                let case = format!("{name}, base grid {k}, {times} diagonals away");
                assert_eq!(findings(topology, &snapshot), [], "{case}");
                check(topology, &draw(&world, &snapshot), &case);
            }
            let snapshot = world.snapshot();
            assert_eq!(snapshot.leaves.len(), topology.half_edge_count() as usize, "{name}");
            let drawn = drawn_slots(&snapshot).len();
            assert_eq!(drawn, (0..topology.face_count()).map(fewest).sum::<usize>(), "{name}");
            if back_faces == BackFaces::Drawn {
                assert_eq!(snapshot.visible.len(), drawn, "{name}");
            }
            faces_of_two += (0..topology.face_count()).filter(|&face| corners(face) == 4).count();
        }
    }
    assert!(faces_of_two > 50, "{faces_of_two}");
}
/// No point of a pair of roots is farther from its triangle than the size of the pair says.
#[test]
fn the_deviation_of_pairs_of_roots_is_bounded() {
    let mut faces = 0;
    for (seed, (name, surface)) in (0..).zip(surfaces::all()) {
        let mut random = Random(60 + seed);
        let size = Metric::Deviation { pixels: 1.0 }.size(0);
        for face in 0..surface.topology().face_count() {
            let roots = [0, 2].map(|root| Place::of_root(face, root));
            let Some(bound) = size.of_pair(surface.as_ref(), &roots[0]) else {
                continue;
            };
            faces += 1;
            for root in roots {
                let corners = root.drawn(true).expect("an even root");
                let positions = corners.map(|corner| surface.drawn(corner).position);
                for _ in 0..50 {
                    let [u, v] = [random.unit(), random.unit()];
                    let [u, v] = if u + v > 1.0 { [1.0 - u, 1.0 - v] } else { [u, v] };
                    let [a, b] = [u, v].map(|part| (part * f64::from(root.unit())) as u32);
                    let on = surface.drawn(root.at_of_pair(a, b)).position;
                    let flat = positions[0] * (1.0 - u - v) + positions[1] * u + positions[2] * v;
                    let off = on.distance(flat);
                    let rounding = 1e-8 * size_of_box(surface.bounding_box()); // of the coordinates
                    assert!(off <= bound + rounding, "{name}: {off} of {bound}, {root:?}");
                }
            }
        }
    }
    assert!(faces > 20, "{faces}");
}
