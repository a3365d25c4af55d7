//! A regular grid over a cell, stitched to sides that have other numbers of segments.

use crate::cells::Cell;
use crate::mesher::{Mesher, Node};
use crate::strip::{triangles, zip};
use crate::zones::{Zone, ZoneCost, zones};
use crate::{BaselineError, Side};
use glam::DVec2;
use std::ops::Range;

/// In which order the quads of a grid are made.
pub(crate) enum Order<'a> {
    Rows,
    /// Zone by zone (thesis 2.3), counting what that costs.
    Zones {
        m: u32,
        cost: &'a mut ZoneCost,
    },
}

/// Numbers of segments: inside in u and v, and along the four sides in the order of [`Side`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Segments {
    pub inside: [u32; 2],
    pub sides: [u32; 4],
}

/// Tessellates a cell.
///
/// Sides that have as many segments as the inside need nothing. Otherwise the outermost ring of quads is replaced by
/// four strips between the side and the first row inside, and there are at least two segments each way, so that there
/// is such a row.
pub(crate) fn grid(
    mesher: &mut Mesher<'_>,
    cell: &Cell,
    segments: Segments,
    order: &mut Order<'_>,
) -> Result<(), BaselineError> {
    let [u, v] = segments.inside;
    let regular = segments.sides == [v, v, u, u];
    let inside = if regular { [u, v] } else { [u.max(2), v.max(2)] };
    let mut grid = Grid::new(inside);
    if regular {
        grid.quads(mesher, cell, [0..u, 0..v], order)
    } else {
        let quads = inside.map(|count| 1..count - 1);
        for side in Side::ALL {
            grid.stitch(mesher, cell, side, segments.sides[side as usize])?;
        }
        grid.quads(mesher, cell, quads, order)
    }
}

struct Grid {
    count: [u32; 2],
    nodes: Vec<Option<Node>>,
}

impl Grid {
    fn new(count: [u32; 2]) -> Self {
        Self {
            count,
            nodes: vec![None; (count[0] as usize + 1) * (count[1] as usize + 1)],
        }
    }

    /// Grid point (i, j).
    fn node(&mut self, mesher: &mut Mesher<'_>, cell: &Cell, i: u32, j: u32) -> Result<Node, BaselineError> {
        let [u, v] = self.count;
        let index = j as usize * (u as usize + 1) + i as usize;
        if let Some(node) = self.nodes[index] {
            return Ok(node);
        }
        let node = if j == 0 || j == v {
            mesher.on_side(cell, if j == 0 { Side::VMin } else { Side::VMax }, i, u)?
        } else if i == 0 || i == u {
            mesher.on_side(cell, if i == 0 { Side::UMin } else { Side::UMax }, j, v)?
        } else {
            mesher.inside(
                cell,
                DVec2::new(f64::from(i) / f64::from(u), f64::from(j) / f64::from(v)),
            )?
        };
        self.nodes[index] = Some(node);
        Ok(node)
    }

    fn quads(
        &mut self,
        mesher: &mut Mesher<'_>,
        cell: &Cell,
        quads: [Range<u32>; 2],
        order: &mut Order<'_>,
    ) -> Result<(), BaselineError> {
        let [u, v] = quads;
        match order {
            Order::Rows => self.zone(
                mesher,
                cell,
                &Zone {
                    first: [u.start, v.start],
                    size: [u.end - u.start, v.end - v.start],
                },
            ),
            Order::Zones { m, cost } => {
                let zones = zones([u, v], *m);
                cost.add(&zones);
                zones.iter().try_for_each(|zone| self.zone(mesher, cell, zone))
            }
        }
    }

    fn zone(&mut self, mesher: &mut Mesher<'_>, cell: &Cell, zone: &Zone) -> Result<(), BaselineError> {
        for j in zone.first[1]..zone.first[1] + zone.size[1] {
            for i in zone.first[0]..zone.first[0] + zone.size[0] {
                let a = self.node(mesher, cell, i, j)?;
                let b = self.node(mesher, cell, i + 1, j)?;
                let c = self.node(mesher, cell, i + 1, j + 1)?;
                let d = self.node(mesher, cell, i, j + 1)?;
                let falling = mesher.cells.pinched_at(cell, 1, i + 1 == self.count[0] && j == 0)
                    || mesher.cells.pinched_at(cell, 2, i == 0 && j + 1 == self.count[1]);
                let halves = if falling {
                    [[a, b, d], [b, c, d]]
                } else {
                    [[a, b, c], [a, c, d]]
                };
                halves.into_iter().for_each(|half| mesher.triangle(cell, half));
            }
        }
        Ok(())
    }

    /// The strip between a side and the first row inside. Both run counter-clockwise around the cell.
    fn stitch(&mut self, mesher: &mut Mesher<'_>, cell: &Cell, side: Side, segments: u32) -> Result<(), BaselineError> {
        let backward = matches!(side, Side::VMax | Side::UMin);
        let [u, v] = self.count;
        let length = self.count[side.runs_along()];
        let along = |k: u32, count: u32| f64::from(k) / f64::from(count);
        let mut outer = Vec::new();
        for k in 0..=segments {
            let from = if backward { segments - k } else { k };
            outer.push((along(k, segments), mesher.on_side(cell, side, from, segments)?));
        }
        let mut inner = Vec::new();
        for k in 1..length {
            let from = if backward { length - k } else { k };
            let (i, j) = match side {
                Side::UMin => (1, from),
                Side::UMax => (u - 1, from),
                Side::VMin => (from, 1),
                Side::VMax => (from, v - 1),
            };
            inner.push((along(k, length), self.node(mesher, cell, i, j)?));
        }
        let split = |row: Vec<(f64, Node)>| row.into_iter().unzip::<f64, Node, Vec<_>, Vec<_>>();
        let ((inner_x, inner), (outer_x, outer)) = (split(inner), split(outer));
        for triangle in triangles(&inner, &outer, &zip(&inner_x, &outer_x)) {
            mesher.triangle(cell, triangle);
        }
        Ok(())
    }
}
