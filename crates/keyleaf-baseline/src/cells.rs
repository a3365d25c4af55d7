//! The rectangles that tessellators work on, and the corners and edges that these share.

use crate::breaks::{Breaks, checked_knots};
use crate::disjoint_sets::DisjointSets;
use crate::numbering::Numbers;
use crate::sampler::{Join, joins};
use crate::{BaselineError, Sampler};
use glam::{DVec2, DVec3};
use std::collections::{HashMap, HashSet};

/// Points at which an edge is looked at to see whether it has any length.
const COLLAPSE_SAMPLES: u32 = 8;
/// Points of an edge closer together than this, relative to the coordinates of the surface, are one.
const COLLAPSED: f64 = 1e-12;
/// How often cells are split to tell edges apart (see [`Cells::spans`]).
/// Joins that make no surface could ask for more, and then the check finds crowded edges.
const MAX_SPLITS: u32 = 8;

/// A conforming mesh of rectangular cells over all surfaces: two cells share a whole edge, a corner, or nothing.
pub(crate) struct Cells {
    pub domains: Vec<Domain>,
    pub cells: Vec<Cell>,
    pub edges: Vec<Edge>,
    pub corners: Vec<Place>,
    /// Corners where two cells share both of their sides. A line between those two sides would be the same for both
    /// cells.
    pub pinched: Vec<bool>,
}

/// The rectangle of knots of a surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Domain {
    pub first: DVec2,
    pub last: DVec2,
}

impl Domain {
    /// From normalised parameters. The ends are exact.
    pub fn at(&self, t: DVec2) -> DVec2 {
        let along = |t: f64, first: f64, last: f64| if t >= 1.0 { last } else { first + (last - first) * t };
        DVec2::new(
            along(t.x, self.first.x, self.last.x),
            along(t.y, self.first.y, self.last.y),
        )
    }
}

/// A point of a surface, with normalised parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    pub surface: usize,
    pub t: DVec2,
}

/// A rectangle of a surface. Corner i + 2j is at i in u and j in v; edges are in the order of [`Side`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cell {
    pub surface: usize,
    pub low: DVec2,
    pub high: DVec2,
    pub corners: [u32; 4],
    pub edges: [EdgeUse; 4],
}

impl Cell {
    /// From fractions of the cell to normalised parameters. The ends are exact.
    pub fn at(&self, fraction: DVec2) -> DVec2 {
        let along = |f: f64, low: f64, high: f64| if f >= 1.0 { high } else { low + (high - low) * f };
        DVec2::new(
            along(fraction.x, self.low.x, self.high.x),
            along(fraction.y, self.low.y, self.high.y),
        )
    }
}

/// An edge, seen from a cell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EdgeUse {
    pub edge: u32,
    /// Whether the side of the cell runs against the edge.
    pub reversed: bool,
}

/// An edge, as the first of the cells that share it sees it. Whatever is decided from this, all of them agree upon.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge {
    pub surface: usize,
    pub from: DVec2,
    pub to: DVec2,
    pub ends: [u32; 2],
    /// All its points coincide.
    pub collapsed: bool,
    /// 0 if it runs along u, 1 if along v, and which interval of the breaks it is.
    pub interval: (usize, usize),
}

impl Cells {
    /// One cell a surface. Edges can be loops, so at least three segments an edge are needed.
    pub fn surfaces(sampler: &dyn Sampler) -> Result<Self, BaselineError> {
        let joins = joins(sampler)?;
        Self::new(sampler, &Breaks::whole(sampler.surfaces()), &joins)
    }

    /// `pieces` × `pieces` cells a KSQuad, with the knots of joined sides united.
    ///
    /// With their diagonals, cells are a simplicial complex, so that an edge can be a single segment: no edge is a
    /// loop, no two have the same corners, nor have two triangles. A closed surface with fewer than three cells around
    /// gets more.
    pub fn spans(sampler: &dyn Sampler, pieces: u32) -> Result<Self, BaselineError> {
        let joins = joins(sampler)?;
        let mut breaks = Breaks::spans(sampler, pieces)?;
        for _ in 0..MAX_SPLITS {
            breaks.agree(&joins)?;
            let cells = Self::new(sampler, &breaks, &joins)?;
            let splits = cells.ambiguous();
            if splits.is_empty() {
                return Ok(cells);
            }
            // From the last interval to the first, so that earlier numbers stay valid.
            for (surface, direction, interval, parts) in splits.into_iter().rev() {
                breaks.split(surface, direction, interval, parts);
            }
        }
        breaks.agree(&joins)?;
        Self::new(sampler, &breaks, &joins)
    }

