//! Knot spans that are cut: the shape and the joins stay, KSQuads become even.

use crate::joins::{assert_same_bits, is_closed, scrambled_grid};
use crate::models::{bilinear, clamped, rational_neighbours, sheet, sphere, torus};
use crate::random::Random;
use glam::DVec3;
use keyleaf_surface::{NurbsSurface, PatchKind, PatchSettings, Patches, Surface};

fn even(surfaces: Vec<NurbsSurface>) -> Patches {
    let settings = PatchSettings {
        even_spans: true,
        ..PatchSettings::default()
    };
    Patches::new(surfaces, settings).expect("a model")
}

fn mapped(surface: &NurbsSurface, map: impl Fn(DVec3) -> DVec3) -> NurbsSurface {
    let [u, v] = surface.knots().map(<[f64]>::to_vec);
    let points = surface.points().iter().map(|&p| map(p)).collect();
    NurbsSurface::new(surface.degree(), [u, v], points, surface.weights().to_vec()).expect("a surface")
}

/// Knots of any multiplicity up to the degree, 1e-3 to 1 apart, far from zero or not, clamped or not.
fn knots(random: &mut Random, degree: u32) -> Vec<f64> {
    let is_clamped = random.below(2) == 0;
    let ends = if is_clamped { degree + 1 } else { 1 };
    let mut at = [0.0, 100.0, -37.5][random.below(3) as usize];
    let mut knots = vec![at; ends as usize];
    for _ in 0..2 + random.below(3) + if is_clamped { 0 } else { 2 * degree } {
        at += [1.0, 0.3, 1e-3][random.below(3) as usize];
        knots.extend((0..1 + random.below(degree)).map(|_| at));
    }
    knots.extend((0..ends).map(|_| at + 0.4));
    knots
}

/// A sheet with waves along v that are higher and longer than those along u, or the other way round.
fn long_sheet(seed: u64) -> NurbsSurface {
    let mut random = Random(seed);
    let degree = [0, 1].map(|_| 1 + random.below(5));
    let knots = degree.map(|p| knots(&mut random, p));
    let base = sheet(degree, knots, 2.0, seed);
    let stretch = 4.0 + 12.0 * random.unit();
    let is_long_in_v = random.below(2) == 0;
    mapped(&base, |p| {
        let (along, across) = if is_long_in_v { (p.y, p.x) } else { (p.x, p.y) };
        let wave = stretch * (9.0 * along).sin() + 0.1 * p.z;
        let long = if is_long_in_v { DVec3::Y } else { DVec3::X };
        let short = DVec3::X + DVec3::Y - long;
        long * along * stretch + short * across + DVec3::Z * wave
    })
}

#[test]
fn points_and_derivatives_stay_where_they_are() {
    let (mut cut, mut worst) = (0, [0.0f64; 2]);
    for seed in 0..120 {
        let surface = long_sheet(seed);
        let model = even(vec![surface.clone()]);
        let [parts_u, parts_v] = model.parts_of_spans(0);
        assert!([1, 2, 4, 8].contains(&(parts_u * parts_v)) && parts_u.min(parts_v) == 1);
        cut += u32::from(parts_u * parts_v > 1);
        let faces = Patches::new(vec![surface.clone()], PatchSettings::default()).expect("a model");
        assert_eq!(
            model.topology().face_count(),
            parts_u * parts_v * faces.topology().face_count()
        );
        let even = &model.surfaces()[0];
        assert_eq!(even.domain(), surface.domain());
        let size = surface.points().iter().map(|p| p.length()).fold(0.0, f64::max);
        let mut random = Random(seed);
        let frames: Vec<_> = (0..200)
            .map(|_| {
                let [s, t] = surface.domain().map(|[low, high]| low + (high - low) * random.unit());
                [&surface, even].map(|surface| surface.frame(s, t).expect("in the domain"))
            })
            .collect();
        let largest = |of: fn(&keyleaf_surface::SurfaceFrame) -> DVec3| {
            frames.iter().map(|[frame, _]| of(frame).length()).fold(0.0, f64::max)
        };
        let [du, dv] = [largest(|frame| frame.du), largest(|frame| frame.dv)];
        for [a, b] in &frames {
            worst[0] = worst[0].max(a.position.distance(b.position) / size);
            worst[1] = worst[1].max(a.du.distance(b.du) / du).max(a.dv.distance(b.dv) / dv);
        }
    }
    println!(
        "{cut} of 120 are cut; positions differ by at most {:e} of the size, derivatives by {:e}",
        worst[0], worst[1]
    );
    assert!(cut > 50 && worst[0] < 1e-14 && worst[1] < 1e-13);
}

