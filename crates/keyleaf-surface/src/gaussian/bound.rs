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
//! Some 4 µs a part. Where covariances are alike a few parts do; where disks with conditions of 1e4 are turned against each other,
//! some hundreds.

use super::centred::{Findings, findings};
use super::dual::{Dual, DualFrame};
use super::lanes::{CONTROLS, Lanes, Net, Square};
use super::lanes_of_triangle::Triangle;
use super::patch::{DualSquare, DualTriangle};
use glam::DVec3;

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
    /// Bounds of a bicubic patch along u and v. `frame` is that of the control points; the patch is cut into at most `parts` parts: with
    /// 64 bounds are good, with some hundreds within half of the least possible for nearly any patch. None if the precision of a part may
    /// not be positive definite, or the degrees are others.
    pub fn bounds(&self, frame: &DualFrame, parts: usize) -> Option<MeanBounds> {
        of_patch(&Square, self.bicubic()?, frame, parts)
    }
}

impl DualTriangle {
    /// Bounds of a quartic patch along two directions, given by changes of barycentric coordinates that sum to 0; see
    /// [`DualSquare::bounds`].
    pub fn bounds(&self, directions: [[f64; 3]; 2], frame: &DualFrame, parts: usize) -> Option<MeanBounds> {
        of_patch(&Triangle { directions }, self.quartic()?, frame, parts)
    }
}

fn of_patch(shape: &impl Net, controls: &[Dual], frame: &DualFrame, most: usize) -> Option<MeanBounds> {
    let whole = Whole {
        net: Lanes::of(controls),
        frame: *frame,
        scale: 1.0,
    };
    of_patches(shape, &[whole], [most; 2]).0[0]
}

/// A patch among those of a surface.
pub struct Whole {
    pub net: Lanes<CONTROLS>,
    /// Of the control points.
    pub frame: DualFrame,
    /// How many times the domain in whose parameters derivatives are wanted is as large as the patch.
    pub scale: f64,
}

/// Bounds of patches that count together: none of them need be closer than the largest that has been found on any. At most `most`
/// parts, the second number where the precision may not be positive definite. And what has been found in the middles of parts.
pub fn of_patches(
    shape: &impl Net,
    patches: &[Whole],
    most: [usize; 2],
) -> (Vec<Option<MeanBounds>>, Option<MeanBounds>) {
    let mut parts = Vec::with_capacity(2 * patches.len());
    for (patch, whole) in patches.iter().enumerate() {
        parts.push(Part::new(shape, whole.net, patch, &whole.frame, whole.scale));
    }
    let mut found = parts
        .iter()
        .filter_map(|part| part.findings.middle)
        .reduce(MeanBounds::union);
    loop {
        let chosen = loosest(&parts, patches, &found, most);
        if chosen.is_empty() {
            break;
        }
        for index in chosen {
            let whole = parts.swap_remove(index);
            let frame = &patches[whole.patch].frame;
            for quarter in shape.quarters(&whole.net) {
                let part = Part::new(shape, quarter, whole.patch, frame, 2.0 * whole.scale);
                found = [found, part.findings.middle]
                    .into_iter()
                    .flatten()
                    .reduce(MeanBounds::union);
                parts.push(part);
            }
        }
    }
    (united(&parts, patches.len()), found)
}

/// The parts to cut next, last one first: half of those that are too loose, and as many as there is room for. Those without bounds count
/// as the loosest, and have a room of their own.
fn loosest(parts: &[Part], patches: &[Whole], found: &Option<MeanBounds>, most: [usize; 2]) -> Vec<usize> {
    let loose = |(index, part): (usize, &Part)| {
        let is_finest = part.scale >= FINEST * patches[part.patch].scale;
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
fn united(parts: &[Part], patches: usize) -> Vec<Option<MeanBounds>> {
    let mut bounds: Vec<Option<Option<MeanBounds>>> = vec![None; patches];
    for part in parts {
        let own = part.findings.bounds.map(|(bounds, _)| bounds);
        let sum = &mut bounds[part.patch];
        *sum = Some(match *sum {
            None => own,
            Some(sum) => sum.zip(own).map(|(sum, own)| sum.union(own)),
        });
    }
    bounds.into_iter().map(Option::flatten).collect()
}

/// A part of a patch.
struct Part {
    net: Lanes<CONTROLS>,
    /// The number of the patch.
    patch: usize,
    /// The parameters of the domain, in those of the part.
    scale: f64,
    findings: Findings,
}

impl Part {
    fn new(shape: &impl Net, net: Lanes<CONTROLS>, patch: usize, frame: &DualFrame, scale: f64) -> Self {
        Self {
            patch,
            scale,
            findings: findings(shape, &net, frame, scale),
            net,
        }
    }

    /// The factor by which the bounds exceed what has been found.
    fn excess(&self, found: &Option<MeanBounds>) -> f64 {
        let (Some((bounds, margin)), Some(found)) = (&self.findings.bounds, found) else {
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
