//! Bézier and NURBS surfaces: the control net that users give, checked.

use super::basis::BasisMethod;
use super::evaluation::KsQuad;
use super::knot_insertion;
use super::span::{self, MAX_DEGREE, Span};
use super::{PatchError, normal};
use crate::{ParameterError, SurfaceFrame};
use glam::DVec3;

/// Coordinates, knots and weights beyond this overflow in f32 arithmetic such as products of scaled models.
const LARGEST: f64 = 1e15;

/// Weights below this part of a surface's largest vanish in f32.
const LEAST_WEIGHT: f64 = 1e-30;

/// Spans below this part of their knot vector make ratios that overflow in f32.
const LEAST_SPAN: f64 = 1e-30;

const DIRECTIONS: [&str; 2] = ["u", "v"];

/// A tensor-product NURBS surface S(u, v) = Σ N M w P / Σ N M w (Piegl & Tiller 4.15) of degrees 1 to 7.
///
/// Knots need not be clamped; a knot may be repeated degree + 1 times, which tears the surface there. The domain in u is
/// `knots[p]..=knots[count]` with p the degree and count the number of control points. Control point (i, j) is
/// `points[i + j * nu]`. A weight may be zero as long as the control points of every KSQuad, a product of two spans that are not
/// empty, weigh something together.
///
/// ```
/// use glam::DVec3;
/// use keyleaf_surface::NurbsSurface;
/// let half = std::f64::consts::FRAC_1_SQRT_2;
/// let points = [0.0, 1.0].map(|z| [DVec3::new(1.0, 0.0, z), DVec3::new(1.0, 1.0, z), DVec3::new(0.0, 1.0, z)]);
/// let quarter_of_a_cylinder = NurbsSurface::bezier([2, 1], points.concat(), [1.0, half, 1.0].repeat(2))?;
/// let frame = quarter_of_a_cylinder.frame(0.5, 0.25)?;
/// assert!((frame.normal - DVec3::new(half, half, 0.0)).length() < 1e-15);
/// assert!((frame.position.z - 0.25).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct NurbsSurface {
    degree: [u32; 2],
    knots: [Vec<f64>; 2],
    points: Vec<DVec3>,
    weights: Vec<f64>,
}

impl NurbsSurface {
    /// The surface with these degrees, knots, control points and weights, each in u and v, u fastest.
    ///
    /// # Errors
    /// [`PatchError`] names the first number that is wrong.
    pub fn new(
        degree: [u32; 2],
        knots: [Vec<f64>; 2],
        points: Vec<DVec3>,
        weights: Vec<f64>,
    ) -> Result<Self, PatchError> {
        for axis in 0..2 {
            check_knots(DIRECTIONS[axis], degree[axis], &knots[axis])?;
        }
        let surface = Self {
            degree,
            knots,
            points,
            weights,
        };
        surface.check_controls()?;
        Ok(surface)
    }

    /// The Bézier patch with these control points, (degree u + 1) · (degree v + 1) of them, and weights. Its domain is the unit square.
    ///
    /// # Errors
    /// [`PatchError`] names the first number that is wrong.
    pub fn bezier(degree: [u32; 2], points: Vec<DVec3>, weights: Vec<f64>) -> Result<Self, PatchError> {
        let knots = degree.map(|p| {
            let order = p.min(MAX_DEGREE as u32) as usize + 1;
            [vec![0.0; order], vec![1.0; order]].concat()
        });
        Self::new(degree, knots, points, weights)
    }

    /// The same surface with u and v exchanged, and so seen from the other side.
    #[must_use]
    pub fn transposed(&self) -> Self {
        let [nu, nv] = self.point_counts();
        let order = || (0..nu).flat_map(move |i| (0..nv).map(move |j| i + j * nu));
        let [p, q] = self.degree;
        let [u, v] = self.knots.clone();
        Self {
            degree: [q, p],
            knots: [v, u],
            points: order().map(|index| self.points[index]).collect(),
            weights: order().map(|index| self.weights[index]).collect(),
        }
    }

    /// The same surface with more knots in u, which ascend and lie within spans of the domain.
    pub(super) fn with_knots_u(&self, added: &[f64]) -> Self {
        let controls: Vec<_> = (0..self.points.len()).map(|index| self.control(index)).collect();
        let mut refined = Self {
            degree: self.degree,
            knots: self.knots.clone(),
            points: Vec::new(),
            weights: Vec::new(),
        };
        for row in controls.chunks(self.point_counts()[0]) {
            let (knots, row) = knot_insertion::refine(self.degree[0] as usize, &self.knots[0], row, added);
            refined.knots[0] = knots;
            refined.points.extend(row.iter().map(|&(point, _)| point));
            refined.weights.extend(row.iter().map(|&(_, weight)| weight));
        }
        refined
    }

    /// The degrees in u and v.
    pub fn degree(&self) -> [u32; 2] {
        self.degree
    }

    /// The knots in u and v.
    pub fn knots(&self) -> [&[f64]; 2] {
        [&self.knots[0], &self.knots[1]]
    }

    /// The control points, u fastest.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// The weights of the control points.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// How many control points there are in u and v.
    pub fn point_counts(&self) -> [usize; 2] {
        [0, 1].map(|axis| self.knots[axis].len() - self.degree[axis] as usize - 1)
    }

    /// Least and greatest parameter in u and in v.
    pub fn domain(&self) -> [[f64; 2]; 2] {
        let counts = self.point_counts();
        [0, 1].map(|axis| {
            let knots = &self.knots[axis];
            [knots[self.degree[axis] as usize], knots[counts[axis]]]
        })
    }

