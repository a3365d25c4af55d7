//! Bounds against the surfaces themselves.

use crate::models::{bezier_model, clamped, model, rational_neighbours, sheet, sphere, torus};
use crate::oracle_tables::oracle;
use crate::oracles::tea_set;
use crate::random::Random;
use glam::DVec3;
use keyleaf_key::{ONE, Place, RootPoint, neighbour};
use keyleaf_surface::{NurbsSurface, Patches, Surface, SurfaceBound};

fn models() -> Vec<(&'static str, Patches)> {
    let uneven = |spread, seed| sheet([3, 2], [clamped(3, &[0.3, 0.6, 0.6]), clamped(2, &[0.5])], spread, seed);
    let mut models = vec![
        ("sheet", model(vec![uneven(0.0, 1)])),
        ("weights of four decades", model(vec![uneven(2.0, 2)])),
        (
            "degree 7",
            model(vec![sheet([7, 5], [clamped(7, &[0.4]), clamped(5, &[])], 0.5, 3)]),
        ),
        (
            "tear",
            model(vec![sheet(
                [2, 1],
                [clamped(2, &[0.5, 0.5, 0.5]), clamped(1, &[])],
                0.0,
                4,
            )]),
        ),
        (
            "unclamped",
            model(vec![sheet(
                [3, 3],
                [0, 1].map(|_| (0..11).map(f64::from).collect()),
                0.3,
                5,
            )]),
        ),
        ("sphere", model(vec![sphere()])),
        ("torus", model(vec![torus()])),
    ];
    if let Some(table) = oracle("bezier/teapot.json") {
        models.push(("teapot", bezier_model(tea_set(&table))));
    }
    models
}

fn leaf(random: &mut Random, model: &Patches) -> Place {
    let root = Place::of_root(random.below(model.topology().face_count()), random.below(4));
    (0..random.below(32)).fold(root, |place, _| place.child(random.below(4)))
}

fn points_of(leaf: &Place, random: &mut Random) -> Vec<RootPoint> {
    let unit = leaf.unit();
    let mut points = leaf.corners().to_vec();
    for _ in 0..12 {
        let a = random.below(unit + 1);
        points.push(leaf.at(a, random.below(unit - a + 1)));
    }
    points
}

fn for_every_leaf(mut check: impl FnMut(&str, &Patches, Place, &mut Random)) {
    for (name, model) in &models() {
        let mut random = Random(7);
        for _ in 0..1500 {
            let leaf = leaf(&mut random, model);
            check(name, model, leaf, &mut random);
        }
    }
}

/// Rounding, for models of size about one.
const ERROR: f64 = 1e-13;

#[test]
fn balls_hold_the_surface_over_both_halves_and_both_halves_have_the_same() {
    for_every_leaf(|name, model, leaf, random| {
        let bound = model.bound(&leaf);
        let other = neighbour::h(model.topology(), leaf);
        for half in [Some(leaf), other].into_iter().flatten() {
            assert_eq!(model.bound(&half).radius, bound.radius);
            if leaf.level < 31 {
                // Halves of a triangle are no matter of the diamond.
                let pair_deviation = bound.pair_deviation;
                let same = SurfaceBound {
                    pair_deviation,
                    ..model.bound(&half)
                };
                assert_eq!(same, bound, "{name}");
            }
            for at in points_of(&half, random) {
                let outside = model.point(at).distance(bound.centre) - bound.radius;
                assert!(outside <= ERROR, "{name}: {outside:e} outside of {bound:?} of {half:?}");
            }
        }
    });
}

#[test]
fn sizes_and_deviations_are_nested_and_guards_hold_those_of_children() {
    for_every_leaf(|name, model, leaf, _| {
        if leaf.level == 31 {
            return;
        }
        let bound = model.bound(&leaf);
        for child in leaf.children() {
            let small = model.bound(&child);
            assert!(small.size <= bound.size / 2.0, "{name}: {bound:?} {small:?}");
            assert!(small.deviation <= bound.deviation, "{name}: {bound:?} {small:?}");
            let reach = small.centre.distance(bound.centre) + small.guard;
            assert!(reach <= bound.guard + ERROR, "{name}: {bound:?} {small:?}");
        }
    });
}

/// A point in the middle of what a triangle's weights say.
fn inside(corners: [DVec3; 3], weights: [f64; 3]) -> DVec3 {
    corners.into_iter().zip(weights).map(|(p, w)| p * w).sum()
}

