//! A part of a patch in the coordinates in which its middle has mean 0 and precision 1: there its bounds are found, see [`bound`](super::bound).

use super::bound::MeanBounds;
use super::dual::{Dual, DualFrame};
use super::lanes::{CONTROLS, FIRST, Lanes, Net, SECOND};
use super::symmetric::Symmetric3;
use glam::{DMat3, DVec3};

/// Below this e, 1 − e is near enough to the least eigenvalue of q̂.
const PLAIN_DEVIATION: f64 = 0.25;

/// What is known of a part, in the parameters of the domain.
#[derive(Clone, Copy, Debug, Default)]
pub struct Findings {
    /// What its middle has, none if the precision there is not positive definite.
    pub middle: Option<MeanBounds>,
    /// Its bounds, and how much wider their box is than the hull; none if e is too great.
    pub bounds: Option<(MeanBounds, f64)>,
}

/// Of the part with these control points; `frame` is theirs, and the domain is `scale` times as large.
pub fn findings<S: Net>(shape: &S, net: &Lanes<CONTROLS>, frame: &DualFrame, scale: f64) -> Findings {
    let Some((factors, centre)) = net.weighted(&S::MIDDLE).solve() else {
        return Findings::default();
    };
    let own = DualFrame {
        centre,
        axes: factors.whitening(),
    };
    let net = net.in_frame(&own);
    let first = shape.first(&net);
    let second = shape.second(&first);
    let [u, v] = &first;
    let [uu, uv, vv] = &second;
    let centred = Centred {
        frame: DualFrame {
            centre: frame.point(centre),
            axes: frame.axes * own.axes,
        },
        first: [
            Rate::new(u, &S::MIDDLE_OF_FIRST[0]),
            Rate::new(v, &S::MIDDLE_OF_FIRST[1]),
        ],
        second: [
            Rate::new(uu, &S::MIDDLE_OF_SECOND[0]),
            Rate::new(uv, &S::MIDDLE_OF_SECOND[1]),
            Rate::new(vv, &S::MIDDLE_OF_SECOND[2]),
        ],
        net: &net,
    };
    let [_, deviation] = net.largest_precisions(Symmetric3::IDENTITY);
    let least = if deviation < PLAIN_DEVIATION {
        1.0 - deviation
    } else {
        net.least_eigenvalue(1.0)
    };
    Findings {
        middle: Some(centred.middle(scale)),
        bounds: (least > 0.0).then(|| centred.bounds(deviation, least, scale)),
    }
}

/// The part.
struct Centred<'a> {
    net: &'a Lanes<CONTROLS>,
    /// From these coordinates to object space.
    frame: DualFrame,
    /// Along both directions.
    first: [Rate<'a, FIRST>; 2],
    /// Along the first direction twice, both, and the second twice.
    second: [Rate<'a, SECOND>; 3],
}

/// A derivative of the part in dual space.
struct Rate<'a, const N: usize> {
    net: &'a Lanes<N>,
    middle: Dual,
    /// The largest norm of q̂, and of its difference to the middle.
    precision: [f64; 2],
}

impl<'a, const N: usize> Rate<'a, N> {
    fn new(net: &'a Lanes<N>, weights: &[f64; N]) -> Self {
        let middle = net.weighted(weights);
        let precision = net.largest_precisions(middle.precision);
        Self { net, middle, precision }
    }
}

impl Centred<'_> {
    /// With mean 0 and precision 1, μ_h = q̄_h and μ_hk = q̄_hk − q̂_h μ_k − q̂_k μ_h.
    fn middle(&self, scale: f64) -> MeanBounds {
        let rates = &self.first;
        let length = |v: DVec3| (self.frame.axes * v).length();
        let second = |rate: &Rate<'_, SECOND>, a: usize, b: usize| {
            length(rate.middle.information - self.product(a, b) - self.product(b, a)) * scale * scale
        };
        let [uu, uv, vv] = &self.second;
        MeanBounds {
            low: self.frame.centre,
            high: self.frame.centre,
            first: [0, 1].map(|k| length(rates[k].middle.information) * scale.abs()),
            second: [second(uu, 0, 0), second(uv, 0, 1), second(vv, 1, 1)],
        }
    }

    /// q̂_h μ_k in the middle.
    fn product(&self, h: usize, k: usize) -> DVec3 {
        self.first[h].middle.precision * self.first[k].middle.information
    }

    /// `e` is what the theory calls so; no eigenvalue of q̂ is below `least`.
    fn bounds(&self, e: f64, least: f64, scale: f64) -> (MeanBounds, f64) {
        let axes = self.frame.axes;
        let stretch = norm(axes);
        let reach = self.net.longest(DVec3::ZERO) / least;
        let rates = &self.first;
        // Of the derivatives: |μ_h|, its distance from the middle's, and |μ_h| in object space.
        let first = rates.each_ref().map(|rate| {
            let others = rate.precision[0] * reach;
            let solved = e / least * (rate.net.longest(DVec3::ZERO) + others);
            let off = rate.net.longest(rate.middle.information) + others + solved;
            let object = rate.net.longest_mapped(DVec3::ZERO, axes) + stretch * (others + solved);
            (rate.middle.information.length() + off, off, object)
        });
        let second = |rate: &Rate<'_, SECOND>, a: usize, b: usize| {
            let off = |h: usize, k: usize| {
                let middle = first[k].0 - first[k].1;
                rates[h].precision[1] * middle + rates[h].precision[0] * first[k].1
            };
            let (taken, others) = (
                self.product(a, b) + self.product(b, a),
                rate.precision[0] * reach + off(a, b) + off(b, a),
            );
            let solved = e / least * (rate.net.longest(taken) + others);
            (rate.net.longest_mapped(taken, axes) + stretch * (others + solved)) * scale * scale
        };
        let (low, high) = self.hull(e * reach);
        let [uu, uv, vv] = &self.second;
        let bounds = MeanBounds {
            low,
            high,
            first: first.map(|(_, _, object)| object * scale.abs()),
            second: [second(uu, 0, 0), second(uv, 0, 1), second(vv, 1, 1)],
        };
        (bounds, stretch * e * reach)
    }

    /// The box of the hull of q̄ in object space, and of what is within `margin` of it.
    fn hull(&self, margin: f64) -> (DVec3, DVec3) {
        let rows = self.frame.axes.transpose();
        let margin = DVec3::new(rows.x_axis.length(), rows.y_axis.length(), rows.z_axis.length()) * margin;
        let [low, high] = self.net.extent(self.frame.axes);
        (self.frame.centre + low - margin, self.frame.centre + high + margin)
    }
}

/// A bound of the norm of a matrix, exact where its columns are at right angles (Gershgorin, of the matrix of their products).
fn norm(matrix: DMat3) -> f64 {
    let columns = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    let row = |column: &DVec3| columns.iter().map(|other| column.dot(*other).abs()).sum::<f64>();
    columns.iter().map(row).fold(0.0, f64::max).sqrt()
}
