//! Bézier patches in dual space: values, derivatives, parts, normals.

use crate::models::{Random, combined, disk, sheet, square, triangle};
use glam::{DMat3, DVec3};
use keyleaf_surface::gaussian::{Covariance, Dual, DualFrame, DualJet, DualSquare, DualTriangle, MeanJet};

/// A patch as a function of (u, v) in object space.
type Surface = Box<dyn Fn(f64, f64) -> MeanJet>;

fn surfaces() -> Vec<Surface> {
    let mut random = Random(5);
    let mut all: Vec<Surface> = Vec::new();
    for (condition, turn) in [(1.0, 0.0), (1e2, 0.2), (1e4, 0.05), (1e2, 3.0)] {
        let gaussians = sheet(4, condition, turn, &mut random);
        let frame = DualFrame::whitened(&gaussians);
        let patch = square(&gaussians, &frame);
        all.push(Box::new(move |u, v| {
            patch.jet([u, v]).mean().expect("definite").in_object_space(&frame)
        }));
        let (patch, frame) = triangle(condition, turn, &mut random);
        all.push(Box::new(move |u, v| {
            patch.jet([u, v]).mean().expect("definite").in_object_space(&frame)
        }));
    }
    all
}

#[test]
fn derivatives_are_those_of_the_mean() {
    let step = 1e-5;
    for surface in surfaces() {
        for (u, v) in [(0.2, 0.3), (0.5, 0.1), (0.31, 0.62)] {
            let jet = surface(u, v);
            let largest = jet.second.iter().map(|d| d.length()).fold(1.0, f64::max);
            let [left, right, below, above] =
                [(-step, 0.0), (step, 0.0), (0.0, -step), (0.0, step)].map(|(a, b)| surface(u + a, v + b));
            let slope = |a: DVec3, b: DVec3| (b - a) / (2.0 * step);
            let pairs = [
                (jet.first[0], slope(left.mean, right.mean)),
                (jet.first[1], slope(below.mean, above.mean)),
                (jet.second[0], slope(left.first[0], right.first[0])),
                (jet.second[1], slope(left.first[1], right.first[1])),
                (jet.second[1], slope(below.first[0], above.first[0])),
                (jet.second[2], slope(below.first[1], above.first[1])),
            ];
            for (own, difference) in pairs {
                assert!(
                    own.distance(difference) < 1e-6 * largest * largest,
                    "{own} {difference} {largest}"
                );
            }
        }
    }
}

#[test]
fn weights_of_basis_functions_give_the_same_as_the_patch() {
    let mut random = Random(9);
    let gaussians = sheet(4, 1e3, 0.3, &mut random);
    let frame = DualFrame::whitened(&gaussians);
    let controls: Vec<Dual> = gaussians
        .iter()
        .map(|(mean, covariance)| Dual::of(*mean, covariance, &frame))
        .collect();
    let patch = DualSquare::new([3, 3], controls.clone()).expect("16 control points");
    let (u, v) = (0.3, 0.8);
    let bernstein = |t: f64| {
        let s: f64 = 1.0 - t;
        [
            [s * s * s, -3.0 * s * s, 6.0 * s],
            [3.0 * s * s * t, 3.0 * s * s - 6.0 * s * t, 6.0 * t - 12.0 * s],
            [3.0 * s * t * t, 6.0 * s * t - 3.0 * t * t, 6.0 * s - 12.0 * t],
            [t * t * t, 3.0 * t * t, 6.0 * t],
        ]
    };
    let (a, b) = (bernstein(u), bernstein(v));
    let basis = |k: usize| {
        let (a, b) = (a[k % 4], b[k / 4]);
        [
            a[0] * b[0],
            a[1] * b[0],
            a[0] * b[1],
            a[2] * b[0],
            a[1] * b[1],
            a[0] * b[2],
        ]
    };
    let weighted = DualJet::weighted(controls.iter().enumerate().map(|(k, &control)| (control, basis(k))));
    for (own, other) in weighted.terms.iter().zip(patch.jet([u, v]).terms) {
        let pairs = own.to_array().into_iter().zip(other.to_array());
        assert!(
            pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-11),
            "{own:?} {other:?}"
        );
    }
}

#[test]
fn every_frame_gives_the_same_surface() {
    let mut random = Random(4);
    let gaussians = sheet(4, 1e4, 0.5, &mut random);
    let frames = [
        DualFrame::OBJECT,
        DualFrame::scaled(&gaussians),
        DualFrame::whitened(&gaussians),
        DualFrame {
            centre: DVec3::new(3.0, -2.0, 1.0),
            axes: DMat3::from_diagonal(DVec3::new(2.0, 0.1, -5.0)),
        },
    ];
    let jets = frames.map(|frame| {
        square(&gaussians, &frame)
            .jet([0.4, 0.7])
            .mean()
            .expect("definite")
            .in_object_space(&frame)
    });
    for jet in jets {
        assert!(jet.mean.distance(jets[0].mean) < 1e-11, "{jet:?} {:?}", jets[0]);
        assert!(jet.first[0].distance(jets[0].first[0]) < 1e-10);
        assert!(jet.second[2].distance(jets[0].second[2]) < 1e-9);
    }
}

