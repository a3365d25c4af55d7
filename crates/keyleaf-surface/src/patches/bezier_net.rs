//! The rational Bézier form of a KSQuad, and bounds of its derivatives.

use super::basis::bezier_form;
use super::evaluation::KsQuad;
use super::span::MAX_ORDER;
use glam::{DVec3, DVec4};

/// Homogeneous control points (w (P − c), w), u fastest.
#[derive(Clone, Debug)]
pub struct BezierNet {
    degree: [usize; 2],
    controls: Vec<DVec4>,
}

/// Bounds of the lengths of derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DerivativeBounds {
    /// Of the first ones.
    pub first: [f64; 2],
    /// Of ∂²/∂u², ∂²/∂u∂v, ∂²/∂v².
    pub second: [f64; 3],
}

impl DerivativeBounds {
    pub fn max(self, other: Self) -> Self {
        Self {
            first: std::array::from_fn(|k| self.first[k].max(other.first[k])),
            second: std::array::from_fn(|k| self.second[k].max(other.second[k])),
        }
    }
}

impl BezierNet {
    /// About the first control point.
    pub fn of(quad: &KsQuad<'_>) -> Self {
        let degree = quad.spans.map(|span| span.degree);
        let mut rows = [[DVec4::ZERO; MAX_ORDER]; MAX_ORDER];
        let mut centre = None;
        for (i, j, index) in quad.control_indices() {
            let (point, weight) = quad.surface.control(index);
            let centre = *centre.get_or_insert(point);
            rows[j][i] = ((point - centre) * weight).extend(weight);
        }
        for row in rows.iter_mut().take(degree[1] + 1) {
            *row = bezier_form(degree[0], quad.spans[0], *row);
        }
        let column = |i: usize| bezier_form(degree[1], quad.spans[1], std::array::from_fn(|j| rows[j][i]));
        let columns: [_; MAX_ORDER] = std::array::from_fn(column);
        let controls = (0..=degree[1]).flat_map(|j| (0..=degree[0]).map(move |i| (i, j)));
        Self {
            degree,
            controls: controls.map(|(i, j)| columns[i][j]).collect(),
        }
    }

    /// The degrees in u and v.
    pub fn degree(&self) -> [usize; 2] {
        self.degree
    }

    /// Homogeneous control points (w (P − c), w), u fastest.
    pub fn controls(&self) -> &[DVec4] {
        &self.controls
    }

    /// The least and the greatest weight.
    pub fn weights(&self) -> [f64; 2] {
        let weights = self.controls.iter().map(|control| control.w);
        weights.fold([f64::INFINITY, 0.0], |[low, high], w| [low.min(w), high.max(w)])
    }

    /// 4^depth parts of equal size, row by row.
    pub fn parts(self, depth: u32) -> Vec<Self> {
        let halves =
            |nets: Vec<Self>, axis: usize| -> Vec<Self> { nets.iter().flat_map(|net| net.split(axis)).collect() };
        let rows = (0..depth).fold(vec![self], |rows, _| halves(rows, 1));
        let columns = |row: Self| (0..depth).fold(vec![row], |row, _| halves(row, 0));
        rows.into_iter().flat_map(columns).collect()
    }

    /// Both halves, by de Casteljau's algorithm.
    fn split(&self, axis: usize) -> [Self; 2] {
        let (mut low, mut high) = (self.clone(), self.clone());
        let stride = [1, self.degree[0] + 1];
        let p = self.degree[axis];
        for line in 0..=self.degree[1 - axis] {
            let place = |k: usize| line * stride[1 - axis] + k * stride[axis];
            for j in 1..=p {
                low.controls[place(j - 1)] = high.controls[place(0)];
                for k in 0..=p - j {
                    high.controls[place(k)] = (high.controls[place(k)] + high.controls[place(k + 1)]) * 0.5;
                }
            }
            low.controls[place(p)] = high.controls[place(0)];
        }
        [low, high]
    }