    fn new(sampler: &dyn Sampler, breaks: &Breaks, joins: &[Join]) -> Result<Self, BaselineError> {
        let mut domains = Vec::new();
        let mut scales = Vec::new();
        for surface in 0..sampler.surfaces() {
            let [u, v] = checked_knots(sampler, surface)?;
            let domain = Domain {
                first: DVec2::new(u[0], v[0]),
                last: DVec2::new(u[u.len() - 1], v[v.len() - 1]),
            };
            domains.push(domain);
            scales.push(scale(sampler, surface, domain)?);
        }
        let numbers = Numbers::new(breaks)?;
        let mut partner: HashMap<u32, (u32, bool)> = HashMap::new();
        let mut sets = DisjointSets::new(numbers.corners as usize);
        for join in joins {
            let intervals = breaks.along[join.a.0][join.a.1.runs_along()].len() - 1;
            for i in 0..=intervals {
                let other = if join.reversed { intervals - i } else { i };
                sets.join(numbers.side_corner(join.a, i), numbers.side_corner(join.b, other));
            }
            for i in 0..intervals {
                let other = if join.reversed { intervals - 1 - i } else { i };
                let (a, b) = (numbers.side_edge(join.a, i), numbers.side_edge(join.b, other));
                partner.insert(a.max(b), (a.min(b), join.reversed));
            }
        }

        let mut uses = vec![
            EdgeUse {
                edge: 0,
                reversed: false
            };
            numbers.edges as usize
        ];
        let mut edges = Vec::new();
        for surface in 0..domains.len() {
            for (direction, i, j) in numbers.edges_of(surface) {
                let local = numbers.edge(surface, direction, i, j);
                if let Some(&(first, reversed)) = partner.get(&local) {
                    uses[local as usize] = EdgeUse {
                        edge: uses[first as usize].edge,
                        reversed,
                    };
                    continue;
                }
                uses[local as usize].edge = edges.len() as u32;
                let [u, v] = &breaks.along[surface];
                let (i1, j1) = if direction == 0 { (i + 1, j) } else { (i, j + 1) };
                let (from, to) = (DVec2::new(u[i], v[j]), DVec2::new(u[i1], v[j1]));
                let collapsed = collapsed(sampler, surface, domains[surface], from, to, scales[surface])?;
                let ends = [numbers.corner(surface, i, j), numbers.corner(surface, i1, j1)];
                if collapsed {
                    sets.join(ends[0], ends[1]);
                }
                let interval = (direction, if direction == 0 { i } else { j });
                edges.push(Edge {
                    surface,
                    from,
                    to,
                    ends,
                    collapsed,
                    interval,
                });
            }
        }

        let mut corners = Vec::new();
        let mut corner_of = vec![0; numbers.corners as usize];
        for surface in 0..domains.len() {
            for (i, j) in numbers.corners_of(surface) {
                let local = numbers.corner(surface, i, j);
                let first = sets.find(local);
                if first == local {
                    corner_of[local as usize] = corners.len() as u32;
                    let [u, v] = &breaks.along[surface];
                    corners.push(Place {
                        surface,
                        t: DVec2::new(u[i], v[j]),
                    });
                } else {
                    corner_of[local as usize] = corner_of[first as usize];
                }
            }
        }
        for edge in &mut edges {
            edge.ends = edge.ends.map(|local| corner_of[local as usize]);
        }

        let mut cells = Vec::new();
        for (surface, [u, v]) in breaks.along.iter().enumerate() {
            for j in 0..v.len() - 1 {
                for i in 0..u.len() - 1 {
                    let corner = |di: usize, dj: usize| corner_of[numbers.corner(surface, i + di, j + dj) as usize];
                    let edge = |direction: usize, di: usize, dj: usize| {
                        uses[numbers.edge(surface, direction, i + di, j + dj) as usize]
                    };
                    cells.push(Cell {
                        surface,
                        low: DVec2::new(u[i], v[j]),
                        high: DVec2::new(u[i + 1], v[j + 1]),
                        corners: [corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)],
                        edges: [edge(1, 0, 0), edge(1, 1, 0), edge(0, 0, 0), edge(0, 0, 1)],
                    });
                }
            }
        }
        let pinched = pinched(&cells, &edges, corners.len());
        Ok(Self {
            domains,
            cells,
            edges,
            corners,
            pinched,
        })
    }

    /// Whether the diagonal of a cell is that from corner 1 to corner 2, rather than from 0 to 3: away from pinched
    /// corners.
    pub fn falling_diagonal(&self, cell: &Cell) -> bool {
        [1, 2]
            .into_iter()
            .any(|corner| self.pinched[cell.corners[corner] as usize])
    }

    /// Whether the quad of a grid in a corner of a cell needs the diagonal from its corner 1 to its corner 2.
    pub fn pinched_at(&self, cell: &Cell, corner: usize, in_corner: bool) -> bool {
        in_corner && self.pinched[cell.corners[corner] as usize]
    }

    /// Intervals to split, as (surface, direction, interval, parts), since edges, diagonals or triangles there cannot
    /// be told apart by their corners. Sorted.
    fn ambiguous(&self) -> Vec<(usize, usize, usize, u32)> {
        let mut splits = Vec::new();
        let mut pairs: HashMap<[u32; 2], &Edge> = HashMap::new();
        let mut triangles: HashMap<[u32; 3], &Edge> = HashMap::new();
        let mut split = |edge: &Edge, parts| splits.push((edge.surface, edge.interval.0, edge.interval.1, parts));
        let twins = self.twins(&mut split);
        for (number, edge) in self.edges.iter().enumerate().filter(|(_, edge)| !edge.collapsed) {
            let [a, b] = edge.ends;
            if twins.contains(&number) {
                continue;
            }
            if a == b {
                split(edge, 3);
            } else if let Some(other) = pairs.insert([a.min(b), a.max(b)], edge) {
                split(other, 2);
            }
        }
        for cell in &self.cells {
            let [left, right, bottom, top] = cell.edges.map(|side| &self.edges[side.edge as usize]);
            match [left, right, bottom, top]
                .into_iter()
                .filter(|edge| edge.collapsed)
                .count()
            {
                0 => {
                    let [a, b] = if self.falling_diagonal(cell) { [1, 2] } else { [0, 3] };
                    let [a, b] = [cell.corners[a], cell.corners[b]];
                    if a == b || pairs.insert([a.min(b), a.max(b)], bottom).is_some() {
                        split(bottom, 2);
                        split(left, 2);
                    }
                }
                1 => {
                    // A triangle; its diagonal is parallel to a side.
                    let mut corners = cell.corners.to_vec();
                    corners.sort_unstable();
                    corners.dedup();
                    let inner = if bottom.collapsed || top.collapsed {
                        left
                    } else {
                        bottom
                    };
                    let &[a, b, c] = corners.as_slice() else { continue };
                    if triangles.insert([a, b, c], inner).is_some() {
                        split(inner, 2);
                    }
                }
                2 if bottom.collapsed && top.collapsed => split(left, 2),
                2 if left.collapsed && right.collapsed => split(bottom, 2),
                _ => {}
            }
        }
        splits.sort_unstable();
        splits.dedup_by_key(|split| (split.0, split.1, split.2));
        splits
    }

    /// Where two collapsed sides of a cell meet, its other two sides have the same corners however often it is split.
    /// This is no harm as long as the cell is there for other cells to meet across: without triangles, or refined. One
    /// of the two is returned.
    fn twins(&self, split: &mut impl FnMut(&Edge, u32)) -> HashSet<usize> {
        let mut uses = vec![0; self.edges.len()];
        for cell in &self.cells {
            cell.edges.iter().for_each(|side| uses[side.edge as usize] += 1);
        }
        let mut twins = HashSet::new();
        for cell in self.cells.iter().filter(|cell| self.is_bigon(cell)) {
            let numbers = cell.edges.map(|side| side.edge as usize);
            let mut open = numbers.into_iter().filter(|&number| !self.edges[number].collapsed);
            let (Some(a), Some(b)) = (open.next(), open.next()) else {
                continue;
            };
            if a == b || uses[a] + uses[b] == 2 {
                split(&self.edges[a], 2);
                split(&self.edges[b], 2);
            }
            twins.insert(b);
        }
        twins
    }

    /// Whether two sides of a cell that meet are collapsed, so that the other two and the diagonal have the same
    /// corners.
    pub fn is_bigon(&self, cell: &Cell) -> bool {
        let [left, right, bottom, top] = cell.edges.map(|side| self.edges[side.edge as usize].collapsed);
        (left != right) && (bottom != top)
    }
}

