//! Bounds against the surfaces themselves, and equal bits on both sides of edges.

use crate::emulation::Emulation;
use crate::models::{Random, grid, open_fan, shaken, sphere, wheel};
use glam::DVec3;
use keyleaf_key::{ONE, Place, RootPoint, neighbour};
use keyleaf_surface::{ControlMesh, CornerNormals, LoopWeights, PolygonMesh, Surface, TrianglePatches};

/// Rounding, for models of size about one.
const ERROR: f64 = 1e-14;

fn models() -> Vec<(String, TrianglePatches)> {
    let meshes: [(&str, PolygonMesh); 5] = [
        ("sphere", sphere(1)),
        ("shaken sphere", shaken(sphere(1), 0.3, 3)),
        ("wheel of 11", wheel(11, 1.0)),
        ("grid", shaken(grid(4, |x, y| (x * y).sin()), 0.2, 5)),
        ("fan", open_fan(9)),
    ];
    let all = |(name, mesh): (&str, PolygonMesh)| {
        let control = ControlMesh::from(mesh.clone());
        [
            (
                format!("{name}, Loop"),
                TrianglePatches::of_loop(&control, LoopWeights::Loop),
            ),
            (format!("{name}, Butterfly"), TrianglePatches::butterfly(&mesh)),
            (
                format!("{name}, PN"),
                TrianglePatches::point_normal(&mesh, CornerNormals::AngleWeighted),
            ),
        ]
    };
    let made = meshes.into_iter().flat_map(all);
    made.map(|(name, patches)| (name, patches.expect("a surface")))
        .collect()
}

fn leaf(random: &mut Random, model: &TrianglePatches) -> Place {
    let root = Place::of_root(random.below(model.topology().face_count()), random.below(3));
    (0..random.below(24)).fold(root, |place, _| place.child(random.below(4)))
}

fn for_every_leaf(mut check: impl FnMut(&str, &TrianglePatches, Place, &mut Random)) {
    for (name, model) in &models() {
        let mut random = Random(7);
        for _ in 0..600 {
            let leaf = leaf(&mut random, model);
            check(name, model, leaf, &mut random);
        }
    }
}

fn weights(random: &mut Random, unit: u32) -> [u32; 2] {
    let a = random.below(unit + 1);
    [a, random.below(unit - a + 1)]
}

#[test]
fn balls_hold_the_surface_over_both_halves_and_guards_hold_those_of_children() {
    for_every_leaf(|name, model, leaf, random| {
        let bound = model.bound(&leaf);
        let other = neighbour::h(model.topology(), leaf);
        for half in [Some(leaf), other].into_iter().flatten() {
            assert_eq!(model.bound(&half), bound, "{name}");
            for _ in 0..12 {
                let [a, b] = weights(random, half.unit());
                let outside = model.point(half.at(a, b)).distance(bound.centre) - bound.radius;
                assert!(outside <= ERROR, "{name}: {outside:e} outside of {bound:?} of {half:?}");
            }
        }
        for child in leaf.children() {
            let small = model.bound(&child);
            assert!(
                small.size <= bound.size / 2.0 && small.deviation <= bound.deviation / 4.0,
                "{name}"
            );
            assert!(
                small.centre.distance(bound.centre) + small.guard <= bound.guard + ERROR,
                "{name}"
            );
        }
    });
}

/// The triangles that are drawn of a leaf: itself, and the two halves into which its children pair.
fn drawn(leaf: &Place) -> Vec<([RootPoint; 3], u32)> {
    let unit = leaf.unit();
    let at = |x: u32, y: u32| leaf.at(x, y);
    let half = unit / 2;
    vec![
        (leaf.corners(), leaf.level),
        ([at(half, half), at(0, unit), at(0, 0)], leaf.level + 1),
        ([at(half, half), at(0, 0), at(unit, 0)], leaf.level + 1),
    ]
}

