//! A part of a patch in the coordinates in which its middle has mean 0 and precision 1: there its bounds are found, see [`bound`](super::bound).

use super::bound::MeanBounds;
use super::dual::{Dual, DualFrame};
use super::lanes::{CONTROLS, FIRST, Lanes, Net, Raising, SECOND};
use glam::{DMat3, DVec3};
use std::marker::PhantomData;

/// Below this e, 1 − e is near enough to the least eigenvalue of q̂.
const PLAIN_DEVIATION: f64 = 0.25;

/// Below this e, bounds are hardly closer in the coordinates of a part's own middle.
const NEARLY_ONE: f64 = 0.1;

/// From this e on there is no [`ceiling`].
const MOST_DEVIATION: f64 = 0.5;

/// What is known of a part, in the parameters of the domain.
#[derive(Clone, Copy, Debug, Default)]
pub struct Findings {
    /// What its middle has, none if the precision there is not positive definite.
    pub middle: Option<MeanBounds>,
    /// Its bounds, and how much wider their box is than the hull; none if e is too great.
    pub bounds: Option<(MeanBounds, f64)>,
    /// Whether q̂ changes more along the second direction.
    pub is_along_v: bool,
}

/// Of the part with these control points; `frame` is theirs, and the domain is `scale` times as large along both directions.
pub fn findings<S: Net>(shape: &S, net: &Lanes<CONTROLS>, frame: &DualFrame, scale: [f64; 2]) -> Findings {
    let Some((factors, centre)) = net.weighted(&S::MIDDLE).solve() else {
        return Findings::default();
    };
    let own = DualFrame {
        centre,
        axes: factors.whitening(),
    };
    let net = net.in_frame(&own);
    let frame = DualFrame {
        centre: frame.point(centre),
        axes: frame.axes * own.axes,
    };
    let centred = Centred::new(shape, &net, frame);
    Findings {
        middle: Some(centred.middle(scale)),
        bounds: centred.bounds(net.farthest(Dual::ONE), scale),
        is_along_v: centred.is_along_v(),
    }
}

/// Bounds of a patch from the coordinates of its control points, in which their mean has mean 0 and precision 1, and whether q̂ is nearly 1.
/// None if it is far from 1.
pub fn ceiling<S: Net>(shape: &S, net: &Lanes<CONTROLS>, frame: &DualFrame, scale: f64) -> Option<(MeanBounds, bool)> {
    let farthest = net.farthest(Dual::ONE);
    let [e, _] = farthest;
    let is_near = e < MOST_DEVIATION;
    let bounds = is_near.then(|| Centred::new(shape, net, *frame).bounds(farthest, [scale; 2]));
    bounds.flatten().map(|(bounds, _)| (bounds, e < NEARLY_ONE))
}

/// A part in coordinates in which its middle has about mean 0 and precision 1.
struct Centred<'a, S> {
    net: &'a Lanes<CONTROLS>,
    /// From these coordinates to object space.
    frame: DualFrame,
    /// Along both directions.
    first: [Lanes<FIRST>; 2],
    /// The largest norms and lengths of these, see [`Lanes::largest`].
    largest: [[f64; 3]; 2],
    /// In the middle.
    rates: [Dual; 2],
    /// Along the first direction twice, both, and the second twice.
    second: [Lanes<SECOND>; 3],
    shape: PhantomData<S>,
}

/// By second derivative, the directions along which it is.
const DIRECTIONS: [[usize; 2]; 3] = [[0, 0], [0, 1], [1, 1]];

/// What a second derivative is multiplied with in longer parameters.
fn product(scale: [f64; 2], second: usize) -> f64 {
    let [h, k] = DIRECTIONS[second];
    scale[h] * scale[k]
}

impl<'a, S: Net> Centred<'a, S> {
    fn new(shape: &S, net: &'a Lanes<CONTROLS>, frame: DualFrame) -> Self {
        let first = shape.first(net);
        Self {
            net,
            frame,
            rates: [0, 1].map(|h| first[h].weighted(&S::MIDDLE_OF_FIRST[h])),
            second: shape.second(&first),
            largest: [0, 1].map(|h| first[h].largest(DVec3::ZERO, frame.axes)),
            first,
            shape: PhantomData,
        }
    }

    /// With mean 0 and precision 1, μ_h = q̄_h and μ_hk = q̄_hk − q̂_h μ_k − q̂_k μ_h.
    fn middle(&self, scale: [f64; 2]) -> MeanBounds {
        let length = |v: DVec3| (self.frame.axes * v).length();
        let second = |n: usize| {
            let [_, _, _, _, _, _, x, y, z] = &self.second[n].0;
            let weights = &S::MIDDLE_OF_SECOND[n];
            let sum = |lane: &[f64; SECOND]| lane.iter().zip(weights).map(|(x, weight)| x * weight).sum();
            length(DVec3::new(sum(x), sum(y), sum(z)) - self.products(n))
        };
        MeanBounds {
            low: self.frame.centre,
            high: self.frame.centre,
            first: [0, 1].map(|h| length(self.rates[h].information) * scale[h]),
            second: [0, 1, 2].map(|n| second(n) * product(scale, n)),
        }
    }

    fn is_along_v(&self) -> bool {
        let [[u, ..], [v, ..]] = self.largest;
        v > u
    }

    /// q̂_h μ_k + q̂_k μ_h in the middle.
    fn products(&self, second: usize) -> DVec3 {
        let [h, k] = DIRECTIONS[second].map(|h| self.rates[h]);
        h.precision * k.information + k.precision * h.information
    }

