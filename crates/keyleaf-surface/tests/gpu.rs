//! The WGSL surfaces, run on whatever adapter there is, against their f64 twins. Without an adapter the tests say so and pass.

mod device;
mod fixtures;
mod random;
mod shaders;

use device::{Device, Evaluated, evaluate};
use fixtures::{Fixture, fixtures};
use glam::{DVec3, Vec3};
use keyleaf_key::{ONE, Place, RootPoint, Site, Topology, neighbour};
use keyleaf_surface::Surface;
use random::Random;
use std::collections::HashMap;

const EPSILON: f64 = 1.0 / 16_777_216.0;

fn with_every_surface(check: impl Fn(&Fixture, &dyn Fn(&[RootPoint], &[Place]) -> Evaluated)) {
    let Some(device) = Device::new() else {
        eprintln!("no adapter: skipped");
        return;
    };
    for fixture in fixtures() {
        let tables = fixture.surface.tables(fixture.origin);
        let source = shaders::composed(fixture.surface.shader());
        let words = fixture.surface.topology().gpu_words();
        check(&fixture, &|points, leaves| {
            evaluate(&device, &source, &tables, &words, points, leaves)
        });
    }
}

/// A position relative to the origin.
fn relative(fixture: &Fixture, position: DVec3) -> DVec3 {
    position - fixture.origin
}

#[test]
fn positions_and_frames_agree_with_the_twin() {
    with_every_surface(|fixture, run| {
        let surface = &*fixture.surface;
        let mut random = Random(6);
        let points: Vec<RootPoint> = (0..20_000).map(|_| random.point(surface.topology())).collect();
        let frames = run(&points, &[]).frames;
        let (mut worst, mut worst_angle, mut worst_slope) = (0.0f64, 0.0f64, 0.0f64);
        for (&at, gpu) in points.iter().zip(&frames) {
            let truth = surface.drawn(at);
            assert_eq!(
                gpu.point.to_array().map(f32::to_bits),
                gpu.position.to_array().map(f32::to_bits)
            );
            assert!(
                gpu.point
                    .to_array()
                    .iter()
                    .all(|c| c.is_finite() && c.to_bits() != 0x8000_0000),
                "{}: {gpu:?}",
                fixture.name
            );
            let error = (gpu.point.as_dvec3() - relative(fixture, truth.position))
                .abs()
                .max_element();
            worst = worst.max(error / (EPSILON * fixture.magnitude));
            assert!(
                (gpu.normal.as_dvec3().length() - 1.0).abs() < 1e-6,
                "{}: {gpu:?}",
                fixture.name
            );
            for (gpu, truth) in [(gpu.du, truth.du), (gpu.dv, truth.dv)] {
                worst_slope =
                    worst_slope.max(gpu.as_dvec3().distance(truth) / (truth.length() + fixture.magnitude * 0.01));
            }
            if truth.du.cross(truth.dv).length() >= 1e-3 * truth.du.length() * truth.dv.length() {
                let angle = gpu.normal.as_dvec3().distance(truth.normal);
                worst_angle = worst_angle.max(angle);
            }
        }
        println!(
            "{}: position {worst:.2} eps M, derivative {worst_slope:.1e}, normal {worst_angle:.1e} rad",
            fixture.name
        );
        assert!(worst <= 16.0, "{}: {worst} eps M", fixture.name);
        // Normals follow from the points as they are stored.
        let stored = if fixture.name.ends_with("far from the origin") {
            0.3
        } else {
            1e-4
        };
        assert!(worst_angle <= stored, "{}: {worst_angle} rad", fixture.name);
    });
}

