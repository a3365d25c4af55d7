//! Bounds of the mean of a patch in dual space, and of its derivatives.
//!
//! # Theory
//!
//! The mean is no combination of the control points, so that their hull says nothing. But in dual space hulls hold. Take a part of a
//! patch in the coordinates in which its middle has mean 0 and precision 1. With E = q̂ − 1 and e the largest norm of E at a control
//! point, q̂ lies within e of 1 all over the part, so that |q̂⁻¹| ≤ 1 / (1 − e) if e < 1, and with hulls of control points
//! - |μ| ≤ R = max |q̄| / (1 − e), and μ = q̄ − E μ lies within e R of the hull of q̄;
//! - μ_h = q̂⁻¹ g with g = q̄_h − q̂_h μ, |g| ≤ G = max |q̄_h| + max |q̂_h| R, within (max |q̂_h| R + G e / (1 − e)) of the hull of q̄_h;
//! - the same for second derivatives, with g = q̄_hk − q̂_hk μ − q̂_h μ_k − q̂_k μ_h, where the values in the middle are taken out of the
//!   products, so that the terms may cancel.
//!
//! Hulls are mapped to object space as they are, remainders by the norm of the map. e falls with the size of a part, and the bounds
//! become those of q̄. So the part whose bounds exceed by most what has been found on the patch is cut into four, until none exceeds
//! it by more than [`SLACK`] or there are enough parts.
//!
//! # Costs
//!
//! About 30 µs a part. Where covariances are alike a few parts do; where disks with conditions of 1e4 are turned against each other,
//! some hundreds.

use super::dual::{Dual, DualFrame, DualJet, whitening};
use super::patch::{DualNet, DualSquare, DualTriangle, in_frame};
use glam::{DMat3, DVec3};

/// A part is not cut if its bounds exceed what has been found by no more than this factor: of first derivatives, of the roots of
/// second ones, and of the extent.
const SLACK: f64 = 1.5;

/// Parts are not cut to less than one over this: derivatives would be rounding.
const FINEST: f64 = 4096.0;

/// Bounds over a patch, in object space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeanBounds {
    /// Least coordinates of a box that holds the surface.
    pub low: DVec3,
    /// Greatest coordinates.
    pub high: DVec3,
    /// Of the lengths of the derivatives along both directions.
    pub first: [f64; 2],
    /// Of the lengths of the second derivatives: along the first direction, both, and the second.
    pub second: [f64; 3],
}

impl MeanBounds {
    fn union(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            first: std::array::from_fn(|k| self.first[k].max(other.first[k])),
            second: std::array::from_fn(|k| self.second[k].max(other.second[k])),
        }
    }
}

impl DualSquare {
    /// Bounds along u and v. `frame` is that of the control points; the patch is cut into at most `parts` parts: with
    /// 64 bounds are good, with some hundreds within half of the least possible for nearly any patch. None if the precision of a part may not be positive definite.
    pub fn bounds(&self, frame: &DualFrame, parts: usize) -> Option<MeanBounds> {
        of_patch(self, [0, 1], frame, parts)
    }
}

impl DualTriangle {
    /// Bounds along two directions, given by changes of barycentric coordinates that sum to 0; see [`DualSquare::bounds`].
    pub fn bounds(&self, directions: [[f64; 3]; 2], frame: &DualFrame, parts: usize) -> Option<MeanBounds> {
        of_patch(self, directions, frame, parts)
    }
}

