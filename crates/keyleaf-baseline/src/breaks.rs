//! Where the domains of surfaces are cut, alike on both sides of every join.

use crate::sampler::Join;
use crate::{BaselineError, Sampler};

/// Normalised parameters closer than this are one.
const SAME: f64 = 1e-9;

/// The cuts of all surfaces, as normalised parameters from 0 to 1: `along[surface][0]` in u, `[1]` in v.
#[derive(Clone, Debug)]
pub(crate) struct Breaks {
    pub along: Vec<[Vec<f64>; 2]>,
}

impl Breaks {
    /// No cut: every surface is one cell.
    pub fn whole(surfaces: usize) -> Self {
        Self {
            along: vec![[vec![0.0, 1.0], vec![0.0, 1.0]]; surfaces],
        }
    }

    /// A cut at every distinct knot, and every span between two of them in `pieces` equal parts.
    pub fn spans(sampler: &dyn Sampler, pieces: u32) -> Result<Self, BaselineError> {
        let mut breaks = Self::whole(sampler.surfaces());
        for (surface, along) in breaks.along.iter_mut().enumerate() {
            for (breaks, knots) in along.iter_mut().zip(checked_knots(sampler, surface)?) {
                let (first, last) = (knots[0], knots[knots.len() - 1]);
                for knot in &knots[1..knots.len() - 1] {
                    insert(breaks, (knot - first) / (last - first));
                }
                *breaks = cut(breaks, pieces);
            }
        }
        Ok(breaks)
    }

    /// Copies cuts across joins until both sides of every join have the same.
    ///
    /// A cut runs through the whole surface, so it goes on across the opposite side. Only cuts of the input and their
    /// mirror images can appear, so this ends.
    pub fn agree(&mut self, joins: &[Join]) -> Result<(), BaselineError> {
        loop {
            let mut changed = false;
            for join in joins {
                changed |= self.copy(join.a, join.b, join.reversed);
                changed |= self.copy(join.b, join.a, join.reversed);
            }
            if !changed {
                break;
            }
        }
        for join in joins {
            let count = |(surface, side): (usize, crate::Side)| self.along[surface][side.runs_along()].len();
            if count(join.a) != count(join.b) {
                return Err(BaselineError::CloseKnots {
                    surface: join.a.0,
                    side: join.a.1,
                });
            }
        }
        Ok(())
    }

    /// Cuts one interval of a direction of a surface into equal parts.
    pub fn split(&mut self, surface: usize, direction: usize, interval: usize, parts: u32) {
        let breaks = &mut self.along[surface][direction];
        let Some(&[a, b]) = breaks.get(interval..interval + 2) else {
            return;
        };
        for part in 1..parts {
            insert(breaks, a + (b - a) * f64::from(part) / f64::from(parts));
        }
    }

    fn copy(&mut self, from: (usize, crate::Side), to: (usize, crate::Side), reversed: bool) -> bool {
        let source = self.along[from.0][from.1.runs_along()].clone();
        let target = &mut self.along[to.0][to.1.runs_along()];
        let mut changed = false;
        for t in source {
            changed |= insert(target, if reversed { 1.0 - t } else { t });
        }
        changed
    }
}

/// The distinct knots of a surface, if they span a domain.
pub(crate) fn checked_knots(sampler: &dyn Sampler, surface: usize) -> Result<[Vec<f64>; 2], BaselineError> {
    let knots = sampler.spans(surface);
    for (direction, knots) in knots.iter().enumerate() {
        let extent = knots
            .last()
            .zip(knots.first())
            .map_or(f64::NAN, |(last, first)| last - first);
        let increasing = knots.len() >= 2 && knots.windows(2).all(|pair| pair[0] < pair[1]);
        if !increasing || !extent.is_finite() || !knots.iter().all(|knot| knot.is_finite()) {
            return Err(BaselineError::Knots { surface, direction });
        }
    }
    Ok(knots)
}

/// Inserts a normalised parameter unless it is there already.
fn insert(breaks: &mut Vec<f64>, t: f64) -> bool {
    let at = breaks.partition_point(|&other| other < t);
    let near = |i: usize| breaks.get(i).is_some_and(|&other| (other - t).abs() <= SAME);
    if near(at) || (at > 0 && near(at - 1)) {
        return false;
    }
    breaks.insert(at, t);
    true
}

fn cut(breaks: &[f64], pieces: u32) -> Vec<f64> {
    let mut all = vec![0.0];
    for pair in breaks.windows(2) {
        for piece in 1..pieces {
            all.push(pair[0] + (pair[1] - pair[0]) * f64::from(piece) / f64::from(pieces));
        }
        all.push(pair[1]);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Side;

    #[test]
    fn knots_cross_joins_and_strips_of_surfaces() {
        // Three surfaces in a row along v, the last in reverse: the knot of the first appears in all.
        let mut breaks = Breaks::whole(3);
        breaks.along[0][0] = vec![0.0, 0.25, 1.0];
        let join = |a, b, reversed| Join {
            a: (a, Side::VMax),
            b: (b, Side::VMin),
            reversed,
        };
        let agreed = breaks.agree(&[join(0, 1, false), join(1, 2, true)]);
        assert_eq!(agreed, Ok(()));
        assert_eq!(breaks.along[1][0], [0.0, 0.25, 1.0]);
        assert_eq!(breaks.along[2][0], [0.0, 0.75, 1.0]);
        assert_eq!(breaks.along[2][1], [0.0, 1.0]);
    }
}
