//! Which boundaries join, what is reported, and that both sides of an edge have the same bits.

use crate::models::{bezier_model, bilinear, clamped, model, rational_neighbours, sheet, sphere, torus};
use crate::oracle_tables::oracle;
use crate::oracles::tea_set;
use crate::random::Random;
use glam::DVec3;
use keyleaf_key::{HalfEdge, ONE, RootPoint, Site};
use keyleaf_surface::{NurbsSurface, PatchKind, PatchSettings, Patches, Side, Surface, Unjoined};
use std::collections::HashMap;

/// Points of all mesh edges, by all their addresses: equal sites have equal bits, and so has everything about a pole.
pub fn assert_same_bits(model: &Patches) {
    let mut random = Random(3);
    let mut known: HashMap<Site, DVec3> = HashMap::new();
    let parameters: Vec<u32> = (0..8).map(|_| random.below(ONE)).chain([0, ONE / 2, ONE]).collect();
    for root in model.topology().roots() {
        for &t in &parameters {
            for y in [t, ONE - t] {
                let at = RootPoint {
                    face: root.face,
                    root: root.root,
                    x: ONE - y,
                    y,
                };
                let point = model.point(at);
                assert_eq!(*known.entry(Site::of(model.topology(), at)).or_insert(point), point);
                assert_eq!(model.frame(at).position, point);
            }
        }
    }
}

pub fn is_closed(model: &Patches) -> bool {
    model
        .topology()
        .roots()
        .all(|root| model.topology().twin(root.face, root.root).is_some())
}

#[test]
fn a_torus_closes_both_ways() {
    let model = model(vec![torus()]);
    let report = model.report();
    assert_eq!(
        (report.exact, report.snapped, report.unjoined.len(), report.poles.len()),
        (2, 0, 0, 0)
    );
    assert_eq!(
        (model.topology().face_count(), model.topology().vertex_count()),
        (16, 16)
    );
    assert!(is_closed(&model));
    assert_same_bits(&model);
}

#[test]
fn a_sphere_has_two_poles_and_a_seam() {
    let model = model(vec![sphere()]);
    let report = model.report();
    assert_eq!((report.exact, report.snapped, report.unjoined.len()), (1, 0, 0));
    let poles: Vec<_> = report
        .poles
        .iter()
        .map(|pole| (pole.position, pole.faces.clone()))
        .collect();
    assert_eq!(poles, [(DVec3::NEG_Z, vec![0, 1, 2, 3]), (DVec3::Z, vec![4, 5, 6, 7])]);
    for face in 0..4 {
        for y in [0, 1, ONE / 3, ONE] {
            assert_eq!(
                model.point(RootPoint {
                    face,
                    root: 0,
                    x: ONE - y,
                    y
                }),
                DVec3::NEG_Z
            );
        }
    }
    assert_same_bits(&model);
}

/// A Bézier patch of degree 3 whose first and last control points coincide in u, and in v if asked.
fn closed_patch(in_v: bool) -> NurbsSurface {
    let ring = [[1.0, 0.0], [0.0, 2.0], [-1.5, -1.0], [1.0, 0.0]];
    let mut points = Vec::new();
    for j in 0..4 {
        let [height, wide] = if in_v { ring[j] } else { [j as f64, 0.3 * j as f64] };
        points.extend(ring.map(|[x, y]| DVec3::new(x * (3.0 + wide), y * (3.0 + wide), height)));
    }
    NurbsSurface::bezier([3, 3], points, vec![1.0; 16]).expect("a patch")
}

#[test]
fn a_single_span_may_meet_itself() {
    let tube = bezier_model(vec![closed_patch(false)]);
    assert_eq!(tube.topology().twin(0, 1), Some(HalfEdge { face: 0, root: 3 }));
    assert_eq!((tube.report().exact, tube.report().unjoined.len()), (1, 2));
    let torus = bezier_model(vec![closed_patch(true)]);
    assert!(is_closed(&torus));
    assert_eq!((torus.report().exact, torus.topology().vertex_count()), (2, 1));
    assert_same_bits(&tube);
    assert_same_bits(&torus);
}