fn of_patch<N: DualNet>(net: &N, directions: [N::Direction; 2], frame: &DualFrame, most: usize) -> Option<MeanBounds> {
    let part = |net: N, scale: f64| Part::new(net, directions, frame, scale);
    let mut parts = vec![part(net.map(|control| *control), 1.0)];
    let mut found = parts[0].middle;
    while parts.len() + 3 <= most.max(1) {
        let excess = |part: &Part<N>| part.excess(&found);
        let worst = (0..parts.len()).max_by(|&a, &b| excess(&parts[a]).total_cmp(&excess(&parts[b])))?;
        if excess(&parts[worst]) <= SLACK {
            break;
        }
        let whole = parts.swap_remove(worst);
        for quarter in whole.net.quarters() {
            let quarter = part(quarter, 2.0 * whole.scale);
            found = [found, quarter.middle].into_iter().flatten().reduce(MeanBounds::union);
            parts.push(quarter);
        }
    }
    let bounds = parts.iter().map(|part| part.known.map(|(bounds, _)| bounds));
    bounds.reduce(|a, b| Some(a?.union(b?)))?
}

/// A part of a patch.
struct Part<N> {
    net: N,
    /// The parameters of the patch, in those of the part.
    scale: f64,
    /// What its middle has, none if the precision there is not positive definite.
    middle: Option<MeanBounds>,
    /// Its bounds, and how much wider their box is than the hull; none if e is too great.
    known: Option<(MeanBounds, f64)>,
}

impl<N: DualNet> Part<N> {
    fn new(net: N, directions: [N::Direction; 2], frame: &DualFrame, scale: f64) -> Self {
        let centred = Centred::new(&net, frame);
        let middle = centred.as_ref().and_then(|centred| centred.middle(directions, scale));
        let known = centred.filter(|centred| centred.deviation < 1.0);
        Self {
            scale,
            middle,
            known: known.map(|centred| centred.bounds(directions, scale)),
            net,
        }
    }

    /// The factor by which the bounds exceed what has been found.
    fn excess(&self, found: &Option<MeanBounds>) -> f64 {
        if self.scale >= FINEST {
            return 0.0;
        }
        let (Some((bounds, margin)), Some(found)) = (&self.known, found) else {
            return f64::INFINITY;
        };
        let greatest = |lengths: &[f64]| lengths.iter().fold(0.0, |a: f64, &b| a.max(b));
        let ratio = |bound: f64, found: f64| if bound > found { bound / found } else { 1.0 };
        let extent = found.low.distance(found.high) + margin;
        let first = ratio(greatest(&bounds.first), greatest(&found.first));
        let second = ratio(greatest(&bounds.second), greatest(&found.second)).sqrt();
        first.max(second).max(ratio(extent + 4.0 * margin, extent))
    }
}

/// A part in the coordinates in which its middle has mean 0 and precision 1.
struct Centred<N> {
    net: N,
    /// From these coordinates to object space.
    frame: DualFrame,
    /// e.
    deviation: f64,
}

/// A derivative of the part in dual space.
struct Rate<N> {
    net: N,
    middle: Dual,
    /// The largest norm of q̂, and of its difference to the middle.
    precision: [f64; 2],
}

impl<N: DualNet> Rate<N> {
    fn new(net: N) -> Self {
        let middle = net.middle();
        let largest = |norm: &dyn Fn(&Dual) -> f64| net.controls().iter().map(norm).fold(0.0, f64::max);
        Self {
            precision: [
                largest(&|control| control.precision.norm()),
                largest(&|control| (control.precision - middle.precision).norm()),
            ],
            middle,
            net,
        }
    }

    /// The longest q̄ − `from`, mapped by `map`.
    fn longest(&self, from: DVec3, map: DMat3) -> f64 {
        let lengths = self
            .net
            .controls()
            .iter()
            .map(|control| (map * (control.information - from)).length());
        lengths.fold(0.0, f64::max)
    }
}

impl<N: DualNet> Centred<N> {
    fn new(net: &N, frame: &DualFrame) -> Option<Self> {
        let middle = net.middle();
        let own = DualFrame {
            centre: middle.mean()?,
            axes: whitening(middle.precision)?,
        };
        let net = in_frame(net, &own);
        let off = |control: &Dual| (control.precision - super::Symmetric3::IDENTITY).norm();
        Some(Self {
            deviation: net.controls().iter().map(off).fold(0.0, f64::max),
            net,
            frame: DualFrame {
                centre: frame.point(own.centre),
                axes: frame.axes * own.axes,
            },
        })
    }

