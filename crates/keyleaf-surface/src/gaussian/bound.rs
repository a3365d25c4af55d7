//! Bounds of the mean of a patch in dual space, and of its derivatives.
//!
//! # Theory
//!
//! The mean is no combination of the control points, so that their hull says nothing. But in dual space hulls hold. Take a part of a
//! patch in the coordinates in which its middle has mean 0 and precision 1. With E = q̂ − 1 and e the largest norm of E at a control
//! point, q̂ lies within e of 1 all over the part. Its eigenvalues are at least m, the least at the control points and at least 1 − e, so that
//! |q̂⁻¹| ≤ 1 / m and |q̂⁻¹ − 1| ≤ e / m if m > 0, and with hulls of control points
//! - |μ| ≤ R = max |q̄| / m, and μ = q̄ − E μ lies within e R of the hull of q̄;
//! - μ_h = q̂⁻¹ g with g = q̄_h − q̂_h μ, |g| ≤ G = max |q̄_h| + max |q̂_h| R, within (max |q̂_h| R + G e / m) of the hull of q̄_h;
//! - the same for second derivatives, with g = q̄_hk − q̂_hk μ − q̂_h μ_k − q̂_k μ_h, where the values in the middle are taken out of the
//!   products, so that the terms may cancel.
//!
//! Hulls are mapped to object space as they are, remainders by the norm of the map. e falls with the size of a part, and the bounds
//! become those of q̄. So the half of the parts whose bounds exceed by most what has been found is cut into four, again and again, until
//! none exceeds it by more than [`SLACK`] or there are enough parts.
//!
//! # Costs
//!
//! About 10 µs a part. Where covariances are alike a few parts do; where disks with conditions of 1e4 are turned against each other,
//! some hundreds.

use super::dual::{Dual, DualFrame, DualJet};
use super::patch::{DualNet, DualSquare, DualTriangle, in_frame};
use super::solve::Ldl;
use super::symmetric::Symmetric3;
use glam::{DMat3, DVec3};

/// A part is not cut if its bounds exceed what has been found by no more than this factor: of first derivatives, of the roots of
/// second ones, and of the extent.
const SLACK: f64 = 1.5;

/// Parts are not cut to less than one over this: derivatives would be rounding.
const FINEST: f64 = 4096.0;

/// Below this e, 1 − e is near enough to the least eigenvalue of q̂.
const PLAIN_DEVIATION: f64 = 0.25;

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
    /// Of nothing.
    pub(super) const NONE: Self = Self {
        low: DVec3::INFINITY,
        high: DVec3::NEG_INFINITY,
        first: [0.0; 2],
        second: [0.0; 3],
    };

    /// With a box and derivatives so many times as large.
    pub(super) fn widened(self, factor: f64) -> Self {
        let reach = (self.high - self.low) * (factor / 2.0);
        let middle = (self.low + self.high) / 2.0;
        Self {
            low: middle - reach,
            high: middle + reach,
            first: self.first.map(|x| x * factor),
            second: self.second.map(|x| x * factor),
        }
    }

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
    let whole = Whole {
        net: net.map(|control| *control),
        frame: *frame,
        scale: 1.0,
    };
    of_patches(vec![whole], directions, [most; 2]).0[0]
}

/// A patch among those of a surface.
pub struct Whole<N> {
    pub net: N,
    /// Of the control points.
    pub frame: DualFrame,
    /// How many times the domain in whose parameters derivatives are wanted is as large as the patch.
    pub scale: f64,
}