    /// Vectors whose means the derivatives times the weight are, in u and in v, but for vectors no longer than the number beside them.
    ///
    /// With A = w (P − c) about the net's own centre: W S_u = A_u − W_u (S − c), and A_u is a mean of its control points.
    pub fn tangents(&self) -> [(Vec<DVec3>, f64); 2] {
        let (net, reach) = self.about_centre();
        [0, 1].map(|axis| {
            let hodograph = net.difference(axis);
            let change = hodograph.controls.iter().map(|c| c.w.abs()).fold(0.0, f64::max);
            let vectors = hodograph.controls.iter().map(|c| c.truncate()).collect();
            (vectors, change * reach)
        })
    }

    /// Bounds over the net, in parameters in which it has the given size.
    ///
    /// With A = w (P − c) about the net's own centre: S_u = (A_u − W_u (S − c)) / W, S_uv = (A_uv − W_uv (S − c) − W_u S_v − W_v S_u) / W
    /// and so on, each term bounded by control points. Where a weight is zero, the derivatives may be unbounded: the answer is then
    /// what the extent of the control points suggests.
    pub fn bounds(&self, size: f64) -> DerivativeBounds {
        let [least, _] = self.weights();
        let (net, reach) = self.about_centre();
        let degree = self.degree.map(|p| p as f64);
        if least <= 0.0 {
            let first = degree.map(|p| 2.0 * p * reach / size);
            let second = 4.0 * degree[0].max(degree[1]).powi(2) * reach / (size * size);
            return DerivativeBounds {
                first,
                second: [second; 3],
            };
        }
        let [u, v] = [0, 1].map(|axis| net.difference(axis));
        let [uu, uv, vv] = [u.difference(0), u.difference(1), v.difference(1)].map(|net| net.lengths(size * size));
        let [u, v] = [u, v].map(|net| net.lengths(size));
        let [su, sv] = [u, v].map(|[a, w]| (a + w * reach) / least);
        DerivativeBounds {
            first: [su, sv],
            second: [
                (uu[0] + 2.0 * u[1] * su + uu[1] * reach) / least,
                (uv[0] + u[1] * sv + v[1] * su + uv[1] * reach) / least,
                (vv[0] + 2.0 * v[1] * sv + vv[1] * reach) / least,
            ],
        }
    }

    /// The net about the middle of the box of its control points, and how far the farthest is from there.
    fn about_centre(&self) -> (Self, f64) {
        let points = || self.controls.iter().filter(|c| c.w > 0.0).map(|c| c.truncate() / c.w);
        let (low, high) = points().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| {
            (low.min(p), high.max(p))
        });
        let centre = if low.is_finite() {
            (low + high) / 2.0
        } else {
            DVec3::ZERO
        };
        let reach = points().map(|p| p.distance(centre)).fold(0.0, f64::max);
        let controls = self.controls.iter().map(|c| (c.truncate() - centre * c.w).extend(c.w));
        (
            Self {
                degree: self.degree,
                controls: controls.collect(),
            },
            reach,
        )
    }

    /// The control points of the derivative (hodograph).
    fn difference(&self, axis: usize) -> Self {
        let mut degree = self.degree;
        let (p, step) = (degree[axis], [1, degree[0] + 1][axis]);
        degree[axis] = p.saturating_sub(1);
        if p == 0 {
            return Self {
                degree,
                controls: vec![DVec4::ZERO; self.controls.len()],
            };
        }
        let places = (0..=degree[1]).flat_map(|j| (0..=degree[0]).map(move |i| i + j * (self.degree[0] + 1)));
        Self {
            degree,
            controls: places
                .map(|k| (self.controls[k + step] - self.controls[k]) * p as f64)
                .collect(),
        }
    }

    /// The greatest |A| and |w| over a size.
    fn lengths(&self, size: f64) -> [f64; 2] {
        let greatest = |length: fn(&DVec4) -> f64| self.controls.iter().map(length).fold(0.0, f64::max) / size;
        [greatest(|c| c.truncate().length()), greatest(|c| c.w.abs())]
    }
}