/// `count` bilinear patches round a circle, turned by `half_turns` half turns in all.
fn twisted_strip(count: usize, half_turns: usize) -> Vec<NurbsSurface> {
    use std::f64::consts::{PI, TAU};
    let end = |k: usize, side: f64| {
        // The last end is the first, exactly.
        let flips = if k == count && half_turns % 2 == 1 { -1.0 } else { 1.0 };
        let k = k % count;
        let (around, turn) = (
            TAU * k as f64 / count as f64,
            PI * (half_turns * k) as f64 / count as f64,
        );
        let (radius, height) = (2.0 + side * flips * turn.cos() * 0.5, side * flips * turn.sin() * 0.5);
        [around.cos() * radius, around.sin() * radius, height]
    };
    (0..count)
        .map(|k| bilinear([end(k, -1.0), end(k + 1, -1.0), end(k, 1.0), end(k + 1, 1.0)]))
        .collect()
}

#[test]
fn a_strip_with_one_side_is_cut_and_reported() {
    let untwisted = bezier_model(twisted_strip(6, 2));
    assert_eq!((untwisted.report().exact, untwisted.report().unjoined.len()), (6, 12));
    let moebius = bezier_model(twisted_strip(6, 1));
    let reasons = |reason| {
        moebius
            .report()
            .unjoined
            .iter()
            .filter(|(_, why)| *why == reason)
            .count()
    };
    assert_eq!(
        (
            moebius.report().exact,
            reasons(Unjoined::NotOrientable),
            reasons(Unjoined::Free)
        ),
        (5, 2, 12)
    );
    // One surface of one span as well.
    let points = [
        [-1.0, 2.0, 0.0],
        [1.0, 2.0, 3.0],
        [1.0, -2.0, 0.0],
        [-1.0, -2.0, 1.0],
        [1.0, 0.0, 2.0],
        [-1.0, 0.0, 2.0],
    ];
    let mut bent = points.map(DVec3::from_array).to_vec();
    (bent[2], bent[5]) = (bent[3], bent[0]);
    let patch = NurbsSurface::bezier([2, 1], bent, vec![1.0; 6]).expect("a patch");
    let cut = bezier_model(vec![patch]);
    let reasons: Vec<_> = cut.report().unjoined.iter().map(|(b, why)| (b.side, *why)).collect();
    assert_eq!(
        reasons,
        [
            (Side::VMin, Unjoined::Free),
            (Side::UMax, Unjoined::NotOrientable),
            (Side::VMax, Unjoined::Free),
            (Side::UMin, Unjoined::NotOrientable)
        ]
    );
}

/// The squares of a bumpy grid, each turned by some of the eight symmetries.
pub fn scrambled_grid(side: usize) -> Vec<NurbsSurface> {
    let mut random = Random(11);
    let height = |i: usize, j: usize| ((i * 7 + j * 13 + i * j) % 5) as f64 * 0.1;
    let mut surfaces = Vec::new();
    for cell in 0..side * side {
        let [a, b] = [cell % side * 2, cell / side * 2];
        let turn = random.below(8);
        let points = (0..9).map(|k| {
            let [mut i, mut j] = [k % 3, k / 3];
            if turn & 1 == 1 {
                (i, j) = (j, i);
            }
            i = if turn & 2 == 2 { 2 - i } else { i };
            j = if turn & 4 == 4 { 2 - j } else { j };
            DVec3::new((a + i) as f64, (b + j) as f64, height(a + i, b + j))
        });
        surfaces.push(NurbsSurface::bezier([2, 2], points.collect(), vec![1.0; 9]).expect("a patch"));
    }
    surfaces
}

