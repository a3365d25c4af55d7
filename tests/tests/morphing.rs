//! Vertices that slide from the edges that they divide to the surface: where the f64 twin puts them, without a gap, without a jump.

use crate::gpu::gpu;
use crate::random::Random;
use crate::surfaces;
use crate::watertight::{Drawn, check, draw};
use crate::world::{World, random_view, settings, size_of_box};
use glam::{DAffine3, DQuat, DVec2, DVec3, UVec2, Vec3};
use keyleaf::key::{RootPoint, Site};
use keyleaf::read_back::Snapshot;
use keyleaf::surface::{Geomorph, Insertion, Surface};
use keyleaf::{KeyleafError, Metric, Morph, Pairs, Settings, View};
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

fn morphing(metric: Metric, k: u32) -> Settings {
    Settings {
        base_grid: k,
        max_level: 31 - k,
        capacity: 4000,
        morph: Morph::Geomorph,
        ..settings(metric)
    }
}

fn all() -> Vec<(&'static str, Arc<dyn Surface>)> {
    [surfaces::all(), surfaces::patches(), surfaces::subdivided()].concat()
}

/// The twin under the pressure that the device has.
fn twin(world: &World, view: &View, snapshot: &Snapshot) -> Geomorph {
    let plain = view.geomorph(world.quadtree.world_from_object(), world.quadtree.settings());
    let pressure = (-f64::from(snapshot.control.pressure) / 16.0).exp2();
    Geomorph {
        wish_scale: plain.wish_scale * pressure,
        wish_when_near: plain.wish_when_near * pressure,
        ..plain
    }
}

/// Compares every vertex; how many of them are on their way.
fn compare(world: &World, twin: &Geomorph, drawn: &Drawn, case: &str) -> usize {
    let surface = world.surface.as_ref();
    let origin = world.quadtree.origin();
    let size = size_of_box(surface.bounding_box());
    let mut sliding = 0;
    for (_, at, position, normal) in &drawn.vertices {
        let expected = twin.drawn(surface, *at);
        let arrived = surface.drawn(*at);
        let insertion = Insertion::of(surface.topology(), *at, twin.base_grid);
        let part = insertion.map_or(1.0, |insertion| twin.part(surface, &insertion, arrived.position));
        let way = insertion_way(surface, *at, twin.base_grid, arrived.position);
        let found = Vec3::from(*position).as_dvec3() + origin;
        let off = found.distance(expected.position);
        assert!(
            off <= 1e-5 * size + 2e-3 * way,
            "{case}: {off} at {at:?}, {part} of {way}"
        );
        if part > 0.0 && part < 1.0 && way > 1e-3 * size {
            sliding += 1;
        }
        assert!((Vec3::from(*normal).length() - 1.0).abs() < 1e-5, "{case}: {normal:?}");
    }
    sliding
}

/// How far a vertex of the surface is from the edge that it divides.
fn insertion_way(surface: &dyn Surface, at: RootPoint, k: u32, position: DVec3) -> f64 {
    Insertion::of(surface.topology(), at, k).map_or(0.0, |insertion| {
        let [from, to] = insertion.ends.map(|end| surface.drawn(end).position);
        from.midpoint(to).distance(position)
    })
}

#[test]
fn vertices_are_where_the_f64_twin_puts_them_and_leave_no_gap() {
    let placed = DAffine3::from_scale_rotation_translation(
        DVec3::splat(1.7),
        DQuat::from_rotation_z(0.4),
        DVec3::new(0.3, -0.2, 0.1),
    );
    let mut sliding = 0;
    for (seed, (name, surface)) in (0..).zip(all()) {
        for k in 0..3 {
            let pairs = Pairs::ALL[(seed + u64::from(k)) as usize % 2];
            let settings = Settings {
                pairs,
                ..morphing(Metric::Edge { pixels: 30.0 }, k)
            };
            let mut world = World::placed(&surface, placed, settings);
            let mut random = Random(100 + 10 * seed + u64::from(k));
            for passes in [12, 2] {
                let view = random_view(&mut random, surface.as_ref());
                let snapshot = world.passes(&view, passes);
                let case = format!("{name}, base grid {k}, pairs {}, {passes} passes", pairs.name());
                let drawn = draw(&world, &snapshot);
                check(surface.topology(), &drawn, &case);
                sliding += compare(&world, &twin(&world, &view, &snapshot), &drawn, &case);
            }
        }
    }
    println!("{sliding} vertices on their way");
    assert!(sliding > 1000, "{sliding}");
}