/// Bounds of patches that count together: none of them need be closer than the largest that has been found on any. At most `most`
/// parts, the second number where the precision may not be positive definite. And what has been found in the middles of parts.
pub fn of_patches<N: DualNet>(
    patches: Vec<Whole<N>>,
    directions: [N::Direction; 2],
    most: [usize; 2],
) -> (Vec<Option<MeanBounds>>, Option<MeanBounds>) {
    let scales: Vec<f64> = patches.iter().map(|patch| patch.scale).collect();
    let frames: Vec<DualFrame> = patches.iter().map(|patch| patch.frame).collect();
    let mut parts: Vec<Part<N>> = patches
        .into_iter()
        .enumerate()
        .map(|(patch, whole)| Part::new(whole.net, patch, directions, &whole.frame, whole.scale))
        .collect();
    let mut found = parts.iter().filter_map(|part| part.middle).reduce(MeanBounds::union);
    loop {
        let chosen = loosest(&parts, &scales, &found, most);
        if chosen.is_empty() {
            break;
        }
        for index in chosen {
            let whole = parts.swap_remove(index);
            for quarter in whole.net.quarters() {
                let part = Part::new(
                    quarter,
                    whole.patch,
                    directions,
                    &frames[whole.patch],
                    2.0 * whole.scale,
                );
                found = [found, part.middle].into_iter().flatten().reduce(MeanBounds::union);
                parts.push(part);
            }
        }
    }
    (united(&parts, scales.len()), found)
}

/// The parts to cut next, last one first: half of those that are too loose, and as many as there is room for. Those without bounds count
/// as the loosest, and have a room of their own.
fn loosest<N: DualNet>(parts: &[Part<N>], scales: &[f64], found: &Option<MeanBounds>, most: [usize; 2]) -> Vec<usize> {
    let loose = |(index, part): (usize, &Part<N>)| {
        let is_finest = part.scale >= FINEST * scales[part.patch];
        let excess = if is_finest { 0.0 } else { part.excess(found) };
        (excess > SLACK).then_some((excess, index))
    };
    let mut chosen: Vec<(f64, usize)> = parts.iter().enumerate().filter_map(loose).collect();
    chosen.sort_by(|a, b| b.0.total_cmp(&a.0));
    let unknown = chosen.iter().filter(|(excess, _)| excess.is_infinite()).count();
    let [room, room_for_unknown] = most.map(|most| most.saturating_sub(parts.len()) / 3);
    let count = chosen.len().div_ceil(2).max(unknown);
    chosen.truncate(count.min(room.max(unknown.min(room_for_unknown))));
    let mut indices: Vec<usize> = chosen.into_iter().map(|(_, index)| index).collect();
    indices.sort_by(|a, b| b.cmp(a));
    indices
}

/// The bounds of the patches, none of one with a part that has none.
fn united<N>(parts: &[Part<N>], patches: usize) -> Vec<Option<MeanBounds>> {
    let mut bounds: Vec<Option<Option<MeanBounds>>> = vec![None; patches];
    for part in parts {
        let own = part.known.map(|(bounds, _)| bounds);
        let sum = &mut bounds[part.patch];
        *sum = Some(match *sum {
            None => own,
            Some(sum) => sum.zip(own).map(|(sum, own)| sum.union(own)),
        });
    }
    bounds.into_iter().map(Option::flatten).collect()
}

/// A part of a patch.
struct Part<N> {
    net: N,
    /// The number of the patch.
    patch: usize,
    /// The parameters of the domain, in those of the part.
    scale: f64,
    /// What its middle has, none if the precision there is not positive definite.
    middle: Option<MeanBounds>,
    /// Its bounds, and how much wider their box is than the hull; none if e is too great.
    known: Option<(MeanBounds, f64)>,
}

impl<N: DualNet> Part<N> {
    fn new(net: N, patch: usize, directions: [N::Direction; 2], frame: &DualFrame, scale: f64) -> Self {
        let centred = Centred::new(&net, directions, frame);
        let middle = centred.as_ref().and_then(|centred| centred.middle(scale));
        let known = centred.filter(|centred| centred.least > 0.0);
        Self {
            patch,
            scale,
            middle,
            known: known.map(|centred| centred.bounds(scale)),
            net,
        }
    }

