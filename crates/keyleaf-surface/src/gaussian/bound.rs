//! Bounds of the mean of a patch in dual space, and of its derivatives.
//!
//! # Theory
//!
//! The mean is no combination of the control points, so that their hull says nothing. But in dual space hulls hold. Take a part of a
//! patch in the coordinates in which its middle has mean 0 and precision 1. With E = q̂ − 1 and e the largest norm of E at a control
//! point, q̂ lies within e of 1 all over the part. Its eigenvalues are at most 1 + e and at least m, the least at the control points and at
//! least 1 − e, so that |q̂⁻¹| ≤ 1 / m and |q̂⁻¹ − 1| ≤ d = max((1 − m) / m, e / (1 + e)) if m > 0, and with hulls of control points
//! - |μ| ≤ R = max |q̄| / m, and μ = q̂⁻¹ q̄ lies within d max |q̄| of the hull of q̄;
//! - μ_h = q̂⁻¹ g with g = q̄_h − q̂_h μ, |g| ≤ G = max |q̄_h| + max |q̂_h| R, within (max |q̂_h| R + d G) of the hull of q̄_h;
//! - the same for second derivatives, with g = q̄_hk − q̂_hk μ − q̂_h μ_k − q̂_k μ_h, where the values in the middle are taken out of the
//!   products, so that the terms may cancel.
//!
//! Where e is large, ratios say more, since what is far is there mostly where q̂ is great. With the least eigenvalue λ_i of a control point,
//! that of q̂ is at least Σ B_i λ_i, so that |q̂⁻¹ v| ≤ max |v_i| / λ_i for any v of the degree of q̂, to which derivatives are raised:
//! - |μ| ≤ R = max |q̄_i| / λ_i, |μ_h| ≤ V_h = max (|q̄_h|_i + |q̂_h|_i R) / λ_i;
//! - |μ_hk| ≤ max (|q̄_hk|_i + |q̂_hk|_i R) / λ_i + W_h V_k + W_k V_h with W_h = max |q̂_h|_i / λ_i.
//!
//! Hulls are mapped to object space as they are, remainders by the norm of the map. e falls with the size of a part, and the bounds
//! become those of q̄. So the half of the parts whose bounds exceed by most what has been found is cut, squares into halves, triangles into
//! quarters, again and again, until none exceeds it by more than [`SLACK`] or there are enough parts.
//!
//! None of this needs the middle to have mean 0 and precision 1 exactly. So the patches of a face, most of them small, first have bounds in
//! the coordinates that they are stored in, in which the mean of their control points has: what these show to be less than what has been
//! found elsewhere needs no others, nor does what is small.
//!
//! # Costs
//!
//! Some 2 µs a part, less than half of it for the simpler bounds. Where covariances are alike a few parts do; where disks with conditions
//! of 1e4 are turned against each other, some hundreds.

use super::centred::{Findings, ceiling, findings};
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

    /// Of a point.
    fn at(point: DVec3) -> Self {
        Self {
            low: point,
            high: point,
            ..Self::NONE
        }
    }

    /// First and second derivatives, or those in parameters exchanged.
    fn quantities(&self, is_turned: bool) -> [f64; QUANTITIES] {
        let ([u, v], [uu, uv, vv]) = (self.first, self.second);
        if is_turned {
            [v, u, vv, uv, uu]
        } else {
            [u, v, uu, uv, vv]
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
        net: &Lanes::of(controls),
        frame,
        scale: 1.0,
    };
    of_patches(shape, &[whole], &Regions::one(1), [most; 2]).0[0]
}

/// A patch among those of a surface.
pub struct Whole<'a> {
    pub net: &'a Lanes<CONTROLS>,
    /// Of the control points.
    pub frame: &'a DualFrame,
    /// How many times the domain in whose parameters derivatives are wanted is as large as the patch.
    pub scale: f64,
}

/// Which patches count together: what is wanted of a region are the largest bounds of its patches.
pub struct Regions {
    pub count: usize,
    /// By patch: its regions, and whether their parameters are those of the patch exchanged.
    pub of_patch: Vec<Vec<(usize, bool)>>,
}