#[test]
fn joined_models_join_as_before() {
    let stretch = |surfaces: Vec<NurbsSurface>| -> Vec<NurbsSurface> {
        let long = |p: DVec3| DVec3::new(p.x, 7.0 * p.y, p.z);
        surfaces.iter().map(|surface| mapped(surface, long)).collect()
    };
    let tall = |surface: NurbsSurface| mapped(&surface, |p| DVec3::new(p.x, p.y, 6.0 * p.z));
    for (name, surfaces) in [
        ("grid", stretch(scrambled_grid(6))),
        ("torus", vec![torus()]),
        ("sphere", vec![tall(sphere())]),
        ("neighbours", stretch(rational_neighbours(3.7, 0.0))),
        ("snapped neighbours", stretch(rational_neighbours(3.7, 1e-7))),
    ] {
        let before = Patches::new(surfaces.clone(), PatchSettings::default()).expect("a model");
        let after = even(surfaces);
        let faces = [&before, &after].map(|model| model.topology().face_count());
        let [was, is] = [before.report(), after.report()];
        println!(
            "{name}: {} faces, {} after cuts, moved by {:e}",
            faces[0], faces[1], is.largest_move
        );
        assert!(faces[1] > faces[0], "{name}");
        assert_eq!(
            (was.exact, was.snapped, &was.unjoined),
            (is.exact, is.snapped, &is.unjoined),
            "{name}"
        );
        assert_eq!(was.transposed, is.transposed, "{name}");
        let poles = |model: &Patches| -> Vec<DVec3> { model.report().poles.iter().map(|pole| pole.position).collect() };
        assert_eq!(poles(&before), poles(&after), "{name}");
        assert_eq!(is_closed(&before), is_closed(&after), "{name}");
        assert!(
            (is.largest_move - was.largest_move).abs() <= 1e-14 + 0.1 * was.largest_move,
            "{name}"
        );
        assert_same_bits(&after);
    }
}

#[test]
fn control_points_of_joined_boundaries_are_the_same_after_cuts() {
    for error in [0.0, 1e-7] {
        let stretch = |p: DVec3| DVec3::new(p.x, 7.0 * p.y, p.z);
        let surfaces = rational_neighbours(3.7, error);
        let model = even(surfaces.iter().map(|surface| mapped(surface, stretch)).collect());
        assert!(model.parts_of_spans(0)[1] > 1 && model.parts_of_spans(0) == model.parts_of_spans(1));
        let [first, second] = model.surfaces() else { panic!() };
        let [nu, nv] = first.point_counts();
        assert!((0..nv).all(|j| first.points()[nu - 1 + j * nu] == second.points()[j * nu]));
    }
}

/// A flat strip over the rectangle of these sides, of one span.
fn rectangle(x: f64, [width, height]: [f64; 2]) -> NurbsSurface {
    let at = |i: f64, j: f64| [x + i * width, j * height, 0.0];
    bilinear([at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0), at(1.0, 1.0)])
}