    /// The factor by which the bounds exceed what has been found.
    fn excess(&self, found: &Option<MeanBounds>) -> f64 {
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
    /// A lower bound of the eigenvalues of q̂ over the part; if it is not positive nothing is known.
    least: f64,
    /// Along both directions.
    rates: [Rate<N>; 2],
    /// Along the first direction twice, both, and the second twice.
    second: [Rate<N>; 3],
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
    fn new(net: &N, directions: [N::Direction; 2], frame: &DualFrame) -> Option<Self> {
        let middle = net.middle();
        let own = DualFrame {
            centre: middle.mean()?,
            axes: Ldl::new(middle.precision)?.whitening(),
        };
        let net = in_frame(net, &own);
        let off = |control: &Dual| (control.precision - Symmetric3::IDENTITY).norm();
        let deviation = net.controls().iter().map(off).fold(0.0, f64::max);
        let least = |control: &Dual| control.precision.eigen().values[2];
        let rates = directions.map(|along| Rate::new(net.derivative(along)));
        Some(Self {
            deviation,
            least: if deviation < PLAIN_DEVIATION {
                1.0 - deviation
            } else {
                net.controls().iter().map(least).fold(1.0, f64::min)
            },
            second: [(0, 0), (0, 1), (1, 1)].map(|(a, b)| Rate::new(rates[a].net.derivative(directions[b]))),
            rates,
            net,
            frame: DualFrame {
                centre: frame.point(own.centre),
                axes: frame.axes * own.axes,
            },
        })
    }

    /// What the middle of the part has.
    fn middle(&self, scale: f64) -> Option<MeanBounds> {
        let [u, v] = &self.rates;
        let [uu, uv, vv] = self.second.each_ref().map(|rate| rate.middle * (scale * scale));
        let terms = [self.net.middle(), u.middle * scale, v.middle * scale, uu, uv, vv];
        let jet = DualJet { terms }.mean()?.in_object_space(&self.frame);
        Some(MeanBounds {
            low: jet.mean,
            high: jet.mean,
            first: jet.first.map(|d| d.length()),
            second: jet.second.map(|d| d.length()),
        })
    }

    /// Bounds in the parameters of the patch, and how much wider the box is than the hull.
    fn bounds(&self, scale: f64) -> (MeanBounds, f64) {
        let e = self.deviation;
        let (axes, own) = (self.frame.axes, DMat3::IDENTITY);
        let stretch = norm(axes);
        let longest = self
            .net
            .controls()
            .iter()
            .map(|control| control.information.length())
            .fold(0.0, f64::max);
        let reach = longest / self.least;
        let rates = &self.rates;
        // Of the derivatives: |μ_h|, its distance from the middle's, and |μ_h| in object space.
        let first = [0, 1].map(|k| {
            let rate = &rates[k];
            let others = rate.precision[0] * reach;
            let solved = e / self.least * (rate.longest(DVec3::ZERO, own) + others);
            let off = rate.longest(rate.middle.information, own) + others + solved;
            let object = rate.longest(DVec3::ZERO, axes) + stretch * (others + solved);
            (rate.middle.information.length() + off, off, object)
        });
        let second = |rate: &Rate<N>, a: usize, b: usize| {
            let product = |h: usize, k: usize| rates[h].middle.precision * rates[k].middle.information;
            let off = |h: usize, k: usize| {
                let middle = first[k].0 - first[k].1;
                rates[h].precision[1] * middle + rates[h].precision[0] * first[k].1
            };
            let (taken, others) = (
                product(a, b) + product(b, a),
                rate.precision[0] * reach + off(a, b) + off(b, a),
            );
            let solved = e / self.least * (rate.longest(taken, own) + others);
            rate.longest(taken, axes) + stretch * (others + solved)
        };
        let (low, high) = self.hull(e * reach);
        let bounds = MeanBounds {
            low,
            high,
            first: first.map(|(_, _, object)| object * scale.abs()),
            second: [
                second(&self.second[0], 0, 0),
                second(&self.second[1], 0, 1),
                second(&self.second[2], 1, 1),
            ]
            .map(|bound| bound * scale * scale),
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

/// A bound of the norm of a matrix, exact where its columns are at right angles (Gershgorin, of the matrix of their products).
fn norm(matrix: DMat3) -> f64 {
    let columns = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    let row = |column: &DVec3| columns.iter().map(|other| column.dot(*other).abs()).sum::<f64>();
    columns.iter().map(row).fold(0.0, f64::max).sqrt()
}