#[test]
fn sizes_bound_hypotenuse_and_median_and_deviations_flat_triangles_and_their_halves() {
    for_every_leaf(|name, model, leaf, random| {
        let bound = model.bound(&leaf);
        let corners = leaf.corners().map(|at| model.point(at));
        let [origin, right, up] = corners;
        if leaf.level == 31 {
            return;
        }
        let middle = model.point(leaf.middle());
        let longest = (right.distance(up) / 2.0).max(origin.distance(middle));
        assert!(longest <= bound.size + ERROR, "{name}: {longest} {bound:?}");
        let unit = leaf.unit();
        for _ in 0..8 {
            let a = random.below(unit + 1);
            let b = random.below(unit - a + 1);
            let [a_weight, b_weight] = [a, b].map(|x| f64::from(x) / f64::from(unit));
            let flat = inside(corners, [1.0 - a_weight - b_weight, a_weight, b_weight]);
            let off = model.point(leaf.at(a, b)).distance(flat);
            assert!(off <= bound.deviation + ERROR, "{name}: {off} {bound:?} {leaf:?}");
            assert!(off <= 1.125 * bound.size + ERROR, "{name}: {off} {bound:?} {leaf:?}");

            // The same point in the half that is drawn instead of two children.
            let half = [corners[0], corners[if a >= b { 1 } else { 2 }], middle];
            let [far, near] = [a_weight.max(b_weight), a_weight.min(b_weight)];
            let flat = inside(half, [1.0 - far - near, far - near, 2.0 * near]);
            let off = model.point(leaf.at(a, b)).distance(flat);
            assert!(off <= bound.pair_deviation + ERROR, "{name}: {off} {bound:?} {leaf:?}");
        }
    });
}

#[test]
fn bounds_are_tight_enough_to_cull_and_to_measure() {
    for (name, model) in &models() {
        let mut random = Random(9);
        let (mut size_over, mut deviation_over, mut count, mut bent) = (0.0, 0.0, 0.0, 0.0);
        for _ in 0..1500 {
            let leaf = leaf(&mut random, model);
            let bound = model.bound(&leaf);
            let [_, right, up] = leaf.corners().map(|at| model.point(at));
            if !(2..14).contains(&leaf.level) || right.distance(up) < 1e-12 {
                continue;
            }
            size_over += (bound.size / (right.distance(up) / 2.0)).ln();
            count += 1.0;
            let sagitta = model.point(leaf.middle()).distance((right + up) / 2.0);
            if sagitta > 1e-12 {
                deviation_over += (bound.deviation / sagitta).ln();
                bent += 1.0;
            }
        }
        let [size, deviation] = [size_over / count, deviation_over / bent].map(f64::exp);
        println!("{name}: size {size:.2} times half the hypotenuse, deviation {deviation:.2} times its sagitta");
        let most = if *name == "weights of four decades" { 60.0 } else { 6.0 };
        assert!(size < most && deviation < most + 2.0, "{name}: {size} {deviation}");
    }
}

#[test]
fn the_box_holds_the_surface_and_zero_weights_keep_bounds_finite() {
    for_every_leaf(|name, model, leaf, random| {
        let (low, high) = model.bounding_box();
        for at in points_of(&leaf, random) {
            let point = model.point(at);
            assert!(
                point.cmpge(low - ERROR).all() && point.cmple(high + ERROR).all(),
                "{name}: {point}"
            );
        }
    });
    for zero in 0..9 {
        let points = (0..9)
            .map(|k| DVec3::new(f64::from(k % 3), f64::from(k / 3), f64::from(k * k % 5)))
            .collect();
        let weights = (0..9).map(|k| if k == zero { 0.0 } else { 1.0 }).collect();
        let model = bezier_model(vec![NurbsSurface::bezier([2, 2], points, weights).expect("a patch")]);
        for root in 0..4 {
            let bound = model.bound(&Place::of_root(0, root));
            assert!(bound.radius.is_finite() && bound.deviation.is_finite() && bound.size > 0.0);
            let frame = model.frame(RootPoint {
                face: 0,
                root,
                x: ONE,
                y: 0,
            });
            assert!(
                frame.position.is_finite() && (frame.normal.length() - 1.0).abs() < 1e-12,
                "{zero}: {frame:?}"
            );
        }
    }
}

#[test]
fn balls_hold_where_the_knots_of_snapped_curves_differ() {
    let [first, second] = <[NurbsSurface; 2]>::try_from(rational_neighbours(2.0, 0.0)).expect("two surfaces");
    let [u, v] = second.knots();
    let mut v = v.to_vec();
    v[6] += 4e-6; // of 8
    let (points, weights) = (second.points().to_vec(), second.weights().to_vec());
    let second = NurbsSurface::new(second.degree(), [u.to_vec(), v], points, weights).expect("a surface");
    let model = model(vec![first, second]);
    assert_eq!(model.report().snapped, 1);
    let joined: Vec<Place> = model
        .topology()
        .roots()
        .filter(|root| model.topology().twin(root.face, root.root).is_some())
        .collect();
    let mut random = Random(5);
    for k in 0..8000 {
        // Children 0 and 3 stay at the mesh edge.
        let root = joined[k % joined.len()];
        let leaf = (0..random.below(31)).fold(root, |leaf, _| leaf.child([0, 3][random.below(2) as usize]));
        let bound = model.bound(&leaf);
        for at in points_of(&leaf, &mut random) {
            let outside = model.point(at).distance(bound.centre) - bound.radius;
            assert!(outside <= ERROR, "{outside:e} outside of {bound:?} of {leaf:?}");
        }
    }
}
