//! Surfaces that the tests share.

use crate::random::Random;
use glam::DVec3;
use keyleaf_surface::{NurbsSurface, PatchKind, PatchSettings, Patches};

pub const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// degree + 1 knots at both ends and the inner ones between.
pub fn clamped(degree: u32, inner: &[f64]) -> Vec<f64> {
    let ends = |x: f64| vec![x; degree as usize + 1];
    [ends(0.0), inner.to_vec(), ends(1.0)].concat()
}

/// A bumpy sheet of any degree over [0, 1]² with these knots, and weights from 10^-spread to 10^spread.
pub fn sheet(degree: [u32; 2], knots: [Vec<f64>; 2], spread: f64, seed: u64) -> NurbsSurface {
    let mut random = Random(seed);
    let [nu, nv] = [0, 1].map(|axis| knots[axis].len() - degree[axis] as usize - 1);
    let mut points = Vec::new();
    for j in 0..nv {
        for i in 0..nu {
            let [x, y] = [i as f64 / (nu - 1) as f64, j as f64 / (nv - 1) as f64];
            points.push(DVec3::new(x, y, 0.3 * random.unit()) + DVec3::new(random.unit(), random.unit(), 0.0) * 0.02);
        }
    }
    let weights = points
        .iter()
        .map(|_| 10f64.powf(spread * (2.0 * random.unit() - 1.0)))
        .collect();
    NurbsSurface::new(degree, knots, points, weights).expect("a surface")
}

/// Bilinear Bézier patch with these corners at (0, 0), (1, 0), (0, 1), (1, 1).
pub fn bilinear(corners: [[f64; 3]; 4]) -> NurbsSurface {
    NurbsSurface::bezier([1, 1], corners.map(DVec3::from_array).to_vec(), vec![1.0; 4]).expect("a patch")
}

/// Rotates a rational profile of degree 2 (x, z, weight) about z: nine points round, u round, v along the profile.
pub fn revolved(profile: &[[f64; 3]], knots_v: Vec<f64>, degree_v: u32) -> NurbsSurface {
    let round = [
        [1.0, 0.0],
        [1.0, 1.0],
        [0.0, 1.0],
        [-1.0, 1.0],
        [-1.0, 0.0],
        [-1.0, -1.0],
        [0.0, -1.0],
        [1.0, -1.0],
        [1.0, 0.0],
    ];
    let mut points = Vec::new();
    let mut weights = Vec::new();
    for [x, z, w] in profile {
        for (k, [c, s]) in round.into_iter().enumerate() {
            points.push(DVec3::new(c * x, s * x, *z));
            weights.push(w * if k % 2 == 1 { HALF } else { 1.0 });
        }
    }
    let knots_u = clamped(2, &[0.25, 0.25, 0.5, 0.5, 0.75, 0.75]);
    NurbsSurface::new([2, degree_v], [knots_u, knots_v], points, weights).expect("a surface")
}

/// Two sheets that share the curve at their sides, with weights that are `factor` times as large, off by `error`, and other knots.
pub fn rational_neighbours(factor: f64, error: f64) -> Vec<NurbsSurface> {
    let knots = [clamped(2, &[0.5]), clamped(3, &[0.25, 0.25, 0.5])];
    let first = sheet([2, 3], knots.clone(), 0.3, 5);
    let second = sheet([2, 3], knots, 0.3, 6);
    let [nu, nv] = first.point_counts();
    let (mut points, mut weights) = (second.points().to_vec(), second.weights().to_vec());
    for j in 0..nv {
        points[j * nu] = first.points()[nu - 1 + j * nu];
        weights[j * nu] = first.weights()[nu - 1 + j * nu] * factor * (1.0 + error * (j as f64 - 2.0));
    }
    let [u, v] = second.knots();
    let stretched = [u.to_vec(), v.iter().map(|x| 100.0 + 8.0 * x).collect()];
    vec![
        first,
        NurbsSurface::new([2, 3], stretched, points, weights).expect("a surface"),
    ]
}

pub fn sphere() -> NurbsSurface {
    let profile = [
        [0.0, -1.0, 1.0],
        [1.0, -1.0, HALF],
        [1.0, 0.0, 1.0],
        [1.0, 1.0, HALF],
        [0.0, 1.0, 1.0],
    ];
    revolved(&profile, clamped(2, &[0.5, 0.5]), 2)
}

pub fn torus() -> NurbsSurface {
    let square = [
        [1.0, 0.0],
        [1.0, 1.0],
        [0.0, 1.0],
        [-1.0, 1.0],
        [-1.0, 0.0],
        [-1.0, -1.0],
        [0.0, -1.0],
        [1.0, -1.0],
        [1.0, 0.0],
    ];
    let profile: Vec<[f64; 3]> = square
        .into_iter()
        .enumerate()
        .map(|(k, [c, s])| [2.0 + 0.5 * c, 0.5 * s, if k % 2 == 1 { HALF } else { 1.0 }])
        .collect();
    revolved(&profile, clamped(2, &[0.25, 0.25, 0.5, 0.5, 0.75, 0.75]), 2)
}

pub fn model(surfaces: Vec<NurbsSurface>) -> Patches {
    Patches::new(surfaces, PatchSettings::default()).expect("a model")
}

pub fn bezier_model(surfaces: Vec<NurbsSurface>) -> Patches {
    let settings = PatchSettings {
        kind: PatchKind::Bezier,
        ..PatchSettings::default()
    };
    Patches::new(surfaces, settings).expect("a model")
}