#[test]
fn every_metric_that_halves_moves_vertices() {
    let surface = surfaces::flat(&crate::meshes::house());
    let surface = [surface, surfaces::terrain()];
    for metric in [
        Metric::Edge { pixels: 30.0 },
        Metric::LocalArea { pixels: 30.0 },
        Metric::Boundary {
            pixels: 30.0,
            boundary_pixels: 10.0,
        },
    ] {
        for surface in &surface {
            let mut world = World::new(surface, morphing(metric, 1));
            let view = random_view(&mut Random(3), surface.as_ref());
            let snapshot = world.passes(&view, 12);
            let drawn = draw(&world, &snapshot);
            check(surface.topology(), &drawn, metric.name());
            compare(&world, &twin(&world, &view, &snapshot), &drawn, metric.name());
        }
    }
}

/// The triangles of each root, by the places of their corners in it.
type Roots<'a> = HashMap<(u32, u32), Vec<[&'a (Site, RootPoint, [f32; 3], [f32; 3]); 3]>>;

fn by_root(drawn: &Drawn) -> Roots<'_> {
    let mut roots = Roots::new();
    for triangle in &drawn.triangles {
        let corners = triangle.map(|corner| &drawn.vertices[corner]);
        let RootPoint { face, root, .. } = corners[0].1;
        roots.entry((face, root)).or_default().push(corners);
    }
    roots
}

/// Where the drawn triangles are at a point of the surface.
fn drawn_at(roots: &Roots<'_>, at: RootPoint) -> Option<DVec3> {
    let flat = |p: RootPoint| DVec2::new(p.x.into(), p.y.into());
    roots.get(&(at.face, at.root))?.iter().find_map(|corners| {
        let [a, b, c] = corners.map(|corner| flat(corner.1));
        let area = (b - a).perp_dot(c - a);
        let [u, v] = [
            (flat(at) - a).perp_dot(c - a) / area,
            (b - a).perp_dot(flat(at) - a) / area,
        ];
        let positions = corners.map(|corner| Vec3::from(corner.2).as_dvec3());
        let is_inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
        is_inside.then(|| positions[0] * (1.0 - u - v) + positions[1] * u + positions[2] * v)
    })
}

/// How far the drawn surface of `before` is from the vertices of `after`, at most, in pixels.
fn jump(after: &Drawn, before: &Drawn, pixels: impl Fn(DVec3, f64) -> f64) -> f64 {
    let roots = by_root(before);
    let known: HashSet<(RootPoint, [u32; 3])> = before
        .vertices
        .iter()
        .map(|(_, at, position, _)| (*at, position.map(f32::to_bits)))
        .collect();
    let moved = after
        .vertices
        .iter()
        .filter(|(_, at, position, _)| !known.contains(&(*at, position.map(f32::to_bits))));
    moved
        .filter_map(|(_, at, position, _)| {
            let position = Vec3::from(*position).as_dvec3();
            Some(pixels(position, position.distance(drawn_at(&roots, *at)?)))
        })
        .fold(0.0, f64::max)
}

