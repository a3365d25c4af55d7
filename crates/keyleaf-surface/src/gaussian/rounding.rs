//! What the shader loses of a mean in f32.
//!
//! # Theory
//!
//! In the frame of a patch the shader finds q̂ and q̄ with errors E and e, and solves (q̂ + E + S) μ' = q̄ + e. With u = 2⁻²⁴:
//! - sums are of stored and weighted control points: |E| ≤ [`SUM`] u Σ w |q̂_i|, and |e| ≤ [`SUM`] u Σ w |q̄_i|. Absolute eigenvalues sum up
//!   to the trace and twice the negative ones, so that Σ w |q̂_i| ≤ tr q̂ + 6 n if no eigenvalue of a control point is below −n;
//! - LDLᵀ with pivots is backward stable (Higham 2002, theorem 10.3): |S| ≤ [`SOLVER`] u tr q̂. By the adjugate, whose entries have
//!   roundings of (tr q̂)², it is tr q̂ / λ times as much.
//!
//! So |μ' − μ| ≤ (|e| + (|E| + |S|) |μ|) / (λ − |E| − |S|) with the least eigenvalue λ of q̂. It is concave: λ ≥ Σ w λ_i, so that a sum over
//! λ is at most the largest of its terms over λ_i, also over a part of a patch with the control points of the part. In this way tr q̂ / λ is
//! bounded, and |μ| ≤ |m| + max |q̄_i − q̂_i m| / λ_i with the mean m in the middle of the part. The norm of the axes takes lengths to object
//! space.
//!
//! The part with the largest bound is cut into four until none exceeds by more than [`SLACK`] what the middle of one has.

use super::dual::Dual;
use super::dual_patches::DualPatches;
use super::lanes::{CONTROLS, Lanes, Net};
use super::surface::Solver;
use crate::mesh::F32_ROUNDING;
use glam::DVec3;

/// Roundings of a term of the sum. There are 21 of a bicubic patch and 35 of a quartic one: storage, weight, products and sums. As many
/// up as down, they add up to about a root of that (Higham & Mary 2019), with room.
const SUM: f64 = 8.0;

/// Roundings of a solution as an error of q̂, likewise; there are 16 with divisions of 2.5 units in the last place.
const SOLVER: f64 = 6.0;

/// Roundings of the sum of three stored axes.
const MAP: f64 = 7.0;

/// How many times as large as what is found in the middle of a part bounds need not be.
const SLACK: f64 = 2.0;

/// The most cuts: so many, and one more for so many patches.
const CUTS: usize = 64;
const PATCHES_OF_CUT: usize = 8;

/// Parts are cut no more often.
const DEEPEST: u32 = 12;

/// How many times as large as what is found the error counts of a part that may not be positive definite.
const WITHOUT_BOUND: f64 = 8.0;

/// The most of λ that rounding takes. Where it may take more there is no bound, and this stands for it.
const MOST_OF_LEAST: f64 = 0.9;

/// Below this norm of q̂ − 1, eigenvalues are told from it.
const NEARLY_ONE: f64 = 0.5;

/// A bound of the error of means over all patches, besides that of coordinates; object units.
pub fn error(shape: &impl Net, patches: &DualPatches, solver: Solver) -> f64 {
    let (mut least, mut found) = (0.0, 0.0);
    let mut parts = Vec::new();
    for patch in 0..patches.frames.len() {
        let whole = Whole::new(patches, patch, solver);
        match whole.if_nearly_one(&patches.nets[patch]) {
            Some(bound) => least = f64::max(least, bound),
            None => parts.push(Part::first(shape, whole, patches.nets[patch])),
        }
    }
    for _ in 0..=CUTS + patches.frames.len() / PATCHES_OF_CUT {
        found = parts.iter().map(|part: &Part| part.in_middle).fold(found, f64::max);
        let enough = f64::max(least, SLACK * found);
        let is_loose = |part: &&mut Part| part.bound > enough && part.depth < DEEPEST;
        let loosest = parts.iter_mut().filter(is_loose);
        let Some(loosest) = loosest.max_by(|a, b| a.bound.total_cmp(&b.bound)) else {
            break;
        };
        let (whole, depth) = (loosest.whole, loosest.depth + 1);
        let [first, others @ ..] = shape.quarters(&loosest.net);
        *loosest = Part::new(shape, whole, first, depth);
        parts.extend(others.map(|net| Part::new(shape, whole, net, depth)));
    }
    let bounds = parts.iter().map(|part| part.bound);
    let known = |bound: f64| {
        if bound.is_finite() {
            bound
        } else {
            WITHOUT_BOUND * found
        }
    };
    bounds.map(known).fold(least, f64::max)
}