    /// The bounds, and how much wider their box is than the hull; none if q̂ may not be positive definite. From what the theory calls e, and
    /// the longest q̄.
    fn bounds(&self, [e, longest]: [f64; 2], scale: [f64; 2]) -> Option<(MeanBounds, f64)> {
        // What the theory calls m; eigenvalues of control points only where they may say more than 1 − e.
        let is_plain = e < PLAIN_DEVIATION;
        let eigenvalues = if is_plain {
            [1.0; CONTROLS]
        } else {
            self.net.least_eigenvalues()
        };
        let least = if is_plain {
            1.0 - e
        } else {
            eigenvalues.into_iter().fold(1.0, f64::min).max(1.0 - e)
        };
        if least.is_nan() || least <= 0.0 {
            return None;
        }
        let ratios = (!is_plain).then(|| self.ratios(&eigenvalues));
        let axes = self.frame.axes;
        let stretch = norm(axes);
        // Of |q̂⁻¹ − 1|, and |μ|.
        let solving = f64::max((1.0 - least) / least, e / (1.0 + e));
        let reach = ratios.as_ref().map_or(longest / least, |ratios| ratios.reach);
        let first = [0, 1].map(|h| {
            let [precision, information, mapped] = self.largest[h];
            let [precision_off, information_off] = self.first[h].farthest(self.rates[h]);
            let others = precision * reach;
            let solved = solving * (information + others);
            Rate {
                precision,
                precision_off,
                middle: self.rates[h].information.length(),
                off: information_off + others + solved,
                object: mapped + stretch * (others + solved),
            }
        });
        let second = |n: usize| {
            let [precision, information, mapped] = self.second[n].largest(self.products(n), axes);
            let off = |h: &Rate, k: &Rate| h.precision_off * k.middle + h.precision * k.off;
            let [h, k] = DIRECTIONS[n].map(|h| &first[h]);
            let others = precision * reach + off(h, k) + off(k, h);
            mapped + stretch * (others + solving * (information + others))
        };
        let mut second = [0, 1, 2].map(second);
        let mut first = first.map(|rate| rate.object);
        if let Some(ratios) = ratios {
            first = [0, 1].map(|h| first[h].min(stretch * ratios.first[h]));
            second = [0, 1, 2].map(|n| second[n].min(stretch * ratios.second[n]));
        }
        let margin = solving * longest;
        let (low, high) = hull(self.net, &self.frame, margin);
        let bounds = MeanBounds {
            low,
            high,
            first: [0, 1].map(|h| first[h] * scale[h]),
            second: [0, 1, 2].map(|n| second[n] * product(scale, n)),
        };
        Some((bounds, stretch * margin))
    }
}

/// What is known of a first derivative of a part.
struct Rate {
    /// The largest norm of q̂_h, and of its difference to that of the middle.
    precision: f64,
    precision_off: f64,
    /// The length of what the derivative of the mean is about in the middle, and how far it is from that anywhere.
    middle: f64,
    off: f64,
    /// Its length in object space.
    object: f64,
}

/// Bounds of the lengths of the mean and its derivatives.
struct Ratios {
    reach: f64,
    first: [f64; 2],
    second: [f64; 3],
}

impl<S: Net> Centred<'_, S> {
    /// By the least eigenvalues of the control points.
    fn ratios(&self, least: &[f64; CONTROLS]) -> Ratios {
        let over_least = |over: [f64; CONTROLS]| {
            let ratios = over.iter().zip(least).map(|(over, least)| over / least);
            ratios.fold(0.0, f64::max)
        };
        let [_, information] = self.net.norms();
        let reach = over_least(information);
        let rates: [[f64; 2]; 2] = std::array::from_fn(|h| {
            let raise = |norms| over_least(raised(&S::RAISE_FIRST[h], norms));
            let [precision, information] = self.first[h].norms();
            let sum = std::array::from_fn(|k| information[k] + precision[k] * reach);
            [raise(&precision), raise(&sum)]
        });
        let second = [0, 1, 2].map(|n| {
            let [h, k] = DIRECTIONS[n];
            let [precision, information] = self.second[n].norms();
            let sum = std::array::from_fn(|k| information[k] + precision[k] * reach);
            over_least(raised(&S::RAISE_SECOND[n], &sum)) + rates[h][0] * rates[k][1] + rates[k][0] * rates[h][1]
        });
        Ratios {
            reach,
            first: rates.map(|[_, speed]| speed),
            second,
        }
    }
}

fn raised<const N: usize>(raising: &Raising<N>, coefficients: &[f64; N]) -> [f64; CONTROLS] {
    let mut sums = [0.0; CONTROLS];
    for (weights, coefficient) in raising.iter().zip(coefficients) {
        for k in 0..CONTROLS {
            sums[k] += weights[k] * coefficient;
        }
    }
    sums
}

/// The box of the hull of q̄ in object space, and of what is within `margin` of it.
fn hull(net: &Lanes<CONTROLS>, frame: &DualFrame, margin: f64) -> (DVec3, DVec3) {
    let rows = frame.axes.transpose();
    let margin = DVec3::new(rows.x_axis.length(), rows.y_axis.length(), rows.z_axis.length()) * margin;
    let [low, high] = net.extent(frame.axes);
    (frame.centre + low - margin, frame.centre + high + margin)
}

/// A bound of the norm of a matrix, exact where its columns are at right angles (Gershgorin, of the matrix of their products).
fn norm(matrix: DMat3) -> f64 {
    let columns = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    let row = |column: &DVec3| columns.iter().map(|other| column.dot(*other).abs()).sum::<f64>();
    columns.iter().map(row).fold(0.0, f64::max).sqrt()
}
