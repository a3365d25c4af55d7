//! Places at which evaluators break: tears, weights of zero, poles, parallel tangents, coordinates far from zero.

use crate::models::{HALF, bezier_model, clamped, model, revolved, sheet, sphere, torus};
use crate::random::Random;
use glam::DVec3;
use keyleaf_key::{ONE, RootPoint};
use keyleaf_surface::{BasisMethod, NurbsSurface, PatchKind, PatchSettings, Patches, Surface};

const METHODS: [BasisMethod; 4] = [
    BasisMethod::Triangular,
    BasisMethod::Stair,
    BasisMethod::DeBoor,
    BasisMethod::Extraction,
];

#[test]
fn at_a_tear_the_right_hand_side_answers_and_the_last_span_is_closed() {
    let surface = sheet([3, 1], [clamped(3, &[0.5; 4]), clamped(1, &[])], 0.0, 1);
    let at = |u: f64| surface.frame(u, 0.0).expect("in the domain").position;
    assert_eq!(at(0.5), surface.points()[4]);
    assert_eq!(at(1.0), surface.points()[7]);
    assert!(at(0.5f64.next_down()).distance(surface.points()[3]) < 1e-12);
}

#[test]
fn all_methods_and_degrees_give_the_same_surface() {
    for degree in 1..=7 {
        let knots = [clamped(degree, &[0.3, 0.3 + 1e-6, 0.7]), clamped(8 - degree, &[0.5])];
        let surface = sheet([degree, 8 - degree], knots, 2.0, 4);
        let models = METHODS.map(|method| {
            let kind = PatchKind::Nurbs(method);
            Patches::new(
                vec![surface.clone()],
                PatchSettings {
                    kind,
                    ..Default::default()
                },
            )
            .expect("a model")
        });
        let mut random = Random(2);
        for _ in 0..200 {
            let x = random.below(ONE);
            let at = RootPoint {
                face: random.below(models[0].topology().face_count()),
                root: random.below(4),
                x,
                y: random.below(ONE - x),
            };
            let [reference, others @ ..] = models.each_ref().map(|model| model.frame(at));
            for frame in others {
                assert!(frame.position.distance(reference.position) < 1e-13);
                assert!(frame.du.distance(reference.du) < 1e-11 * (1.0 + reference.du.length()));
                assert!(frame.dv.distance(reference.dv) < 1e-11 * (1.0 + reference.dv.length()));
            }
        }
    }
}

#[test]
fn derivatives_are_those_of_the_positions() {
    for (degree, spread) in [([5, 6], 1.0), ([7, 7], 0.0), ([2, 3], 2.0)] {
        let knots = degree.map(|p| clamped(p, &[0.25, 0.5]));
        let surface = sheet(degree, knots, spread, 5);
        let at = |u: f64, v: f64| surface.frame(u, v).expect("in the domain");
        for (u, v) in [(0.1, 0.2), (0.3, 0.9), (0.77, 0.4)] {
            let (frame, step) = (at(u, v), 1e-6);
            let numeric_u = (at(u + step, v).position - at(u - step, v).position) / (2.0 * step);
            let numeric_v = (at(u, v + step).position - at(u, v - step).position) / (2.0 * step);
            assert!(numeric_u.distance(frame.du) < 1e-6 * (1.0 + frame.du.length()));
            assert!(numeric_v.distance(frame.dv) < 1e-6 * (1.0 + frame.dv.length()));
        }
    }
}

#[test]
fn far_from_zero_derivatives_and_normals_lose_nothing() {
    let near = torus();
    let offset = DVec3::new(1048576.0, -2097152.0, 524288.0);
    let points = near.points().iter().map(|&p| p + offset).collect();
    let far = NurbsSurface::new(
        near.degree(),
        near.knots().map(<[f64]>::to_vec),
        points,
        near.weights().to_vec(),
    );
    let far = far.expect("a surface");
    for (u, v) in [(0.0, 0.0), (0.3, 0.8), (0.25, 0.5), (0.99, 0.01)] {
        let [a, b] = [&near, &far].map(|surface| surface.frame(u, v).expect("in the domain"));
        assert!(b.position.distance(a.position + offset) < 1e-9);
        assert!(
            a.du.distance(b.du) < 1e-8 && a.normal.distance(b.normal) < 1e-8,
            "{a:?} {b:?}"
        );
    }
}

#[test]
fn weights_over_four_decades_and_zeros_stay_finite() {
    let surface = sheet([3, 3], [clamped(3, &[0.5]), clamped(3, &[])], 2.0, 6);
    let largest = surface
        .points()
        .iter()
        .map(|p| p.abs().max_element())
        .fold(0.0, f64::max);
    for zero in [None, Some(0), Some(4), Some(7)] {
        let mut weights = surface.weights().to_vec();
        zero.into_iter().for_each(|index| weights[index] = 0.0);
        let knots = surface.knots().map(<[f64]>::to_vec);
        let surface = NurbsSurface::new([3, 3], knots, surface.points().to_vec(), weights).expect("a surface");
        let model = model(vec![surface.clone()]);
        for i in 0..=16 {
            for j in 0..=16 {
                let (u, v) = (f64::from(i) / 16.0, f64::from(j) / 16.0);
                let frame = surface.frame(u, v).expect("in the domain");
                assert!(
                    frame.position.abs().max_element() <= largest * (1.0 + 1e-12),
                    "{zero:?} {frame:?}"
                );
                assert!(frame.du.is_finite() && frame.dv.is_finite(), "{zero:?} {frame:?}");
                assert!((frame.normal.length() - 1.0).abs() < 1e-12);
                let at = model.own_coord(0, u, v).expect("in the domain").at;
                assert!(model.point(at).is_finite());
            }
        }
    }
}

