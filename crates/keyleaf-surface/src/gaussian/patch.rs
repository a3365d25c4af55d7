//! Bézier patches whose control points are Gaussians in dual space.
//!
//! The surface is the mean of what the patch is in dual space: no linear image of its control points, and single control points may
//! be no Gaussians (rows of subdivision matrices have negative entries) as long as the sum is one.

use super::dual::{Dual, DualJet};

/// A tensor-product Bézier patch over the unit square.
#[derive(Clone, Debug, PartialEq)]
pub struct DualSquare {
    degree: [usize; 2],
    controls: Vec<Dual>,
}

impl DualSquare {
    /// A patch of these degrees in u and v, with (p + 1)(q + 1) control points, u fastest; none if their number is another or a
    /// degree is zero.
    pub fn new(degree: [usize; 2], controls: Vec<Dual>) -> Option<Self> {
        let fits = degree[0] > 0 && degree[1] > 0 && controls.len() == (degree[0] + 1) * (degree[1] + 1);
        fits.then_some(Self { degree, controls })
    }

    /// Value and derivatives at (u, v).
    pub fn jet(&self, [u, v]: [f64; 2]) -> DualJet {
        let rows: Vec<[Dual; 3]> = self
            .controls
            .chunks(self.degree[0] + 1)
            .map(|row| curve_jet(row, u))
            .collect();
        let column = |order: usize| {
            let column: Vec<Dual> = rows.iter().map(|row| row[order]).collect();
            curve_jet(&column, v)
        };
        let [[value, dv, dvv], [du, duv, _], [duu, _, _]] = [column(0), column(1), column(2)];
        DualJet {
            terms: [value, du, dv, duu, duv, dvv],
        }
    }

    /// The control points of a bicubic patch.
    pub(super) fn bicubic(&self) -> Option<&[Dual]> {
        (self.degree == [3, 3]).then_some(&self.controls)
    }
}

/// Value, first and second derivative of a Bézier curve, by de Casteljau's algorithm.
fn curve_jet(controls: &[Dual], t: f64) -> [Dual; 3] {
    let n = (controls.len() - 1) as f64;
    let mut points = controls.to_vec();
    let mut jet = [Dual::default(); 3];
    while points.len() > 1 {
        if points.len() == 3 {
            jet[2] = (points[2] - points[1] * 2.0 + points[0]) * (n * (n - 1.0));
        }
        if points.len() == 2 {
            jet[1] = (points[1] - points[0]) * n;
        }
        points = points
            .windows(2)
            .map(|pair| pair[0] * (1.0 - t) + pair[1] * t)
            .collect();
    }
    jet[0] = points[0];
    jet
}

/// Barycentric coordinates of a point, which sum to 1, or of a direction, which sum to 0.
type Barycentric = [f64; 3];

/// A triangular Bézier patch. Corners 0, 1, 2 are at (u, v) = (0, 0), (1, 0), (0, 1).
#[derive(Clone, Debug, PartialEq)]
pub struct DualTriangle {
    degree: usize,
    /// Row by row of the power of v, u fastest.
    controls: Vec<Dual>,
}

impl DualTriangle {
    /// A patch with (n + 1)(n + 2) / 2 control points: for j in 0..=n those of v^j u^i (1 − u − v)^(n − i − j), i in 0..=n − j. None if
    /// their number is another or the degree zero.
    pub fn new(degree: usize, controls: Vec<Dual>) -> Option<Self> {
        let fits = degree > 0 && controls.len() == (degree + 1) * (degree + 2) / 2;
        fits.then_some(Self { degree, controls })
    }

    /// Value and derivatives at (u, v).
    pub fn jet(&self, [u, v]: [f64; 2]) -> DualJet {
        let at = [1.0 - u - v, u, v];
        let (along_u, along_v) = ([-1.0, 1.0, 0.0], [-1.0, 0.0, 1.0]);
        let degree = self.degree as f64;
        let mut net = self.clone();
        let mut jet = DualJet::default();
        while net.degree > 0 {
            let scale = degree * (degree - 1.0);
            match net.degree {
                2 => {
                    let [du, dv] = [along_u, along_v].map(|h| net.step(h));
                    jet.terms[3] = du.step(along_u).controls[0] * scale;
                    jet.terms[4] = du.step(along_v).controls[0] * scale;
                    jet.terms[5] = dv.step(along_v).controls[0] * scale;
                }
                1 => {
                    jet.terms[1] = net.step(along_u).controls[0] * degree;
                    jet.terms[2] = net.step(along_v).controls[0] * degree;
                }
                _ => {}
            }
            net = net.step(at);
        }
        jet.terms[0] = net.controls[0];
        jet
    }

    fn index(degree: usize, i: usize, j: usize) -> usize {
        // Rows 0..j have degree + 1, degree, … control points.
        j * (2 * degree + 3 - j) / 2 + i
    }

    /// One step of de Casteljau's algorithm: the polar form with one argument set.
    fn step(&self, at: Barycentric) -> Self {
        let n = self.degree;
        let point = |i: usize, j: usize| self.controls[Self::index(n, i, j)];
        let places = (0..n).flat_map(|j| (0..n - j).map(move |i| (i, j)));
        let blend = |(i, j)| point(i, j) * at[0] + point(i + 1, j) * at[1] + point(i, j + 1) * at[2];
        Self {
            degree: n - 1,
            controls: places.map(blend).collect(),
        }
    }

    /// The control points of a quartic patch.
    pub(super) fn quartic(&self) -> Option<&[Dual]> {
        (self.degree == 4).then_some(&self.controls)
    }
}