impl Regions {
    /// All patches in one.
    fn one(patches: usize) -> Self {
        Self {
            count: 1,
            of_patch: vec![vec![(0, false)]; patches],
        }
    }
}

/// The largest that has been found in the middles of parts.
struct Found {
    /// By region: first derivatives, second ones.
    of_regions: Vec<[f64; QUANTITIES]>,
    of_all: Option<MeanBounds>,
}

/// First and second derivatives.
const QUANTITIES: usize = 5;

impl Found {
    fn nothing(regions: &Regions) -> Self {
        Self {
            of_regions: vec![[0.0; QUANTITIES]; regions.count],
            of_all: None,
        }
    }

    fn add(&mut self, regions: &[(usize, bool)], middle: Option<MeanBounds>) {
        let Some(middle) = middle else { return };
        self.of_all = Some(self.of_all.map_or(middle, |all| all.union(middle)));
        for &(region, is_turned) in regions {
            let largest = &mut self.of_regions[region];
            for (largest, own) in largest.iter_mut().zip(middle.quantities(is_turned)) {
                *largest = f64::max(*largest, own);
            }
        }
    }

    /// The factor by which bounds of a patch exceed what is here, a root of it for second derivatives.
    fn excess(&self, regions: &[(usize, bool)], bounds: &MeanBounds) -> f64 {
        let [u, v, second @ ..] = self.shares(regions, bounds);
        second
            .into_iter()
            .fold(u.max(v), |excess, share| excess.max(share.sqrt()))
    }

    /// The largest share that bounds of a patch have of what is here.
    fn share(&self, regions: &[(usize, bool)], bounds: &MeanBounds) -> f64 {
        self.shares(regions, bounds).into_iter().fold(0.0, f64::max)
    }

    /// By quantity, the largest share in any of the patch's regions.
    fn shares(&self, regions: &[(usize, bool)], bounds: &MeanBounds) -> [f64; QUANTITIES] {
        let mut shares = [0.0; QUANTITIES];
        for &(region, is_turned) in regions {
            let found = self.of_regions[region].into_iter().zip(bounds.quantities(is_turned));
            for (share, (found, own)) in shares.iter_mut().zip(found) {
                if own > *share * found {
                    *share = own / found;
                }
            }
        }
        shares
    }
}