/// What all parts of a patch have in common.
#[derive(Clone, Copy)]
struct Whole {
    solver: Solver,
    /// The norm of the axes of the frame.
    stretch: f64,
    /// The longest q̄ of a control point.
    information: f64,
    /// The largest |q̄_i| / λ_i.
    reach: f64,
    /// 6 n.
    negative: f64,
}

impl Whole {
    fn new(patches: &DualPatches, patch: usize, solver: Solver) -> Self {
        let axes = patches.frames[patch].frame.axes;
        // They are at right angles.
        let columns = [axes.x_axis, axes.y_axis, axes.z_axis];
        Self {
            solver,
            stretch: longest(columns.into_iter()),
            information: patches.nets[patch].farthest(Dual::default())[1],
            reach: f64::INFINITY,
            negative: 0.0,
        }
    }

    /// The bound, if q̂ is nearly 1 all over the patch.
    fn if_nearly_one(&self, net: &Lanes<CONTROLS>) -> Option<f64> {
        let [off, _] = net.farthest(Dual::ONE);
        let trace = net.traces().into_iter().fold(0.0, f64::max);
        let least = 1.0 - off;
        let reach = self.information / least;
        (off < NEARLY_ONE).then(|| self.bound(trace / least, 0.0, reach, reach))
    }

    /// With bounds of tr q̂ / λ, 6 n / λ, Σ w |q̄_i| / λ and |μ|.
    fn bound(&self, condition: f64, negative: f64, information: f64, reach: f64) -> f64 {
        let solved = match self.solver {
            Solver::Ldlt => SOLVER,
            Solver::Adjugate => SOLVER * condition,
        };
        let off = F32_ROUNDING * (SUM * (condition + negative) + solved * condition);
        let lost = F32_ROUNDING * SUM * information + off * reach;
        self.stretch * (lost / (1.0 - off.min(MOST_OF_LEAST)) + F32_ROUNDING * MAP * reach)
    }
}

fn longest(vectors: impl Iterator<Item = DVec3>) -> f64 {
    vectors.map(DVec3::length_squared).fold(0.0, f64::max).sqrt()
}

/// A part of a patch.
struct Part {
    whole: Whole,
    net: Lanes<CONTROLS>,
    depth: u32,
    /// Infinite if a control point is not positive definite.
    bound: f64,
    /// The same with what is in the middle, 0 if that is not positive definite.
    in_middle: f64,
}

impl Part {
    /// A whole patch.
    fn first<S: Net>(shape: &S, mut whole: Whole, net: Lanes<CONTROLS>) -> Self {
        let least = net.least_eigenvalues();
        if least.iter().all(|&least| least > 0.0) {
            whole.reach = greatest_ratio(&net.residuals(DVec3::ZERO), &least);
        } else {
            whole.negative = 6.0 * f64::max(0.0, -net.least_eigenvalue(0.0));
        }
        Self::new(shape, whole, net, 0)
    }

    fn new<S: Net>(_: &S, whole: Whole, net: Lanes<CONTROLS>, depth: u32) -> Self {
        let middle = net.weighted(&S::MIDDLE);
        let least = net.least_eigenvalues();
        let of_all = least.iter().copied().fold(f64::INFINITY, f64::min);
        let bound = |least: f64, condition: f64, reach: f64| {
            let information = f64::min(whole.information / least, whole.reach);
            whole.bound(condition, whole.negative / least, information, reach)
        };
        let (mut own, mut in_middle) = (f64::INFINITY, 0.0);
        if let Some(mean) = middle.mean() {
            let least_there = middle.precision.eigen().values[2];
            in_middle = bound(least_there, middle.precision.trace() / least_there, mean.length());
            if of_all > 0.0 {
                let reach = mean.length() + greatest_ratio(&net.residuals(mean), &least);
                own = bound(of_all, greatest_ratio(&net.traces(), &least), reach);
            }
        }
        Self {
            whole,
            net,
            depth,
            bound: own,
            in_middle,
        }
    }
}

fn greatest_ratio(over: &[f64; CONTROLS], under: &[f64; CONTROLS]) -> f64 {
    let ratios = over.iter().zip(under).map(|(over, under)| over / under);
    ratios.fold(0.0, f64::max)
}
