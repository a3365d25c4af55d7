//! Geometry shader tessellation, GST (thesis 2.3): a grid in zones, so that one primitive need not emit all of it.
//!
//! A geometry shader may emit 1024 words, so a grid of level 4 or more is partitioned: a first pass emits the zones, a
//! second evaluates the (m+1) × (m+1) points of each on its own. Points on the border of zones are evaluated more than
//! once, and [`ZoneCost`] says how often. The triangles are those of the undivided grid.
//!
//! Departure: thesis 2.3 finds the points of a zone "with simple incremental operations"; here they come from their
//! integer indices, since sums that start in different zones round differently and then neighbouring zones crack.

use crate::cells::Cells;
use crate::grid::Order;
use crate::uniform::{MAX_LEVEL, tessellate_levels};
use crate::view::within;
use crate::{BaselineError, Sampler, Tessellation};
use std::ops::Range;

/// Points a side of a zone, the m of thesis 2.3.
pub const ZONE_SIZE: u32 = 4;
/// Zones that one pass of the geometry shader can emit: 1024 words, four a zone.
pub const ZONES_PER_PASS: u32 = 256;

/// A rectangle of quads of a grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Zone {
    /// The first quad in u and v.
    pub first: [u32; 2],
    /// Quads in u and v: m, or what is left at the end.
    pub size: [u32; 2],
}

/// What a tessellation in zones takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ZoneCost {
    /// Zones of all surfaces.
    pub zones: u64,
    /// Points that are evaluated, those on borders of zones several times.
    pub evaluations: u64,
    /// Passes that emit zones: the most that one surface needs.
    pub passes: u32,
}

impl ZoneCost {
    pub(crate) fn add(&mut self, zones: &[Zone]) {
        self.zones += zones.len() as u64;
        let points = |zone: &Zone| (u64::from(zone.size[0]) + 1) * (u64::from(zone.size[1]) + 1);
        self.evaluations += zones.iter().map(points).sum::<u64>();
        self.passes = self.passes.max((zones.len() as u32).div_ceil(ZONES_PER_PASS));
    }
}

/// The zones of the grid P^l (equations 2.1 and 2.3): 2^(l+1) points a side, so 2^(l+1)/m zones.
///
/// # Errors
/// [`BaselineError::Setting`] if the level is not in 1..=[`MAX_LEVEL`] or `m` is 0.
pub fn partition(level: u32, m: u32) -> Result<Vec<Zone>, BaselineError> {
    check(m)?;
    within("level", level, 1..=MAX_LEVEL, "a level from 1 to 9")?;
    let segments = crate::uniform::segments(level);
    Ok(zones([0..segments, 0..segments], m))
}

/// The tessellation of [`uniform::at_levels`](crate::uniform::at_levels), made zone by zone, and what that takes.
///
/// # Errors
/// As there, and [`BaselineError::Setting`] if `m` is 0.
pub fn at_levels(sampler: &dyn Sampler, levels: &[u32], m: u32) -> Result<(Tessellation, ZoneCost), BaselineError> {
    check(m)?;
    let mut cost = ZoneCost::default();
    let cells = Cells::surfaces(sampler)?;
    let tessellation = tessellate_levels(sampler, &cells, levels, &mut Order::Zones { m, cost: &mut cost })?;
    Ok((tessellation, cost))
}

fn check(m: u32) -> Result<(), BaselineError> {
    within("m", m, 1..=u32::MAX, "at least one point a zone")
}

/// The zones of a range of quads.
pub(crate) fn zones([u, v]: [Range<u32>; 2], m: u32) -> Vec<Zone> {
    let cut = |range: &Range<u32>| {
        let end = range.end;
        range
            .clone()
            .step_by(m as usize)
            .map(|first| (first, m.min(end - first)))
            .collect::<Vec<_>>()
    };
    let across = cut(&u);
    let pair = |(y, height): (u32, u32)| {
        across.iter().map(move |&(x, width)| Zone {
            first: [x, y],
            size: [width, height],
        })
    };
    cut(&v).into_iter().flat_map(pair).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zones_of_level_four_are_counted_as_in_equation_2_3() {
        let zones = partition(4, ZONE_SIZE).unwrap_or_default();
        assert_eq!(zones.len(), (32 / 4) * (32 / 4));
        let quads: u32 = zones.iter().map(|zone| zone.size[0] * zone.size[1]).sum();
        assert_eq!(quads, 31 * 31);
    }
}