/// Rows of subdivision matrices have negative entries, so that a control point need not be a Gaussian.
#[test]
fn control_points_may_be_indefinite_while_the_surface_is_not() {
    let mut random = Random(14);
    let gaussians = sheet(4, 1e2, 3.0, &mut random);
    let frame = DualFrame::whitened(&gaussians);
    let duals: Vec<Dual> = gaussians
        .iter()
        .map(|(mean, covariance)| Dual::of(*mean, covariance, &frame))
        .collect();
    // The cubic Lagrange polynomials: the curve passes through the four points, its inner control points lie outside.
    let through = [
        [6.0, 0.0, 0.0, 0.0],
        [-5.0, 18.0, -9.0, 2.0],
        [2.0, -9.0, 18.0, -5.0],
        [0.0, 0.0, 0.0, 6.0],
    ];
    let spline = [
        [1.0, 4.0, 1.0, 0.0],
        [0.0, 4.0, 2.0, 0.0],
        [0.0, 2.0, 4.0, 0.0],
        [0.0, 1.0, 4.0, 1.0],
    ];
    let mut seen = 0;
    for share in [0.2, 0.3, 0.4, 0.5, 0.6, 0.7] {
        let mix = |r: usize, k: usize| (through[r][k] * share + spline[r][k] * (1.0 - share)) / 6.0;
        let rows = [0, 1, 2, 3].map(|r| [0, 1, 2, 3].map(|k| mix(r, k)));
        let patch = combined(&duals, rows);
        let control = |k: usize| {
            (0..16).fold(Dual::default(), |sum, i| {
                sum + duals[i] * (rows[k % 4][i % 4] * rows[k / 4][i / 4])
            })
        };
        let indefinite = (0..16).filter(|&k| control(k).mean().is_none()).count();
        let grid = (0..=40).flat_map(|i| (0..=40).map(move |j| [f64::from(i) / 40.0, f64::from(j) / 40.0]));
        let points: Vec<Option<DVec3>> = grid.map(|at| Some(frame.point(patch.jet(at).mean()?.mean))).collect();
        let missing = points.iter().filter(|point| point.is_none()).count();
        let bounds = patch.bounds(&frame, 4000);
        println!("{share}: {indefinite} of 16 control points indefinite, {missing} of 1681 points of the surface");
        match bounds {
            // Never where a precision is indefinite.
            Some(bounds) => {
                assert_eq!(missing, 0);
                let room = 1e-12;
                let is_inside = |p: &DVec3| p.cmpge(bounds.low - room).all() && p.cmple(bounds.high + room).all();
                assert!(points.iter().flatten().all(is_inside));
                seen += usize::from(indefinite > 0);
            }
            None => assert!(missing > 0, "{share}: no bounds"),
        }
    }
    assert!(seen > 0, "no surface was definite over indefinite control points");
}

#[test]
fn normals_have_unit_length_also_where_derivatives_vanish() {
    let mut random = Random(2);
    let one = (DVec3::new(1.0, 2.0, 3.0), disk(1e3, random.rotation(3.0)));
    // All Gaussians are one: the surface is a point.
    let frame = DualFrame::whitened(&[one; 16]);
    let jet = square(&[one; 16], &frame)
        .jet([0.5, 0.5])
        .mean()
        .expect("definite")
        .in_object_space(&frame);
    assert!(jet.mean.distance(one.0) < 1e-15);
    assert_eq!(jet.frame(DVec3::Y).normal, DVec3::Y);
    // Two rows of control points are one point each.
    let gaussians: Vec<(DVec3, Covariance)> = sheet(4, 10.0, 0.5, &mut random);
    let collapsed: Vec<_> = gaussians
        .iter()
        .enumerate()
        .map(|(k, &g)| if k < 8 { gaussians[0] } else { g })
        .collect();
    let frame = DualFrame::whitened(&collapsed);
    let controls = collapsed
        .iter()
        .map(|(mean, covariance)| Dual::of(*mean, covariance, &frame))
        .collect();
    let patch = DualSquare::new([3, 3], controls).expect("16 control points");
    for u in [0.0, 0.5, 1.0] {
        let normal = patch
            .jet([u, 0.0])
            .mean()
            .expect("definite")
            .in_object_space(&frame)
            .frame(DVec3::Z)
            .normal;
        assert!((normal.length() - 1.0).abs() < 1e-12);
    }
}

#[test]
fn the_wrong_number_of_control_points_makes_no_patch() {
    let controls = vec![Dual::default(); 15];
    assert!(
        DualSquare::new([3, 3], controls.clone()).is_none() && DualSquare::new([0, 14], controls.clone()).is_none()
    );
    assert!(DualTriangle::new(3, controls.clone()).is_none() && DualTriangle::new(4, controls).is_some());
    assert!(DualTriangle::new(0, vec![Dual::default()]).is_none());
    assert!(DualJet::default().mean().is_none());
}