#[test]
fn at_poles_tangents_are_exactly_zero_and_normals_are_limits_from_inside() {
    for (surface, largest_angle) in [(sphere(), 1e-6), (sphere().transposed(), 1e-6)] {
        let turned = if surface == sphere() { 1.0 } else { -1.0 };
        let model = model(vec![surface]);
        for pole in &model.report().poles {
            for &face in &pole.faces {
                let root = (0..4).find(|&root| {
                    model.point(RootPoint {
                        face,
                        root,
                        x: ONE / 2,
                        y: ONE / 2,
                    }) == pole.position
                });
                let root = root.expect("a collapsed edge");
                for y in [0, 1, ONE / 3, ONE / 2, ONE - 1, ONE] {
                    let frame = model.frame(RootPoint {
                        face,
                        root,
                        x: ONE - y,
                        y,
                    });
                    assert!(frame.du == DVec3::ZERO || frame.dv == DVec3::ZERO, "{frame:?}");
                    assert!(
                        frame.normal.distance(pole.position * turned) < largest_angle,
                        "{frame:?}"
                    );
                }
                // One unit of the finest grid beside the edge as well.
                let frame = model.frame(RootPoint {
                    face,
                    root,
                    x: ONE / 2,
                    y: ONE / 2 - 1,
                });
                assert!(
                    frame.normal.distance(frame.position * turned) < largest_angle,
                    "{frame:?}"
                );
            }
        }
    }
}

#[test]
fn at_the_tip_of_a_cone_the_normal_is_one_of_the_limits() {
    let cone = revolved(&[[1.0, 0.0, 1.0], [0.0, 2.0, 1.0]], clamped(1, &[]), 1);
    let slant = 1.0 / 5f64.sqrt();
    for k in 0..=32 {
        let u = f64::from(k) / 32.0;
        let [tip, beside] = [1.0, 0.5].map(|v| cone.frame(u, v).expect("in the domain"));
        assert_eq!(tip.position, DVec3::new(0.0, 0.0, 2.0));
        assert!(
            (tip.normal.z - slant).abs() < 1e-12 && tip.normal.distance(beside.normal) < 1e-9,
            "{tip:?} {beside:?}"
        );
    }
}

#[test]
fn parallel_and_vanishing_tangents_end_in_unit_normals() {
    let flat = |k: usize| DVec3::new((k % 3) as f64, (k / 3) as f64, 0.0);
    let patch = |change: &dyn Fn(&mut Vec<DVec3>)| {
        let mut points: Vec<DVec3> = (0..9).map(flat).collect();
        change(&mut points);
        NurbsSurface::bezier([2, 2], points, vec![1.0, HALF, 1.0, HALF, 0.5, HALF, 1.0, HALF, 1.0]).expect("a patch")
    };
    // Repeated control points at a corner: both tangents vanish, the normal is still up.
    let cusp = patch(&|p| (p[1], p[3]) = (p[0], p[0]));
    assert!(cusp.frame(0.0, 0.0).expect("inside").normal.distance(DVec3::Z) < 1e-9);
    // Tangents at a corner run the same way.
    let parallel = patch(&|p| p[3] = p[1]);
    assert!(parallel.frame(0.0, 0.0).expect("inside").normal.distance(DVec3::Z) < 1e-9);
    // A whole side of repeated rows.
    let edge = patch(&|p| (0..3).for_each(|j| p[1 + 3 * j] = p[3 * j]));
    assert!(edge.frame(0.0, 0.3).expect("inside").normal.distance(DVec3::Z) < 1e-9);
    // No area at all.
    for line in [
        patch(&|p| p.iter_mut().for_each(|q| q.y = 0.0)),
        patch(&|p| p.fill(DVec3::ONE)),
    ] {
        for at in [0.0, 0.3, 0.5, 1.0] {
            let frame = line.frame(at, at).expect("inside");
            assert!((frame.normal.length() - 1.0).abs() < 1e-6, "{frame:?}");
        }
        let model = bezier_model(vec![line]);
        assert!(
            model
                .frame(RootPoint {
                    face: 0,
                    root: 0,
                    x: 0,
                    y: 0
                })
                .normal
                .is_finite()
        );
    }
}

#[test]
fn a_closed_single_span_has_a_size_although_its_corners_coincide() {
    let ring = [[1.0, 0.0], [0.0, 2.0], [-1.5, -1.0], [1.0, 0.0]];
    let points = (0..16).map(|k| DVec3::new(ring[k % 4][0], ring[k % 4][1] + ring[k / 4][0], ring[k / 4][1]));
    let model = bezier_model(vec![
        NurbsSurface::bezier([3, 3], points.collect(), vec![1.0; 16]).expect("a patch"),
    ]);
    let root = keyleaf_key::Place::of_root(0, 0);
    let [_, right, up] = root.corners().map(|at| model.point(at));
    assert_eq!(right, up);
    assert!(model.bound(&root).size > 1.0 && model.bound(&root).deviation > 0.5);
}