#[test]
fn random_patches_of_every_degree_agree_with_the_twin() {
    let Some(device) = Device::new() else {
        eprintln!("no adapter: skipped");
        return;
    };
    for seed in 0..3 {
        let surface = fixtures::patches::random_patches(seed);
        let source = shaders::composed(surface.shader());
        let mut random = Random(seed);
        let points: Vec<RootPoint> = (0..20_000).map(|_| random.point(surface.topology())).collect();
        let words = surface.topology().gpu_words();
        let tables = surface.tables(DVec3::ZERO);
        let frames = evaluate(&device, &source, &tables, &words, &points, &[]).frames;
        let (mut worst, mut worst_angle, mut worst_at): (f64, f64, _) = (0.0, 0.0, None);
        for (&at, gpu) in points.iter().zip(&frames) {
            let truth = surface.frame(at);
            worst = worst.max((gpu.point.as_dvec3() - truth.position).abs().max_element() / EPSILON);
            assert!((gpu.normal.length() - 1.0).abs() < 1e-6, "{at:?}: {gpu:?}");
            if truth.du.cross(truth.dv).length() >= 1e-3 * truth.du.length() * truth.dv.length() {
                let angle = gpu.normal.as_dvec3().distance(truth.normal);
                if angle > worst_angle {
                    (worst_angle, worst_at) = (angle, Some((at, truth)));
                }
            }
        }
        println!("seed {seed}: {worst:.2} eps, {worst_angle:.1e} rad");
        assert!(
            worst <= 16.0 * fixtures::patches::RANDOM_PATCH_SIZE,
            "seed {seed}: {worst} eps"
        );
        assert!(worst_angle <= 1e-4, "seed {seed}: {worst_angle} rad at {worst_at:?}");
    }
}

#[test]
fn maps_are_exact_near_the_origin_however_large_they_are() {
    let Some(device) = Device::new() else {
        eprintln!("no adapter: skipped");
        return;
    };
    let fixtures = fixtures();
    for fixture in fixtures
        .iter()
        .filter(|f| f.name.contains("terrain") || f.name.contains("field"))
    {
        let surface = &*fixture.surface;
        let mut random = Random(9);
        let root = random.below(4);
        let near = |x: u32, y: u32| RootPoint {
            face: 0,
            root,
            x: ONE / 3 + x,
            y: ONE / 5 + y,
        };
        let points: Vec<RootPoint> = (0..2000)
            .map(|_| near(random.below(1000), random.below(1000)))
            .collect();
        let origin = surface.point(near(500, 500)) + DVec3::new(0.3, 0.1, 0.2) * 1e-4;
        let tables = surface.tables(origin);
        let source = shaders::composed(surface.shader());
        let words = surface.topology().gpu_words();
        for (&at, gpu) in points
            .iter()
            .zip(evaluate(&device, &source, &tables, &words, &points, &[]).frames)
        {
            let truth = surface.point(at) - origin;
            let error = (gpu.point.as_dvec3() - truth) * DVec3::new(1.0, 0.0, 1.0);
            let rounding_of_truth = 4.0 * f64::EPSILON * (origin.length() + truth.length());
            let allowed = 4.0 * EPSILON * truth.length() + rounding_of_truth;
            assert!(error.length() <= allowed, "{}: {error} of {truth}", fixture.name);
        }
    }
}

#[test]
fn every_address_of_a_site_gives_the_same_bits() {
    with_every_surface(|fixture, run| {
        let topology = fixture.surface.topology();
        let mut random = Random(7);
        let mut points = Vec::new();
        for _ in 0..4000 {
            let t = random.parameter();
            let (face, root) = random.root(topology);
            points.extend(addresses(topology, face, root, t));
        }
        let frames = run(&points, &[]).frames;
        let mut bits = HashMap::new();
        for (&at, gpu) in points.iter().zip(&frames) {
            let point = gpu.point.to_array().map(f32::to_bits);
            let (first, known) = *bits.entry(Site::of(topology, at)).or_insert((at, point));
            assert_eq!(known, point, "{}: {first:?} {at:?}", fixture.name);
        }
        assert!(
            bits.len() * 2 <= points.len(),
            "most points should have several addresses"
        );
    });
}