#[test]
fn surfaces_that_face_either_way_are_turned_to_the_side_of_the_first() {
    let surfaces = scrambled_grid(6);
    let model = bezier_model(surfaces.clone());
    let report = model.report();
    assert_eq!((report.exact, report.snapped, report.unjoined.len()), (60, 0, 24));
    let up = |surface: &NurbsSurface| surface.frame(0.5, 0.5).expect("inside").normal.z > 0.0;
    let turned: Vec<u32> = (0..36)
        .filter(|&s| up(&surfaces[s as usize]) != up(&surfaces[0]))
        .collect();
    assert!(turned.len() > 8 && report.transposed == turned);
    assert!(model.surfaces().iter().all(|surface| up(surface) == up(&surfaces[0])));
    assert_same_bits(&model);
}

fn two_squares(gap: f64) -> Vec<NurbsSurface> {
    vec![
        bilinear([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]]),
        bilinear([[1.0 + gap, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 1.0, gap], [2.0, 1.0, 1.0]]),
    ]
}

fn with_tolerance(surfaces: Vec<NurbsSurface>, tolerance: f64) -> Patches {
    let settings = PatchSettings {
        tolerance,
        kind: PatchKind::Bezier,
        ..PatchSettings::default()
    };
    Patches::new(surfaces, settings).expect("a model")
}

#[test]
fn boundaries_within_the_tolerance_are_snapped_and_counted() {
    let counts = |model: &Patches| (model.report().exact, model.report().snapped);
    assert_eq!(counts(&with_tolerance(two_squares(0.0), 0.0)), (1, 0));
    assert_eq!(counts(&with_tolerance(two_squares(1e-7), 0.0)), (0, 0));
    assert_eq!(counts(&with_tolerance(two_squares(1e-4), 1e-6)), (0, 0));
    let model = with_tolerance(two_squares(1e-7), 1e-6);
    assert_eq!(counts(&model), (0, 1));
    assert!((model.report().largest_move - 1e-7).abs() < 1e-15);
    assert_eq!(model.surfaces()[1].points()[0], DVec3::X);
    assert_eq!(model.surfaces()[1].points()[2], DVec3::new(1.0, 1.0, 0.0));
    assert_same_bits(&model);
}

#[test]
fn weights_join_up_to_a_common_factor_and_knots_up_to_scale() {
    let exact = model(rational_neighbours(3.7, 0.0));
    assert_eq!(
        (
            exact.report().exact,
            exact.report().snapped,
            exact.report().unjoined.len()
        ),
        (1, 0, 6)
    );
    let snapped = model(rational_neighbours(3.7, 1e-7));
    assert_eq!((snapped.report().exact, snapped.report().snapped), (0, 1));
    let [first, second] = [0, 1].map(|k| snapped.surfaces()[k].weights());
    let [nu, nv] = snapped.surfaces()[0].point_counts();
    let factor = |j: usize| second[j * nu] / first[nu - 1 + j * nu];
    assert!((1..nv).all(|j| (factor(j) / factor(0) - 1.0).abs() < 1e-14));
    assert_eq!(model(rational_neighbours(3.7, 1e-3)).report().unjoined.len(), 8);
    assert_same_bits(&exact);
    assert_same_bits(&snapped);
}

/// A ruled strip from x to x + 1 whose sides are straight and evenly run through, whatever the knots are.
fn even_strip(x: f64, inner: &[f64]) -> NurbsSurface {
    let knots = clamped(2, inner);
    let along = |j: usize| (knots[j + 1] + knots[j + 2]) / 2.0;
    let count = knots.len() - 3;
    let points = (0..count).flat_map(|j| [0.0, 1.0].map(|i| DVec3::new(x + i, along(j), 0.0)));
    let points: Vec<DVec3> = points.collect();
    NurbsSurface::new([1, 2], [clamped(1, &[]), knots], points, vec![1.0; 2 * count]).expect("a surface")
}

