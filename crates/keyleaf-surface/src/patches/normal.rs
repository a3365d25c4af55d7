//! Unit normals of patches, also where the tangents vanish or are parallel.

use super::evaluation::{KsQuad, PatchJet, inward_direction, inwards};
use super::span::Fraction;
use crate::direction::{PARALLEL, cross_direction, scaled};
use crate::mesh::unit_or_up;
use glam::DVec3;

/// Samples along a side for [`mean`].
const SAMPLES: u32 = 4;

/// Tangents below this part of the second derivatives are zero but for rounding.
const VANISHING: f64 = 1e-12;

/// The direction of du × dv. Where that vanishes: its limit from inside, by derivatives and then by a small step; last, `mean`.
pub fn of(quad: &KsQuad<'_>, at: [Fraction; 2], jet: &PatchJet, mean: impl FnOnce() -> DVec3) -> DVec3 {
    let inward = inward_direction(at);
    let vanishes = |tangent: DVec3, changes: [DVec3; 2]| {
        let largest = changes.iter().map(|v| v.length()).fold(0.0, f64::max);
        tangent.length() <= VANISHING * largest
    };
    let limit = match [
        vanishes(jet.du, [jet.duu, jet.duv]),
        vanishes(jet.dv, [jet.duv, jet.dvv]),
    ] {
        // At an edge that is a point, du grows from zero as duv does, inwards along v.
        [true, false] => cross_direction(jet.duv * inward[1], jet.dv),
        [false, true] => cross_direction(jet.du, jet.duv * inward[0]),
        [false, false] => cross_direction(jet.du, jet.dv),
        [true, true] => None,
    };
    limit
        .or_else(|| limit_along(jet, inward))
        .or_else(|| {
            let inside = quad.jet(inwards(at));
            cross_direction(inside.du, inside.dv)
        })
        .unwrap_or_else(mean)
}

/// The direction in which du × dv leaves zero along a step (a, b): (a duu + b duv) × dv + du × (a duv + b dvv).
fn limit_along(jet: &PatchJet, [a, b]: [f64; 2]) -> Option<DVec3> {
    let (du_change, dv_change) = (jet.duu * a + jet.duv * b, jet.duv * a + jet.dvv * b);
    let vectors = [jet.du, jet.dv, du_change, dv_change];
    let largest = vectors.iter().map(|v| v.abs().max_element()).fold(0.0, f64::max);
    if largest <= 1e-300 {
        return None;
    }
    let [du, dv, du_change, dv_change] = vectors.map(|v| v / largest);
    let change = du_change.cross(dv) + du.cross(dv_change);
    let possible = du_change.length() * dv.length() + du.length() * dv_change.length();
    (change.length() > PARALLEL * possible).then(|| scaled(change).normalize())
}

/// The mean normal of a face: the direction of ∫ du × dv, or of the longest du × dv where that cancels. A unit vector always.
pub fn mean(quad: &KsQuad<'_>) -> DVec3 {
    let sample = |k: u32| Fraction::new((f64::from(k) + 0.5) / f64::from(SAMPLES));
    let crosses = (0..SAMPLES).flat_map(|j| {
        (0..SAMPLES).map(move |i| {
            let jet = quad.jet([sample(i), sample(j)]);
            jet.du.cross(jet.dv)
        })
    });
    let (mut sum, mut lengths, mut longest) = (DVec3::ZERO, 0.0, DVec3::ZERO);
    for cross in crosses {
        sum += cross;
        lengths += cross.length();
        if cross.length_squared() > longest.length_squared() {
            longest = cross;
        }
    }
    unit_or_up(if sum.length() > 1e-9 * lengths { sum } else { longest })
}