/// The addresses of a point of a spoke, a mesh edge, a vertex and the centre.
fn addresses(topology: &Topology, face: u32, root: u32, t: u32) -> Vec<RootPoint> {
    let count = topology.corner_count(face);
    let next = (root + 1) % count;
    let at = |face, root, x, y| RootPoint { face, root, x, y };
    let mut points = vec![at(face, next, t, 0), at(face, root, 0, t), at(face, root, t, ONE - t)];
    points.extend([
        at(face, next, ONE, 0),
        at(face, root, 0, ONE),
        at(face, root, 0, 0),
        at(face, next, 0, 0),
    ]);
    if let Some(twin) = topology.twin(face, root) {
        points.extend([
            at(twin.face, twin.root, ONE - t, t),
            at(twin.face, twin.root, ONE, 0),
            at(twin.face, twin.root, 0, ONE),
        ]);
    }
    points
}

#[test]
fn bounds_are_conservative_symmetric_and_nested_in_f32() {
    with_every_surface(|fixture, run| {
        let surface = &*fixture.surface;
        let topology = surface.topology();
        let mut random = Random(8);
        let mut leaves = Vec::new();
        for _ in 0..3000 {
            let leaf = random.leaf(topology);
            let leaf = if leaf.level == 31 {
                leaf.parent().expect("above")
            } else {
                leaf
            };
            let other = neighbour::h(topology, leaf).unwrap_or(leaf);
            leaves.extend([leaf, other]);
            leaves.extend(leaf.children());
        }
        let points: Vec<RootPoint> = leaves.iter().flat_map(|leaf| points_of(leaf, &mut random)).collect();
        let gpu = run(&points, &leaves);
        for (leaf, bound) in leaves.iter().zip(&gpu.bounds) {
            let truth = surface.bound(leaf);
            let room = 1e-4 * truth.radius + 1e4 * EPSILON * fixture.magnitude;
            for (gpu, truth) in [
                (bound.radius, truth.radius),
                (bound.size, truth.size),
                (bound.guard, truth.guard),
                (bound.deviation, truth.deviation),
                (bound.pair_deviation, truth.pair_deviation),
            ] {
                assert!(
                    f64::from(gpu) >= truth * (1.0 - 1e-5) - 1e-30,
                    "{}: {leaf:?} {bound:?} {truth:?}",
                    fixture.name
                );
                // A box of texels that is rounded outwards may reach into another block.
                let is_close = f64::from(gpu) <= truth * 1.0001 + room || fixture.name.starts_with("texture");
                assert!(is_close, "{}: {leaf:?} {bound:?} {truth:?}", fixture.name);
            }
        }
        for (group, frames) in gpu.bounds.chunks(6).zip(gpu.frames.chunks(6 * 5)) {
            let [leaf, other] = [group[0], group[1]];
            assert_eq!(leaf.bits(), other.bits(), "{}: halves of a diamond", fixture.name);
            for frame in &frames[..10] {
                let outside = distance(frame.point, leaf.centre) - f64::from(leaf.radius);
                assert!(outside <= 0.0, "{}: {outside:e} outside of {leaf:?}", fixture.name);
            }
            for child in &group[2..] {
                assert!(
                    child.size <= leaf.size * 0.500001,
                    "{}: {leaf:?} {child:?}",
                    fixture.name
                );
                assert!(
                    child.deviation <= leaf.deviation,
                    "{}: {leaf:?} {child:?}",
                    fixture.name
                );
                let reach = distance(child.centre, leaf.centre) + f64::from(child.guard);
                assert!(reach <= f64::from(leaf.guard), "{}: {leaf:?} {child:?}", fixture.name);
            }
        }
    });
}

fn distance(a: Vec3, b: Vec3) -> f64 {
    a.as_dvec3().distance(b.as_dvec3())
}

/// The corners of a leaf and two more of its points.
fn points_of(leaf: &Place, random: &mut Random) -> [RootPoint; 5] {
    let [origin, right, up] = leaf.corners();
    let unit = leaf.unit();
    let mut any = || {
        let a = random.below(unit + 1);
        leaf.at(a, random.below(unit - a + 1))
    };
    [origin, right, up, any(), any()]
}