/// Bounds of patches; none need be closer than the largest that has been found in its regions. At most `most`
/// parts, the second number where the precision may not be positive definite. And what has been found in the middles of parts.
pub fn of_patches<S: Net>(
    shape: &S,
    patches: &[Whole<'_>],
    regions: &Regions,
    most: [usize; 2],
) -> (Vec<Option<MeanBounds>>, Option<MeanBounds>) {
    let mut found = Found::nothing(regions);
    let (mut parts, mut bounds) = whole_patches(shape, patches, regions, &mut found);
    // Patches without a part count as one as well.
    let others = patches.len() - parts.len();
    let most = most.map(|most| most.saturating_sub(others));
    loop {
        let chosen = loosest(&parts, patches, &found.of_all, most, S::PIECES);
        if chosen.is_empty() {
            break;
        }
        for index in chosen {
            let whole = parts.swap_remove(index);
            let frame = &patches[whole.patch].frame;
            for (net, [u, v]) in shape.cut(&whole.net, whole.findings.is_along_v) {
                let scale = [u * whole.scale[0], v * whole.scale[1]];
                let part = Part::new(shape, net, whole.patch, frame, scale);
                found.add(&regions.of_patch[whole.patch], part.findings.middle);
                parts.push(part);
            }
        }
    }
    unite(&parts, &mut bounds);
    (bounds, found.of_all)
}

/// The patches that may have more than what has been found, as parts, and the bounds of the others.
fn whole_patches(
    shape: &impl Net,
    patches: &[Whole<'_>],
    regions: &Regions,
    found: &mut Found,
) -> (Vec<Part>, Vec<Option<MeanBounds>>) {
    let part = |patch: usize| {
        let Whole { net, frame, scale } = patches[patch];
        Part::new(shape, *net, patch, frame, [scale; 2])
    };
    if patches.len() == 1 {
        let part = part(0);
        found.add(&regions.of_patch[0], part.findings.middle);
        return (vec![part], vec![None]);
    }
    let ceiling = |whole: &Whole<'_>| ceiling(shape, whole.net, whole.frame, whole.scale);
    let ceilings: Vec<Option<(MeanBounds, bool)>> = patches.iter().map(ceiling).collect();
    let mut bounds: Vec<Option<MeanBounds>> = ceilings.iter().map(|own| own.map(|(bounds, _)| bounds)).collect();
    let mut largest = Found::nothing(regions);
    for (regions, (bounds, whole)) in regions.of_patch.iter().zip(bounds.iter().zip(patches)) {
        largest.add(regions, *bounds);
        if bounds.is_some() {
            found.add(regions, Some(MeanBounds::at(whole.frame.centre)));
        }
    }
    // The largest first, so that what is found there shows that the others are less.
    let of_patches = bounds.iter().zip(&regions.of_patch).enumerate();
    let share = |bounds: &Option<MeanBounds>, regions| bounds.map_or(f64::INFINITY, |own| largest.share(regions, &own));
    let mut order: Vec<(f64, usize)> = of_patches
        .map(|(patch, (bounds, regions))| (share(bounds, regions), patch))
        .collect();
    order.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut parts = Vec::with_capacity(patches.len());
    for (_, patch) in order {
        let own = &regions.of_patch[patch];
        let is_enough = |(bounds, is_near): (MeanBounds, bool)| {
            // Where q̂ is nearly 1 other bounds would be no closer.
            found.share(own, &bounds) <= 1.0 || is_near && found.excess(own, &bounds) <= SLACK
        };
        if !ceilings[patch].is_some_and(is_enough) {
            let part = part(patch);
            found.add(own, part.findings.middle);
            parts.push(part);
            bounds[patch] = None;
        }
    }
    (parts, bounds)
}

/// The parts to cut next, last one first: half of those that are too loose, and as many as there is room for. Those without bounds count
/// as the loosest, and have a room of their own.
fn loosest(
    parts: &[Part],
    patches: &[Whole<'_>],
    found: &Option<MeanBounds>,
    most: [usize; 2],
    more: usize,
) -> Vec<usize> {
    let loose = |(index, part): (usize, &Part)| {
        let is_finest = part.scale[0].max(part.scale[1]) >= FINEST * patches[part.patch].scale;
        let excess = if is_finest { 0.0 } else { part.excess(found) };
        (excess > SLACK).then_some((excess, index))
    };
    let mut chosen: Vec<(f64, usize)> = parts.iter().enumerate().filter_map(loose).collect();
    chosen.sort_by(|a, b| b.0.total_cmp(&a.0));
    let unknown = chosen.iter().filter(|(excess, _)| excess.is_infinite()).count();
    let [room, room_for_unknown] = most.map(|most| most.saturating_sub(parts.len()) / (more - 1));
    let count = chosen.len().div_ceil(2).max(unknown);
    chosen.truncate(count.min(room.max(unknown.min(room_for_unknown))));
    let mut indices: Vec<usize> = chosen.into_iter().map(|(_, index)| index).collect();
    indices.sort_by(|a, b| b.cmp(a));
    indices
}

/// The bounds of the patches that have parts, none of one with a part that has none.
fn unite(parts: &[Part], bounds: &mut [Option<MeanBounds>]) {
    let mut sums: Vec<Option<Option<MeanBounds>>> = vec![None; bounds.len()];
    for part in parts {
        let own = part.findings.bounds.map(|(bounds, _)| bounds);
        let sum = &mut sums[part.patch];
        *sum = Some(match *sum {
            None => own,
            Some(sum) => sum.zip(own).map(|(sum, own)| sum.union(own)),
        });
    }
    for (sum, bounds) in sums.into_iter().zip(bounds) {
        *bounds = sum.unwrap_or(*bounds);
    }
}

/// A part of a patch.
struct Part {
    net: Lanes<CONTROLS>,
    /// The number of the patch.
    patch: usize,
    /// The parameters of the domain, in those of the part.
    scale: [f64; 2],
    findings: Findings,
}

impl Part {
    fn new(shape: &impl Net, net: Lanes<CONTROLS>, patch: usize, frame: &DualFrame, scale: [f64; 2]) -> Self {
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
