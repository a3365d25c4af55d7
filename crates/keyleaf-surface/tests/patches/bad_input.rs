//! What is refused, and how the message names it.

use crate::models::{bilinear, clamped};
use glam::DVec3;
use keyleaf_surface::{NurbsSurface, PatchError, PatchKind, PatchSettings, Patches};

/// What a surface is made of.
struct Numbers {
    degree: [u32; 2],
    knots: [Vec<f64>; 2],
    points: Vec<DVec3>,
    weights: Vec<f64>,
}

/// The message for degrees (2, 1), clamped knots and six points, with one thing changed.
fn refused(change: impl FnOnce(&mut Numbers)) -> String {
    let mut n = Numbers {
        degree: [2, 1],
        knots: [clamped(2, &[]), clamped(1, &[])],
        points: (0..6).map(|k| DVec3::splat(f64::from(k))).collect(),
        weights: vec![1.0; 6],
    };
    change(&mut n);
    let error = NurbsSurface::new(n.degree, n.knots, n.points, n.weights).expect_err("no surface");
    error.to_string()
}

#[test]
fn every_wrong_number_is_named() {
    let table: [(String, &str); 17] = [
        (refused(|n| n.degree[1] = 0), "the degree in v is 0; expected 1 to 7"),
        (refused(|n| n.degree[0] = 8), "the degree in u is 8; expected 1 to 7"),
        (
            refused(|n| n.knots[0].truncate(5)),
            "there are 5 knots in u; degree 2 needs at least 6",
        ),
        (
            refused(|n| n.knots[1][2] = f64::NAN),
            "knot 2 in v is NaN; expected a finite number of at most 1e15",
        ),
        (
            refused(|n| n.knots[1][3] = f64::INFINITY),
            "knot 3 in v is inf; expected a finite number of at most 1e15",
        ),
        (
            refused(|n| n.knots[0][4] = 0.5),
            "knot 4 in u is 0.5, less than the knot before it, 1",
        ),
        (
            refused(|n| n.knots[1] = vec![0.0, 0.5, 0.5, 1.0]),
            "the domain in v is empty: knots 1 and 2 are both 0.5",
        ),
        (
            refused(|n| n.knots[1] = clamped(1, &[0.5; 3])),
            "the knot 0.5 in v, first at 2, is there 3 times; inside the domain at most degree + 1 = 2 are possible",
        ),
        (
            refused(|n| n.knots[1] = vec![0.0, 0.0, 1e-40, 1.0, 1.0]),
            "knots 1 and 2 in v differ by only 1e-40; make them equal",
        ),
        (
            refused(|n| n.points.truncate(5)),
            "there are 5 control points; knots and degrees ask for 3 x 2",
        ),
        (
            refused(|n| n.weights.push(1.0)),
            "there are 7 weights; knots and degrees ask for 3 x 2",
        ),
        (
            refused(|n| n.points[4].y = f64::NAN),
            "control point 4 is (4, NaN, 4); expected finite coordinates of at most 1e15",
        ),
        (
            refused(|n| n.points[5].z = 2e15),
            "control point 5 is (5, 5, 2000000000000000); expected finite coordinates of at most 1e15",
        ),
        (
            refused(|n| n.weights[3] = -1e-9),
            "the weight of control point 3 is -0.000000001; expected a number from 0 to 1e15",
        ),
        (
            refused(|n| n.weights[3] = f64::NAN),
            "the weight of control point 3 is NaN; expected a number from 0 to 1e15",
        ),
        (
            refused(|n| n.weights.fill(0.0)),
            "the control points of spans 0 in u and 0 in v weigh nothing",
        ),
        (
            refused(|n| {
                n.knots[1] = clamped(1, &[0.25, 0.25, 0.5, 0.5]);
                n.points = vec![DVec3::ONE; 18];
                n.weights = [vec![1.0; 6], vec![0.0; 6], vec![1.0; 6]].concat();
            }),
            "the control points of spans 0 in u and 1 in v weigh nothing",
        ),
    ];
    for (message, expected) in table {
        assert_eq!(message, expected);
    }
}

#[test]
fn models_that_are_none_are_refused() {
    let patch = || bilinear([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]]);
    let new = |surfaces, tolerance, kind| {
        let settings = PatchSettings {
            tolerance,
            kind,
            ..PatchSettings::default()
        };
        Patches::new(surfaces, settings).map(|_| ())
    };
    assert_eq!(new(Vec::new(), 1e-6, PatchKind::Bezier), Err(PatchError::Empty));
    for tolerance in [f64::NAN, -1e-9, 0.02, f64::INFINITY] {
        let error = new(vec![patch()], tolerance, PatchKind::Bezier).expect_err("a tolerance");
        assert!(error.to_string().starts_with("tolerance is"), "{error}");
    }
    let points = (0..6)
        .map(|k| DVec3::new(f64::from(k % 3), f64::from(k / 3), 0.0))
        .collect();
    let two_spans = NurbsSurface::new([1, 1], [clamped(1, &[0.5]), clamped(1, &[])], points, vec![1.0; 6]);
    let two_spans = two_spans.expect("a surface");
    assert_eq!(
        new(vec![patch(), two_spans], 1e-6, PatchKind::Bezier),
        Err(PatchError::NotBezier { surface: 1 })
    );
    assert_eq!(new(vec![patch()], 0.0, PatchKind::Bezier), Ok(()));
}

#[test]
fn single_weights_of_zero_and_all_multiplicities_are_fine() {
    for multiplicity in 1..=4 {
        let knots = [clamped(3, &vec![0.5; multiplicity]), clamped(1, &[])];
        let count = 2 * (4 + multiplicity);
        let points = (0..count).map(|k| DVec3::splat(k as f64)).collect();
        let mut weights = vec![1.0; count];
        weights[1] = 0.0;
        assert!(NurbsSurface::new([3, 1], knots, points, weights).is_ok());
    }
}
