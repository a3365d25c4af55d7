//! Position and derivatives of one KSQuad: the product of two spans.

use super::basis::{self, BasisMethod};
use super::nurbs_surface::NurbsSurface;
use super::span::{Fraction, MAX_ORDER, Span};
use glam::{DVec3, DVec4};

/// A product of two spans of a surface. Parameters and derivatives are local: 0..=1 over each span.
#[derive(Clone, Copy, Debug)]
pub struct KsQuad<'a> {
    pub surface: &'a NurbsSurface,
    pub spans: [&'a Span; 2],
    pub method: BasisMethod,
}

/// A point and its derivatives.
#[derive(Clone, Copy, Debug)]
pub struct PatchJet {
    pub position: DVec3,
    pub du: DVec3,
    pub dv: DVec3,
    pub duu: DVec3,
    pub duv: DVec3,
    pub dvv: DVec3,
}

/// What turns the control points of a curve over a span into its value and derivatives.
struct CurveBasis {
    degree: usize,
    /// Basis functions of degree p, p − 1 and p − 2.
    values: [[f64; MAX_ORDER]; 3],
    /// Degree over the width of knots, for differences of control points and differences of those.
    steps: [[f64; MAX_ORDER]; 2],
}

impl CurveBasis {
    fn new(method: BasisMethod, span: &Span, at: Fraction) -> Self {
        let degree = span.degree;
        let lower = |order: usize| match degree.checked_sub(order) {
            Some(degree) => basis::values(method, degree, span, at),
            None => [0.0; MAX_ORDER],
        };
        // Control point r + 1 of degree d is new at x[i + 1 + r], and r was at x[i + 1 − (d − r)].
        let step = |order: usize| {
            let degree = degree.saturating_sub(order);
            std::array::from_fn(|r| {
                if r < degree {
                    degree as f64 / span.width(r + 1, degree - r)
                } else {
                    0.0
                }
            })
        };
        Self {
            degree,
            values: [lower(0), lower(1), lower(2)],
            steps: [step(0), step(1)],
        }
    }

    /// Value, first and second derivative, from differences of control points (Piegl & Tiller 3.4).
    fn jet(&self, controls: &[DVec4; MAX_ORDER]) -> [DVec4; 3] {
        let mut points = *controls;
        let mut jet = [DVec4::ZERO; 3];
        for (order, value) in jet.iter_mut().enumerate().take(self.degree + 1) {
            let count = self.degree + 1 - order;
            *value = points
                .iter()
                .zip(self.values[order])
                .take(count)
                .map(|(&p, n)| p * n)
                .sum();
            if let Some(steps) = self.steps.get(order) {
                for r in 0..count - 1 {
                    points[r] = (points[r + 1] - points[r]) * steps[r];
                }
            }
        }
        jet
    }
}

impl KsQuad<'_> {
    /// Indices of the control points, row by row.
    pub fn control_indices(&self) -> impl Iterator<Item = (usize, usize, usize)> {
        let [us, vs] = self.spans.map(Span::controls);
        let [stride, _] = self.surface.point_counts();
        (0..).zip(vs).flat_map(move |(j, row)| {
            (0..)
                .zip(us.clone())
                .map(move |(i, column)| (i, j, column + row * stride))
        })
    }

    /// Position and derivatives. Where all weights vanish, those a small step inwards, so that they are finite everywhere.
    pub fn jet(&self, at: [Fraction; 2]) -> PatchJet {
        let bases = [0, 1].map(|axis| CurveBasis::new(self.method, self.spans[axis], at[axis]));
        let Some(position) = self.position(&bases) else {
            return self.jet(inwards(at));
        };
        // With Q = w (P − S), the derivatives of S are those of the sum of Q, which is zero, over W (Piegl & Tiller 4.5).
        let mut rows = [[DVec4::ZERO; MAX_ORDER]; MAX_ORDER];
        for (i, j, index) in self.control_indices() {
            let (point, weight) = self.surface.control(index);
            rows[j][i] = ((point - position) * weight).extend(weight);
        }
        let mut columns = [[DVec4::ZERO; MAX_ORDER]; 3];
        for j in 0..=self.spans[1].degree {
            let jet = bases[0].jet(&rows[j]);
            (0..3).for_each(|order| columns[order][j] = jet[order]);
        }
        let [[value, v, vv], [u, uv, _], [uu, _, _]] = columns.map(|column| bases[1].jet(&column));
        let weight = value.w;
        let (du, dv) = (u.truncate() / weight, v.truncate() / weight);
        PatchJet {
            position,
            du,
            dv,
            duu: (uu.truncate() - du * (2.0 * u.w)) / weight,
            duv: (uv.truncate() - dv * u.w - du * v.w) / weight,
            dvv: (vv.truncate() - dv * (2.0 * v.w)) / weight,
        }
    }

    /// Σ N M w P / Σ N M w, about the control point that weighs most: exact where all that count are equal, and as precise far
    /// from zero as near it. None where the weights vanish.
    fn position(&self, bases: &[CurveBasis; 2]) -> Option<DVec3> {
        let mut weights = [0.0; MAX_ORDER * MAX_ORDER];
        let (mut sum, mut largest, mut reference) = (0.0, 0.0, DVec3::ZERO);
        for (slot, (i, j, index)) in weights.iter_mut().zip(self.control_indices()) {
            let (point, weight) = self.surface.control(index);
            *slot = bases[0].values[0][i] * bases[1].values[0][j] * weight;
            sum += *slot;
            if *slot > largest {
                (largest, reference) = (*slot, point);
            }
        }
        let offset = |(weight, (_, _, index)): (f64, _)| (self.surface.control(index).0 - reference) * weight;
        let moment: DVec3 = weights.into_iter().zip(self.control_indices()).map(offset).sum();
        (largest > 0.0).then(|| reference + moment / sum)
    }
}

/// The parameters after a small step towards the centre; from the centre, towards its last corner.
pub fn inwards(at: [Fraction; 2]) -> [Fraction; 2] {
    /// Of the longer of both components.
    const STEP: f64 = 1.0 / 1024.0;
    let direction = inward_direction(at);
    let length = direction[0].abs().max(direction[1].abs());
    [0, 1].map(|axis| Fraction::new(at[axis].f + STEP / length * direction[axis]))
}

/// From the parameters towards the centre; at the centre, towards its last corner.
pub fn inward_direction(at: [Fraction; 2]) -> [f64; 2] {
    let direction = at.map(|a| 0.5 - a.f);
    if direction == [0.0; 2] { [0.5; 2] } else { direction }
}