/// The largest jump and how many changes there were, while a camera flies by in small steps and the leaves settle at each.
fn flight(surface: &Arc<dyn Surface>, pixels: f32, k: u32, morph: Morph, pairs: Pairs) -> (f64, usize) {
    let settings = Settings {
        morph,
        pairs,
        capacity: 20_000,
        ..morphing(
            Metric::Edge {
                pixels: pixels / (1 << k) as f32, // the same leaves, whatever the grid
            },
            k,
        )
    };
    let mut world = World::new(surface, settings);
    let (low, high) = surface.bounding_box();
    let size = size_of_box((low, high));
    let view_at = |step: u32| {
        let along = f64::from(step) / 40.0;
        let eye = low.lerp(high, 0.5) + size * DVec3::new(0.9 - 0.02 * along, 0.6, 0.7 - 0.03 * along);
        View::look_at(eye, low.lerp(high, 0.5), 0.9, 1e-3 * size, UVec2::new(640, 400))
    };
    let mut before: Option<Drawn> = None;
    let (mut largest, mut changes) = (0.0f64, 0);
    for step in 0..40 {
        let view = view_at(step);
        let snapshot = world.passes(&view, if step == 0 { 30 } else { 6 });
        assert_eq!(snapshot.control.pressure, 0);
        let drawn = draw(&world, &snapshot);
        if let Some(before) = &before {
            let pixels =
                |at: DVec3, length: f64| length * view.pixels_per_unit() / at.distance(view.eye).max(1e-3 * size);
            largest = largest
                .max(jump(&drawn, before, pixels))
                .max(jump(before, &drawn, pixels));
            changes += drawn.vertices.len().abs_diff(before.vertices.len());
        }
        before = Some(drawn);
    }
    (largest, changes)
}

#[test]
fn no_split_and_no_merge_is_seen() {
    for (name, surface, pixels) in [
        ("terrain", surfaces::terrain(), 60.0),
        ("cube with noise", surfaces::by_noise(&crate::meshes::cube()), 30.0),
    ] {
        let forced = (0..3).map(|k| (k, Pairs::Forced));
        let wished = (0..2).map(|k| (k, Pairs::Wished));
        for (k, pairs) in forced.chain(wished) {
            let (without, _) = flight(&surface, pixels, k, Morph::None, pairs);
            let (with, changes) = flight(&surface, pixels, k, Morph::Geomorph, pairs);
            let name = format!("{name}, base grid {k}, pairs {}", pairs.name());
            println!("{name}: jumps of {without:.3} pixels without, {with:.4} with, {changes} changes");
            assert!(without > 0.1 && changes > 20, "{name}: {without}, {changes}");
            assert!(with < 0.02 * without, "{name}: {with} against {without}");
        }
    }
}

#[test]
fn seen_from_elsewhere_vertices_stay_where_the_refining_view_put_them() {
    let surface = surfaces::terrain();
    let mut world = World::new(&surface, morphing(Metric::Edge { pixels: 30.0 }, 1));
    let mut random = Random(8);
    let [view, other] = [0, 1].map(|_| random_view(&mut random, surface.as_ref()));
    let snapshot = world.passes(&view, 12);
    let positions = |world: &World| -> Vec<DVec3> {
        let drawn = draw(world, &snapshot);
        let origin = world.quadtree.origin();
        drawn
            .vertices
            .iter()
            .map(|v| Vec3::from(v.2).as_dvec3() + origin)
            .collect()
    };
    let before = positions(&world);
    world.quadtree.look_from(&gpu().queue, &other);
    let after = positions(&world);
    let size = size_of_box(surface.bounding_box());
    let moved = before
        .iter()
        .zip(&after)
        .map(|(a, b)| a.distance(*b))
        .fold(0.0, f64::max);
    assert!(moved <= 1e-6 * size, "{moved}");
}

#[test]
fn metrics_that_do_not_halve_are_refused() {
    for metric in [
        Metric::Distance { factor: 1.0 },
        Metric::Deviation { pixels: 1.0 },
        Metric::LinearApproximation { pixels: 1.0 },
    ] {
        let error = morphing(metric, 0).validate().unwrap_err();
        assert!(
            matches!(error, KeyleafError::Setting { setting: "morph", .. }),
            "{error}"
        );
        assert!(error.to_string().contains(metric.name()), "{error}");
    }
}
