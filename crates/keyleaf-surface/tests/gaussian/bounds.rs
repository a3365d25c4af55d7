//! Bounds of patches against many points of them.

use crate::models::{Random, disk, sheet, square, triangle};
use glam::DVec3;
use keyleaf_surface::gaussian::{Dual, DualFrame, DualSquare, MeanBounds, MeanJet, Symmetric3};

/// Into how many parts a patch may be cut.
const PARTS: usize = 600;

/// Least box and lengths that hold these points.
#[derive(Default)]
struct Extent {
    points: Vec<DVec3>,
    first: [f64; 2],
    second: [f64; 3],
}

impl Extent {
    fn add(&mut self, mean: DVec3, first: [DVec3; 2], second: [DVec3; 3]) {
        self.points.push(mean);
        self.first
            .iter_mut()
            .zip(first)
            .for_each(|(largest, d)| *largest = largest.max(d.length()));
        self.second
            .iter_mut()
            .zip(second)
            .for_each(|(largest, d)| *largest = largest.max(d.length()));
    }

    /// How many times too large the bounds are: of the box's diagonal, of first and of second derivatives.
    fn check(&self, bounds: &MeanBounds) -> [f64; 3] {
        let room = 1e-12;
        for point in &self.points {
            assert!(
                point.cmpge(bounds.low - room).all() && point.cmple(bounds.high + room).all(),
                "{point} {bounds:?}"
            );
        }
        let pairs = || {
            self.first
                .iter()
                .zip(&bounds.first)
                .chain(self.second.iter().zip(&bounds.second))
        };
        assert!(
            pairs().all(|(own, bound)| *own <= bound * (1.0 + 1e-9) + 1e-10),
            "{:?} {:?} {bounds:?}",
            self.first,
            self.second
        );
        let low = self.points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = self.points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        let ratio = |own: &[f64], bound: &[f64]| {
            bound.iter().fold(0.0, |a: f64, &b| a.max(b)) / own.iter().fold(1e-300, |a: f64, &b| a.max(b))
        };
        [
            bounds.low.distance(bounds.high) / low.distance(high),
            ratio(&self.first, &bounds.first),
            ratio(&self.second, &bounds.second),
        ]
    }
}

const CASES: [(f64, f64); 7] = [
    (1.0, 0.0),
    (1e2, 0.1),
    (1e2, 3.0),
    (1e4, 0.0),
    (1e4, 0.05),
    (1e4, 0.3),
    (1e4, 3.0),
];

#[test]
fn bounds_of_squares_hold_and_are_not_loose() {
    println!("condition, turn: box, first, second derivatives times too large (largest of 6)");
    for (condition, turn) in CASES {
        let mut random = Random(21);
        let mut loosest = [0.0f64; 3];
        for _ in 0..6 {
            let gaussians = sheet(4, condition, turn, &mut random);
            let frame = DualFrame::whitened(&gaussians);
            let patch = square(&gaussians, &frame);
            let bounds = patch.bounds(&frame, PARTS).expect("definite");
            let mut extent = Extent::default();
            for (i, j) in (0..=40).flat_map(|i| (0..=40).map(move |j| (i, j))) {
                let at = [i, j].map(|k| f64::from(k) / 40.0);
                let MeanJet { mean, first, second } = patch.jet(at).mean().expect("definite").in_object_space(&frame);
                extent.add(mean, first, second);
            }
            let ratios = extent.check(&bounds);
            loosest
                .iter_mut()
                .zip(ratios)
                .for_each(|(largest, ratio)| *largest = largest.max(ratio));
        }
        println!(
            "{condition:.0e}, {turn}: {:.2} {:.2} {:.2}",
            loosest[0], loosest[1], loosest[2]
        );
        assert!(
            loosest[0] < 1.25 && loosest[1] < 1.6 && loosest[2] < 2.6,
            "{condition} {turn}: {loosest:?}"
        );
    }
}