#[test]
fn sizes_bound_hypotenuse_and_median_and_deviations_what_is_drawn() {
    let mut tightest = 0.0f64;
    for_every_leaf(|name, model, leaf, random| {
        let bound = model.bound(&leaf);
        let [origin, right, up] = leaf.corners().map(|at| model.point(at));
        let longest = (right.distance(up) / 2.0).max(origin.distance(model.point(leaf.middle())));
        assert!(longest <= bound.size + ERROR, "{name}: {longest} {bound:?}");
        for (corners, level) in drawn(&leaf) {
            let allowed = model.bound(&leaf).deviation / if level > leaf.level { 4.0 } else { 1.0 };
            for _ in 0..6 {
                // Of the parameters of the corners in root space.
                let [a, b] = weights(random, 64).map(u64::from);
                let mix = |of: fn(&RootPoint) -> u32| {
                    let [o, r, u] = [0, 1, 2].map(|k| u64::from(of(&corners[k])));
                    (o * (64 - a - b) + r * a + u * b) / 64
                };
                let at = RootPoint {
                    x: mix(|p| p.x) as u32,
                    y: mix(|p| p.y) as u32,
                    ..corners[0]
                };
                if leaf.unit() < 64 {
                    continue;
                }
                let [p, q, r] = corners.map(|at| model.point(at));
                let [a, b] = [a, b].map(|w| w as f64 / 64.0);
                let off = model.point(at).distance(p * (1.0 - a - b) + q * a + r * b);
                tightest = tightest.max(off / allowed.max(1e-9));
                assert!(off <= allowed + ERROR, "{name}: {off} {allowed}");
            }
        }
    });
    assert!(tightest > 0.5, "the bound is never nearly reached: {tightest}");
}

#[test]
fn edges_and_vertices_have_equal_bits_from_all_sides_in_f64_and_in_f32() {
    for (name, model) in &models() {
        let (mut random, emulation) = (Random(11), Emulation::new(model, DVec3::new(0.3, -7.1, 100.0)));
        for root in model.topology().roots() {
            let Some(twin) = model.topology().twin(root.face, root.root) else {
                continue;
            };
            for _ in 0..20 {
                let t = [0, ONE, random.below(ONE)][random.below(3) as usize];
                let here = RootPoint {
                    face: root.face,
                    root: root.root,
                    x: ONE - t,
                    y: t,
                };
                let there = RootPoint {
                    face: twin.face,
                    root: twin.root,
                    x: t,
                    y: ONE - t,
                };
                let bits = |p: DVec3| p.to_array().map(f64::to_bits);
                assert_eq!(bits(model.point(here)), bits(model.point(there)), "{name}");
                assert_eq!(bits(emulation.point(here)), bits(emulation.point(there)), "{name}");
                assert_eq!(model.frame(here).position, model.point(here));
                let spoke = RootPoint {
                    face: root.face,
                    root: root.root,
                    x: t,
                    y: 0,
                };
                let other = RootPoint {
                    face: root.face,
                    root: (root.root + 2) % 3,
                    x: 0,
                    y: t,
                };
                assert_eq!(bits(emulation.point(spoke)), bits(emulation.point(other)), "{name}");
                assert_eq!(bits(model.point(spoke)), bits(model.point(other)), "{name}");
            }
        }
    }
}

#[test]
fn positions_in_f32_are_within_sixteen_roundings_of_the_largest_coordinate() {
    for (name, model) in &models() {
        for origin in [DVec3::ZERO, DVec3::new(1e4, -3.0, 1e6)] {
            let (mut random, emulation) = (Random(13), Emulation::new(model, origin));
            let (low, high) = model.bounding_box();
            let largest = (low - origin).abs().max((high - origin).abs()).max_element();
            for _ in 0..400 {
                let face = random.below(model.topology().face_count());
                let [x, y] = weights(&mut random, ONE);
                let at = RootPoint {
                    face,
                    root: random.below(3),
                    x,
                    y,
                };
                let error = emulation.point(at).distance(model.point(at) - origin);
                assert!(error <= 16.0 * 2f64.powi(-24) * largest, "{name}: {error}");
            }
        }
    }
}

#[test]
fn derivatives_are_those_of_the_position() {
    for (name, model) in &models() {
        let mut random = Random(17);
        for _ in 0..100 {
            let face = random.below(model.topology().face_count());
            let [u, v] = [0, 1].map(|_| 0.2 + 0.1 * (random.signed() + 1.0));
            let point = |u: f64, v: f64| model.point(model.face_coord(face, u, v).expect("in the triangle"));
            let step = 2f64.powi(-12);
            let du = (point(u + step, v) - point(u - step, v)) / (2.0 * step);
            let dv = (point(u, v + step) - point(u, v - step)) / (2.0 * step);
            let frame = model.frame(model.face_coord(face, u, v).expect("in the triangle"));
            assert!(
                frame.du.distance(du) < 1e-5 && frame.dv.distance(dv) < 1e-5,
                "{name}: {frame:?} {du} {dv}"
            );
            assert!((frame.normal.length() - 1.0).abs() < 1e-12);
        }
    }
}
