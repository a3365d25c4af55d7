//! Boundaries that lie along each other without being the same curve: where joined models show gaps unless both sides are fine.

use super::boundary::BoundaryCurve;
use glam::DVec3;

/// Boundaries closer than this part of the diagonal of the model's box lie along each other.
const ALONG: f64 = 1e-3;
/// Points of a boundary that must lie along another.
const SAMPLES: usize = 9;
/// Chords a span that stand for the other curve.
const CHORDS: usize = 16;

/// For each of the open boundaries, whether another one lies along it. `diagonal` is that of the model's box.
pub fn along_each_other(curves: &[&BoundaryCurve], diagonal: f64) -> Vec<bool> {
    let distance = ALONG * diagonal;
    let chains: Vec<Vec<DVec3>> = curves.iter().map(|curve| curve.chain(CHORDS)).collect();
    let boxes: Vec<(DVec3, DVec3)> = chains.iter().map(|chain| bounds(chain, distance)).collect();
    let samples: Vec<Vec<DVec3>> = curves.iter().map(|curve| curve.samples(SAMPLES)).collect();
    let lies_along = |one: usize, other: usize| {
        let (low, high) = boxes[other];
        let is_near = |p: &DVec3| {
            let inside = p.cmpge(low).all() && p.cmple(high).all();
            inside
                && chains[other]
                    .windows(2)
                    .any(|ends| to_chord(*p, ends[0], ends[1]) <= distance)
        };
        samples[one].iter().all(is_near)
    };
    let others = |one: usize| (0..curves.len()).filter(move |&other| other != one);
    (0..curves.len())
        .map(|one| others(one).any(|other| lies_along(one, other) || lies_along(other, one)))
        .collect()
}

fn bounds(chain: &[DVec3], margin: f64) -> (DVec3, DVec3) {
    let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = chain.iter().fold(start, |(low, high), &p| (low.min(p), high.max(p)));
    (low - margin, high + margin)
}

fn to_chord(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let along = b - a;
    let length = along.length_squared();
    let t = if length > 0.0 {
        ((p - a).dot(along) / length).clamp(0.0, 1.0)
    } else {
        0.0
    };
    p.distance(a + t * along)
}