/// See [`Cells::pinched`].
fn pinched(cells: &[Cell], edges: &[Edge], corners: usize) -> Vec<bool> {
    let (mut edge_ends, mut cell_corners) = (vec![0; corners], vec![0; corners]);
    for edge in edges.iter().filter(|edge| !edge.collapsed) {
        edge.ends.into_iter().for_each(|end| edge_ends[end as usize] += 1);
    }
    for cell in cells {
        cell.corners
            .into_iter()
            .for_each(|corner| cell_corners[corner as usize] += 1);
    }
    edge_ends
        .into_iter()
        .zip(cell_corners)
        .map(|counts| counts == (2, 2))
        .collect()
}

/// A finite position, or the error that it is not.
pub(crate) fn position(sampler: &dyn Sampler, surface: usize, at: DVec2) -> Result<DVec3, BaselineError> {
    let position = sampler.point(surface, at);
    if position.is_finite() {
        Ok(position)
    } else {
        Err(BaselineError::Point { surface, at })
    }
}

/// The greatest coordinate of a surface, from a few samples.
fn scale(sampler: &dyn Sampler, surface: usize, domain: Domain) -> Result<f64, BaselineError> {
    let mut greatest = 0.0_f64;
    for k in 0..25 {
        let t = DVec2::new(f64::from(k % 5), f64::from(k / 5)) / 4.0;
        greatest = greatest.max(position(sampler, surface, domain.at(t))?.abs().max_element());
    }
    Ok(greatest)
}

fn collapsed(
    sampler: &dyn Sampler,
    surface: usize,
    domain: Domain,
    from: DVec2,
    to: DVec2,
    scale: f64,
) -> Result<bool, BaselineError> {
    let first = position(sampler, surface, domain.at(from))?;
    for k in 1..=COLLAPSE_SAMPLES {
        let t = from.lerp(to, f64::from(k) / f64::from(COLLAPSE_SAMPLES));
        if position(sampler, surface, domain.at(t))?.distance(first) > COLLAPSED * scale {
            return Ok(false);
        }
    }
    Ok(true)
}