#[test]
fn the_same_curve_by_other_multiplicities_joins_but_is_not_snapped() {
    let counts = |gap: f64| {
        let model = model(vec![
            even_strip(0.0, &[0.25, 0.25, 0.5]),
            even_strip(1.0 + gap, &[0.25, 0.5, 0.5]),
        ]);
        assert_same_bits(&model);
        (model.report().exact, model.report().snapped)
    };
    assert_eq!((counts(0.0), counts(1e-8)), ((1, 0), (0, 0)));
    let same = [0.0, 1.0 + 1e-8].map(|x| even_strip(x, &[0.25, 0.25, 0.5]));
    assert_eq!(model(same.to_vec()).report().snapped, 1);
}

#[test]
fn t_joins_and_third_surfaces_are_reported() {
    let mut surfaces = two_squares(0.0);
    surfaces[1] = bilinear([[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 0.5, 0.0], [2.0, 0.5, 0.0]]);
    surfaces.push(bilinear([
        [1.0, 0.5, 0.0],
        [2.0, 0.5, 0.0],
        [1.0, 1.0, 0.0],
        [2.0, 1.0, 0.0],
    ]));
    let t_join = bezier_model(surfaces);
    let free: Vec<_> = t_join
        .report()
        .unjoined
        .iter()
        .map(|(b, why)| (b.surface, b.side, *why))
        .collect();
    assert_eq!((t_join.report().exact, free.len()), (1, 10));
    for boundary in [(0, Side::UMax), (1, Side::UMin), (2, Side::UMin)] {
        assert!(free.contains(&(boundary.0, boundary.1, Unjoined::Apart)));
    }
    let elsewhere = free.iter().filter(|(.., why)| *why == Unjoined::Free).count();
    assert_eq!((t_join.report().gaps(), elsewhere), (3, 7));

    let mut surfaces = two_squares(0.0);
    surfaces.push(bilinear([
        [1.0, 0.0, 0.0],
        [1.0, 0.0, 5.0],
        [1.0, 1.0, 0.0],
        [1.0, 1.0, 5.0],
    ]));
    let three = bezier_model(surfaces);
    let crowded: Vec<_> = three
        .report()
        .unjoined
        .iter()
        .filter(|(_, why)| *why == Unjoined::Crowded)
        .collect();
    assert_eq!(three.report().exact, 1);
    assert_eq!(
        (crowded.len(), crowded[0].0.surface, crowded[0].0.side, crowded[0].0.at),
        (1, 2, Side::UMin, 0.0)
    );
}

#[test]
fn knots_of_full_multiplicity_tear_unless_their_points_coincide() {
    let knots = |multiplicity| [clamped(2, &vec![0.5; multiplicity]), clamped(1, &[0.4])];
    let crease = model(vec![sheet([2, 1], knots(2), 0.0, 8)]);
    assert_eq!((crease.report().exact, crease.report().unjoined.len()), (0, 4));
    assert!(crease.topology().twin(0, 1).is_some());

    let torn = sheet([2, 1], knots(3), 0.0, 8);
    let open = model(vec![torn.clone()]);
    assert_eq!((open.report().exact, open.report().unjoined.len()), (0, 8));
    assert!(open.topology().twin(0, 1).is_none());
    let tears: Vec<_> = open
        .report()
        .unjoined
        .iter()
        .filter(|(b, _)| b.at == 0.5)
        .map(|(b, _)| b.side)
        .collect();
    assert_eq!(tears, [Side::UMax, Side::UMin]);

    let mut points = torn.points().to_vec();
    (0..3).for_each(|j| points[3 + 6 * j] = points[2 + 6 * j]);
    let closed = NurbsSurface::new([2, 1], knots(3), points, vec![1.0; 18]).expect("a surface");
    let closed = model(vec![closed]);
    assert_eq!((closed.report().exact, closed.report().unjoined.len()), (1, 6));
    assert!(closed.topology().twin(0, 1).is_some());
    assert_same_bits(&closed);
}