#[test]
fn flat_surfaces_go_by_lengths_and_joined_ones_are_cut_alike() {
    let parts = |model: &Patches| -> Vec<[u32; 2]> {
        (0..model.surfaces().len() as u32)
            .map(|surface| model.parts_of_spans(surface))
            .collect()
    };
    for (height, expected) in [(1.0, 1), (1.4, 1), (1.5, 2), (2.7, 2), (4.0, 4), (9.0, 8), (100.0, 8)] {
        assert_eq!(
            parts(&even(vec![rectangle(0.0, [1.0, height])])),
            [[1, expected]],
            "{height}"
        );
        assert_eq!(
            parts(&even(vec![rectangle(0.0, [height, 1.0])])),
            [[expected, 1]],
            "{height}"
        );
    }
    // Eight parts for the narrow ones, one for the wide one: two take the fewest triangles. The second has u and v exchanged.
    let turned = rectangle(1.0, [1.0, 8.0]).transposed();
    let row = vec![rectangle(0.0, [1.0, 8.0]), turned, rectangle(2.0, [8.0, 8.0])];
    assert_eq!(parts(&even(row)), [[1, 2], [2, 1], [1, 2]]);
    // Alone, a neighbour is as it would be without the first.
    let apart = vec![rectangle(0.0, [1.0, 8.0]), rectangle(1.5, [1.0, 1.0])];
    assert_eq!(parts(&even(apart)), [[1, 8], [1, 1]]);
}

#[test]
fn only_the_curved_direction_of_a_ruled_surface_is_cut() {
    let arch = |width: f64, height: f64| {
        let at = |i: usize, j: usize| DVec3::new(i as f64 * width, j as f64 * height, [0.0, 0.5, 0.0][i]);
        let points = (0..6).map(|k| at(k % 3, k / 3)).collect();
        let surface = NurbsSurface::bezier([2, 1], points, vec![1.0; 6]).expect("a patch");
        even(vec![surface]).parts_of_spans(0)
    };
    assert_eq!((arch(0.5, 20.0), arch(4.0, 1.0)), ([1, 1], [8, 1]));
}

#[test]
fn a_surface_joined_with_itself_at_both_parameters_is_left_whole() {
    let point = |i: usize, j: usize| match (i, j) {
        (k, 0) | (0, k) => DVec3::new(k as f64, 0.0, 0.0),
        _ => DVec3::new(i as f64 + j as f64, 3.0 + 20.0 * j as f64, (i * j) as f64),
    };
    let points = (0..9).map(|k| point(k % 3, k / 3)).collect();
    let cone = NurbsSurface::bezier([2, 2], points, vec![1.0; 9]).expect("a patch");
    let model = even(vec![cone]);
    let settings = (model.report().exact, model.report().unjoined.len());
    assert_eq!((settings, model.parts_of_spans(0)), ((1, 2), [1, 1]));
}

#[test]
fn bezier_patches_stay_single() {
    let settings = PatchSettings {
        kind: PatchKind::Bezier,
        even_spans: true,
        ..PatchSettings::default()
    };
    let model = Patches::new(vec![rectangle(0.0, [1.0, 8.0])], settings).expect("a model");
    assert_eq!((model.parts_of_spans(0), model.topology().face_count()), ([1, 1], 1));
}

#[test]
fn tears_and_spans_too_short_to_cut_are_kept() {
    let torn = sheet([2, 2], [clamped(2, &[0.5, 0.5, 0.5]), clamped(2, &[])], 0.0, 3);
    let torn = mapped(&torn, |p| DVec3::new(p.x, 20.0 * p.y, p.z + 40.0 * p.y * p.y));
    let before = Patches::new(vec![torn.clone()], PatchSettings::default()).expect("a model");
    let after = even(vec![torn]);
    assert!(after.parts_of_spans(0)[1] > 1);
    assert_eq!(before.report().unjoined, after.report().unjoined);
    let short = [clamped(1, &[]), vec![1.0, 1.0, 1.0 + 4.0 * f64::EPSILON, 2.0, 2.0]];
    let short = mapped(&sheet([1, 1], short, 0.0, 3), |p| DVec3::new(p.x, 50.0 * p.y, p.z));
    assert_eq!(even(vec![short]).parts_of_spans(0), [1, 1]);
}
