//! Points by the parameters of a surface's own knots.

use crate::models::{bilinear, clamped, model, sheet};
use glam::DVec3;
use keyleaf_surface::{CornerAttributes, Mesh, ParameterError, PolygonMesh, Surface};

#[test]
fn own_parameters_find_the_span_and_its_rates() {
    let knots = [
        vec![1e4, 1e4, 1e4, 1e4 + 0.5, 1e4 + 2.0, 1e4 + 2.0, 1e4 + 2.0],
        clamped(1, &[0.25]),
    ];
    let model = model(vec![sheet([2, 1], knots, 0.0, 1)]);
    let own = |s, t| model.own_coord(0, s, t).expect("in the domain");
    // A knot belongs to the span on its right; the end of the domain to the last.
    for (s, t, face, rates) in [
        (1e4, 0.0, 0, [2.0, 4.0]),
        (1e4 + 0.25, 0.25, 2, [2.0, 1.0 / 0.75]),
        (1e4 + 0.5, 0.1, 1, [1.0 / 1.5, 4.0]),
        (1e4 + 2.0, 1.0, 3, [1.0 / 1.5, 1.0 / 0.75]),
    ] {
        let coord = own(s, t);
        assert_eq!(
            (coord.at.face, coord.rates, coord.transposed),
            (face, rates, false),
            "{s} {t}"
        );
    }
    let (at, frame) = (own(1e4 + 1.25, 0.625), model.surfaces()[0].frame(1e4 + 1.25, 0.625));
    assert_eq!(model.point(at.at), frame.expect("in the domain").position);
}

#[test]
fn transposed_surfaces_keep_their_own_parameters() {
    let first = bilinear([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]]);
    let points = [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [3.0, 0.0, 0.0], [3.0, 1.0, 4.0]];
    let turned = bilinear(points);
    let model = model(vec![first, turned.clone()]);
    assert_eq!(model.report().transposed, [1]);
    for (s, t) in [(0.25, 0.75), (0.0, 1.0), (1.0, 0.5)] {
        let coord = model.own_coord(1, s, t).expect("in the domain");
        let (own, frame) = (turned.frame(s, t).expect("in the domain"), model.frame(coord.at));
        assert!(coord.transposed);
        assert_eq!(frame.position, own.position);
        assert_eq!((frame.dv * coord.rates[0], frame.du * coord.rates[1]), (own.du, own.dv));
        assert!(frame.normal.distance(-own.normal) < 1e-15);
    }
    let error = model.own_coord(1, 0.5, 1.5).expect_err("outside");
    assert_eq!(
        error.to_string(),
        "(0.5, 1.5) is not in surface 1: expected 0 <= s <= 1 and 0 <= t <= 1"
    );
}

#[test]
fn parameters_that_do_not_exist_are_refused() {
    let knots = [clamped(2, &[0.5, 0.5, 0.5]), vec![3.0, 4.0, 5.0, 6.0, 7.0, 8.0]];
    let surface = sheet([2, 2], knots, 0.0, 2);
    assert_eq!(surface.domain(), [[0.0, 1.0], [5.0, 6.0]]);
    let model = model(vec![surface]);
    for (s, t) in [
        (-1e-9, 5.5),
        (1.0 + 1e-9, 5.5),
        (f64::NAN, 5.5),
        (0.5, 4.9),
        (0.5, f64::NAN),
        (f64::INFINITY, 5.5),
    ] {
        for error in [
            model.own_coord(0, s, t).expect_err("outside"),
            model.surfaces()[0].frame(s, t).expect_err("outside"),
        ] {
            assert!(
                matches!(error, ParameterError::OutsideSurface { surface: 0, .. }),
                "{error}"
            );
        }
    }
    let missing = model.own_coord(1, 0.0, 5.0).expect_err("one surface");
    assert_eq!(
        missing,
        ParameterError::Surface {
            surface: 1,
            surfaces: 1
        }
    );
    let triangle = PolygonMesh {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
        faces: [[0, 1, 2]].into_iter().collect(),
        corners: CornerAttributes::default(),
    };
    let mesh = Mesh::new(&triangle).expect("a mesh");
    assert_eq!(mesh.own_coord(0, 0.0, 0.0), Err(ParameterError::NoOwnParameters));
}