    /// What the middle of the part has.
    fn middle(&self, directions: [N::Direction; 2], scale: f64) -> Option<MeanBounds> {
        let [u, v] = directions.map(|along| self.net.derivative(along));
        let second = [
            u.derivative(directions[0]),
            u.derivative(directions[1]),
            v.derivative(directions[1]),
        ];
        let [uu, uv, vv] = second.map(|net| net.middle() * (scale * scale));
        let terms = [self.net.middle(), u.middle() * scale, v.middle() * scale, uu, uv, vv];
        let jet = DualJet { terms }.mean()?.in_object_space(&self.frame);
        Some(MeanBounds {
            low: jet.mean,
            high: jet.mean,
            first: jet.first.map(|d| d.length()),
            second: jet.second.map(|d| d.length()),
        })
    }

    /// Bounds in the parameters of the patch, and how much wider the box is than the hull.
    fn bounds(&self, directions: [N::Direction; 2], scale: f64) -> (MeanBounds, f64) {
        let e = self.deviation;
        let (axes, own) = (self.frame.axes, DMat3::IDENTITY);
        let stretch = norm(axes);
        let longest = self
            .net
            .controls()
            .iter()
            .map(|control| control.information.length())
            .fold(0.0, f64::max);
        let reach = longest / (1.0 - e);
        let rates = directions.map(|along| Rate::new(self.net.derivative(along)));
        // Of the derivatives: |μ_h|, its distance from the middle's, and |μ_h| in object space.
        let first = [0, 1].map(|k| {
            let rate = &rates[k];
            let others = rate.precision[0] * reach;
            let solved = e / (1.0 - e) * (rate.longest(DVec3::ZERO, own) + others);
            let off = rate.longest(rate.middle.information, own) + others + solved;
            let object = rate.longest(DVec3::ZERO, axes) + stretch * (others + solved);
            (rate.middle.information.length() + off, off, object)
        });
        let second = |a: usize, b: usize| {
            let rate = Rate::new(rates[a].net.derivative(directions[b]));
            let product = |h: usize, k: usize| rates[h].middle.precision * rates[k].middle.information;
            let off = |h: usize, k: usize| {
                let middle = first[k].0 - first[k].1;
                rates[h].precision[1] * middle + rates[h].precision[0] * first[k].1
            };
            let (taken, others) = (
                product(a, b) + product(b, a),
                rate.precision[0] * reach + off(a, b) + off(b, a),
            );
            let solved = e / (1.0 - e) * (rate.longest(taken, own) + others);
            rate.longest(taken, axes) + stretch * (others + solved)
        };
        let (low, high) = self.hull(e * reach);
        let bounds = MeanBounds {
            low,
            high,
            first: first.map(|(_, _, object)| object * scale),
            second: [second(0, 0), second(0, 1), second(1, 1)].map(|bound| bound * scale * scale),
        };
        (bounds, stretch * e * reach)
    }

    /// The box of the hull of q̄ in object space, and of what is within `margin` of it.
    fn hull(&self, margin: f64) -> (DVec3, DVec3) {
        let rows = self.frame.axes.transpose();
        let margin = DVec3::new(rows.x_axis.length(), rows.y_axis.length(), rows.z_axis.length()) * margin;
        let points = || {
            self.net
                .controls()
                .iter()
                .map(|control| self.frame.point(control.information))
        };
        (
            points().fold(DVec3::INFINITY, DVec3::min) - margin,
            points().fold(DVec3::NEG_INFINITY, DVec3::max) + margin,
        )
    }
}

/// The norm of a matrix whose columns are at right angles but for a map of another frame: at most that of Frobenius.
fn norm(matrix: DMat3) -> f64 {
    let columns = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    let [x, y, z] = columns;
    let gram = super::Symmetric3::from_array([x.dot(x), x.dot(y), x.dot(z), y.dot(y), y.dot(z), z.dot(z)]);
    gram.eigen().values[0].max(0.0).sqrt()
}