#[test]
fn unclamped_boundaries_join_when_they_are_the_same_curve() {
    let integers = |range: std::ops::Range<usize>| -> Vec<f64> { range.map(|k| k as f64).collect() };
    // Two parts of one surface with uniform knots.
    let whole = sheet([3, 3], [integers(0..12), clamped(3, &[0.5])], 0.3, 9);
    let [nu, nv] = whole.point_counts();
    let part = |columns: std::ops::Range<usize>, shift: f64| {
        let places: Vec<usize> = (0..nv).flat_map(|j| columns.clone().map(move |i| i + j * nu)).collect();
        let points = places.iter().map(|&k| whole.points()[k] + DVec3::X * shift).collect();
        let weights = places.iter().map(|&k| whole.weights()[k]).collect();
        let knots = [integers(columns.start..columns.end + 4), clamped(3, &[0.5])];
        NurbsSurface::new([3, 3], knots, points, weights).expect("a surface")
    };
    let joined = model(vec![part(0..5, 0.0), part(2..7, 0.0)]);
    assert_eq!((joined.report().exact, joined.report().unjoined.len()), (1, 6));
    assert_same_bits(&joined);
    // They have no control points of their own to snap.
    let apart = model(vec![part(0..5, 0.0), part(2..7, 1e-8)]);
    assert_eq!((apart.report().exact, apart.report().snapped), (0, 0));

    // Uniform knots, closed by repeating degree control points.
    let ring = |i: usize, j: usize| {
        let angle = std::f64::consts::TAU * (i % 6) as f64 / 6.0;
        DVec3::new(angle.cos(), angle.sin(), j as f64)
    };
    let points = (0..4).flat_map(|j| (0..9).map(move |i| ring(i, j))).collect();
    let tube = NurbsSurface::new([3, 3], [integers(0..13), clamped(3, &[])], points, vec![1.0; 36]).expect("a surface");
    let tube = model(vec![tube]);
    assert_eq!(
        (
            tube.report().exact,
            tube.report().unjoined.len(),
            tube.topology().vertex_count()
        ),
        (1, 2, 12)
    );
    assert_same_bits(&tube);
}

#[test]
fn nearly_collapsed_boundaries_become_poles_and_touching_faces_share_them() {
    let leaf = |from: f64, to: f64| {
        let rim = |a: f64| [a.cos(), a.sin(), 0.0];
        bilinear([[0.0, 0.0, 1.0], [1e-9, 0.0, 1.0 - 1e-9], rim(from), rim(to)])
    };
    let model = bezier_model((0..5).map(|k| leaf(f64::from(k), f64::from(k + 1))).collect());
    let report = model.report();
    assert_eq!((report.poles.len(), report.poles[0].faces.len()), (1, 5));
    assert_eq!(report.poles[0].position, DVec3::Z);
    assert!(report.largest_move > 0.0 && report.exact + report.snapped == 4);
    assert_same_bits(&model);
}

#[test]
fn the_tea_set_joins() {
    // Joined, unjoined, poles of the teapot's lid and bottom; cup and spoon have none.
    for (name, poles) in [("teapot", 2), ("teacup", 0), ("teaspoon", 0)] {
        let Some(table) = oracle(&format!("bezier/{name}.json")) else {
            return;
        };
        let model = bezier_model(tea_set(&table));
        let report = model.report();
        println!(
            "{name}: {} exact, {} snapped by at most {:e}, {} unjoined, {} poles, transposed {:?}",
            report.exact,
            report.snapped,
            report.largest_move,
            report.unjoined.len(),
            report.poles.len(),
            report.transposed
        );
        assert_eq!(report.poles.len(), poles, "{name}: {:?}", report.poles);
        assert!(report.exact as usize >= model.surfaces().len(), "{name}");
        let boundaries = 4 * model.surfaces().len();
        let collapsed: usize = report.poles.iter().map(|pole| pole.faces.len()).sum();
        let joined = 2 * (report.exact + report.snapped) as usize;
        assert_eq!(joined + report.unjoined.len() + collapsed, boundaries);
        assert_same_bits(&model);
    }
}
