//! Leaves that are drawn two as one triangle where the metric is satisfied with that: as the f64 twin says, and without a crack.

use crate::random::Random;
use crate::snapshot::findings;
use crate::surfaces;
use crate::watertight::{check, draw};
use crate::world::{World, random_view, settings};
use glam::DVec3;
use keyleaf::key::{Place, RootPoint};
use keyleaf::read_back::Snapshot;
use keyleaf::{Frame, Metric, Pairs, Settings, Threshold, View};

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
                    let wish = pair_wish(&world, &view, pressure, &leaf.place()).expect("below a root");
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
            let mean = |of: fn(&RootPoint) -> u32| {
                let sum: f64 = corners
                    .iter()
                    .zip(weights)
                    .map(|(corner, w)| w * f64::from(of(corner)))
                    .sum();
                sum.round() as u32
            };
            let [x, y] = [mean(|at| at.x), mean(|at| at.y)];
            let at = RootPoint { x, y, ..corners[0] };
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
    let mut all = [0, 0];
    for (name, surface) in [surfaces::patches(), surfaces::subdivided()]
        .concat()
        .into_iter()
        .step_by(2)
    {
        let mut random = Random(40);
        for _ in 0..2 {
            let (low, high) = surface.bounding_box();
            let size = (high - low).length();
            let towards = random.point((DVec3::NEG_ONE, DVec3::ONE)).normalize();
            let view = View::look_at(
                (low + high) / 2.0 + 1.5 * size * towards,
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
                }
            }
        }
    }
    println!("{} triangles with forced pairs, {} with wished ones", all[0], all[1]);
    assert!(all[1] * 10 < all[0] * 8, "{all:?}");
}