#[test]
fn bounds_of_triangles_hold_along_any_directions() {
    let third = 1.0 / 3.0;
    for (condition, turn) in CASES {
        let mut random = Random(33);
        for directions in [
            [[-1.0, 1.0, 0.0], [-1.0, 0.0, 1.0]],
            [[1.0, -1.0, 0.0], [third, third, -2.0 * third]],
        ] {
            let (patch, frame) = triangle(condition, turn, &mut random);
            let bounds = patch.bounds(directions, &frame, PARTS).expect("definite");
            let mut extent = Extent::default();
            for (i, j) in (0..=40).flat_map(|i| (0..=40 - i).map(move |j| (i, j))) {
                let at = [i, j].map(|k| f64::from(k) / 40.0);
                let jet = patch.jet(at).mean().expect("definite").in_object_space(&frame);
                let [[_, a, b], [_, c, d]] = directions;
                let [u, v] = jet.first;
                let [uu, uv, vv] = jet.second;
                let first = [u * a + v * b, u * c + v * d];
                let second = |[a, b]: [f64; 2], [c, d]: [f64; 2]| uu * (a * c) + uv * (a * d + b * c) + vv * (b * d);
                extent.add(
                    jet.mean,
                    first,
                    [second([a, b], [a, b]), second([a, b], [c, d]), second([c, d], [c, d])],
                );
            }
            let ratios = extent.check(&bounds);
            println!(
                "{condition:.0e}, {turn}: {:.2} {:.2} {:.2}",
                ratios[0], ratios[1], ratios[2]
            );
            assert!(
                ratios[0] < 1.5 && ratios[1] < 2.0 && ratios[2] < 4.0,
                "{condition} {turn}: {ratios:?}"
            );
        }
    }
}

/// With equal covariances the surface is a Bézier patch, and the bounds are those of its control points.
#[test]
fn equal_covariances_have_the_bounds_of_a_bezier_patch() {
    let mut random = Random(8);
    let one = disk(1e4, random.rotation(3.0));
    let gaussians: Vec<_> = sheet(4, 1.0, 0.0, &mut random)
        .into_iter()
        .map(|(mean, _)| (mean, one))
        .collect();
    let frame = DualFrame::whitened(&gaussians);
    let bounds = square(&gaussians, &frame).bounds(&frame, 1).expect("definite");
    let rows = [
        [1.0, 4.0, 1.0, 0.0],
        [0.0, 4.0, 2.0, 0.0],
        [0.0, 2.0, 4.0, 0.0],
        [0.0, 1.0, 4.0, 1.0],
    ]
    .map(|row| row.map(|w| w / 6.0));
    let control = |a: usize, b: usize| -> DVec3 {
        (0..16)
            .map(|k| gaussians[k].0 * (rows[a][k % 4] * rows[b][k / 4]))
            .sum()
    };
    let controls = || (0..16).map(|k| control(k % 4, k / 4));
    let speed = (0..12)
        .map(|k| (control(k % 3 + 1, k / 3) - control(k % 3, k / 3)).length() * 3.0)
        .fold(0.0, f64::max);
    assert!(bounds.low.distance(controls().fold(DVec3::INFINITY, DVec3::min)) < 1e-11);
    assert!(bounds.high.distance(controls().fold(DVec3::NEG_INFINITY, DVec3::max)) < 1e-11);
    assert!((bounds.first[0] - speed).abs() < 1e-10, "{bounds:?} {speed}");
}

#[test]
fn patches_that_may_be_indefinite_have_no_bounds_until_they_are_cut() {
    let controls = (0..16).map(|k| {
        let at = DVec3::new(f64::from(k % 4), f64::from(k / 4), 0.0);
        // Nowhere more than a fifth of the patch.
        let precision = Symmetric3::IDENTITY * if k == 5 { -1.0 } else { 1.0 };
        Dual {
            precision,
            information: precision * at,
        }
    });
    let patch = DualSquare::new([3, 3], controls.collect()).expect("16 control points");
    assert_eq!(patch.bounds(&DualFrame::OBJECT, 1), None);
    assert!(patch.bounds(&DualFrame::OBJECT, PARTS).is_some());
}