    /// Position, derivatives in u and v and unit normal at parameters of the domain. At a knot, those of the span on its right; at
    /// the end of the domain, those of the last.
    ///
    /// # Errors
    /// [`ParameterError::OutsideSurface`], also if a parameter is NaN; the surface counts as the first.
    pub fn frame(&self, u: f64, v: f64) -> Result<SurfaceFrame, ParameterError> {
        let spans = self.spans();
        let [Some(i), Some(j)] = [span::find(&spans[0], u), span::find(&spans[1], v)] else {
            return Err(ParameterError::OutsideSurface {
                surface: 0,
                s: u,
                t: v,
                domain: self.domain(),
            });
        };
        let spans = [&spans[0][i], &spans[1][j]];
        let quad = KsQuad {
            surface: self,
            spans,
            method: BasisMethod::Triangular,
        };
        let at = [spans[0].fraction(u), spans[1].fraction(v)];
        let jet = quad.jet(at);
        Ok(SurfaceFrame {
            position: jet.position,
            du: jet.du / spans[0].length(),
            dv: jet.dv / spans[1].length(),
            normal: normal::of(&quad, at, &jet, || normal::mean(&quad)),
        })
    }

    /// A control point and its weight.
    pub(super) fn control(&self, index: usize) -> (DVec3, f64) {
        (self.points[index], self.weights[index])
    }

    pub(super) fn set_point(&mut self, index: usize, point: DVec3) {
        self.points[index] = point;
    }

    pub(super) fn set_weight(&mut self, index: usize, weight: f64) {
        self.weights[index] = weight;
    }

    pub(super) fn largest_weight(&self) -> f64 {
        self.weights.iter().copied().fold(0.0, f64::max)
    }

    /// The spans of the domain in u and v that are not empty.
    pub(super) fn spans(&self) -> [Vec<Span>; 2] {
        [0, 1].map(|axis| span::spans(self.degree[axis] as usize, &self.knots[axis]))
    }

    fn check_controls(&self) -> Result<(), PatchError> {
        let expected = self.point_counts();
        for (what, found) in [("control points", self.points.len()), ("weights", self.weights.len())] {
            if Some(found) != expected[0].checked_mul(expected[1]) {
                return Err(PatchError::PointCount { what, found, expected });
            }
        }
        for (index, point) in self.points.iter().enumerate() {
            // A NaN is not "at most" anything.
            let is_possible = point.to_array().into_iter().all(|c| c.abs() <= LARGEST);
            if !is_possible {
                let DVec3 { x, y, z } = *point;
                return Err(PatchError::Point { index, x, y, z });
            }
        }
        for (index, &value) in self.weights.iter().enumerate() {
            if !(0.0..=LARGEST).contains(&value) {
                return Err(PatchError::Weight { index, value });
            }
        }
        self.check_weights_of_quads()
    }

    fn check_weights_of_quads(&self) -> Result<(), PatchError> {
        let least = LEAST_WEIGHT * self.largest_weight();
        let [us, vs] = self.spans();
        for (j, v) in vs.iter().enumerate() {
            for (i, u) in us.iter().enumerate() {
                let row = |row: usize| u.controls().map(move |column| column + row * self.point_counts()[0]);
                let sum: f64 = v.controls().flat_map(row).map(|index| self.weights[index]).sum();
                if sum <= least {
                    return Err(PatchError::NoWeight { spans: [i, j] });
                }
            }
        }
        Ok(())
    }
}

/// Whether a knot vector is one of the degree.
fn check_knots(direction: &'static str, degree: u32, knots: &[f64]) -> Result<(), PatchError> {
    if !(1..=MAX_DEGREE as u32).contains(&degree) {
        return Err(PatchError::Degree { direction, degree });
    }
    let p = degree as usize;
    if knots.len() < 2 * p + 2 {
        return Err(PatchError::KnotCount {
            direction,
            degree,
            found: knots.len(),
        });
    }
    for (index, &value) in knots.iter().enumerate() {
        let is_possible = value.abs() <= LARGEST;
        if !is_possible {
            return Err(PatchError::Knot {
                direction,
                index,
                value,
            });
        }
        if index > 0 && value < knots[index - 1] {
            let before = knots[index - 1];
            return Err(PatchError::KnotDecreases {
                direction,
                index,
                value,
                before,
            });
        }
    }
    let indices = [p, knots.len() - p - 1];
    let [first, last] = indices.map(|index| knots[index]);
    if first == last {
        return Err(PatchError::EmptyDomain {
            direction,
            indices,
            at: first,
        });
    }
    check_spacing(direction, p, knots, [first, last])
}

/// Whether knots inside the domain are not repeated too often, and the others far enough apart.
fn check_spacing(direction: &'static str, p: usize, knots: &[f64], [first, last]: [f64; 2]) -> Result<(), PatchError> {
    let least = LEAST_SPAN * (knots[knots.len() - 1] - knots[0]);
    let mut index = 0;
    for equal in knots.chunk_by(|a, b| a == b) {
        let (value, found) = (equal[0], equal.len());
        if first < value && value < last && found > p + 1 {
            return Err(PatchError::Multiplicity {
                direction,
                index,
                value,
                found,
                most: p + 1,
            });
        }
        let after = index + found;
        if let Some(&next) = knots.get(after)
            && next - value < least
        {
            return Err(PatchError::ShortSpan {
                direction,
                index: after - 1,
                length: next - value,
            });
        }
        index = after;
    }
    Ok(())
}
