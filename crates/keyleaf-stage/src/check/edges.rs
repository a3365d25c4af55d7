//! The edges of the drawn triangles, matched by identity and by the bits of their ends.
//!
//! Inside a leaf the base grid is closed by itself, so that only the edges along the boundary of each drawn leaf are matched.

use super::leaves::Leaves;
use super::weld::QuickMap;
use super::{FindingKind, Findings, Sight, Welder, grid_point};
use keyleaf::inspect::Emitted;
use keyleaf::key::{Key, Place, RootPoint, Topology};
use keyleaf::read_back::Snapshot;
use keyleaf::{BackFaces, BaseGrid, Settings};
use rayon::slice::ParallelSliceMut;

/// Slots whose vertices are asked for at once.
const PIECE: usize = 1 << 15;
/// How far the length of a normal may be from 1.
const UNIT_TOLERANCE: f32 = 1e-3;

/// A directed edge along the boundary of a drawn leaf.
#[derive(Clone, Copy)]
struct Edge {
    /// Numbers of its ends, the larger one in the high half.
    ends: u64,
    slot: u32,
    /// Of the boundary, from vertex (0, 0) along the X leg, the hypotenuse and the Y leg.
    segment: u16,
    /// Whether it runs from the smaller number to the larger.
    is_forward: bool,
    /// Whether it lies on a boundary of the mesh.
    is_boundary: bool,
}

/// A drawn leaf while its vertices are looked at.
struct Drawn<'a> {
    slot: u32,
    place: Place,
    is_pair: bool,
    positions: &'a [[f32; 3]],
    normals: &'a [[f32; 3]],
}

struct Matcher<'a> {
    topology: &'a Topology,
    snapshot: &'a Snapshot,
    leaves: &'a Leaves,
    k: u32,
    /// Vertices along the boundary of the grid, in order, with their indices in the grid.
    rim: Vec<([u32; 2], usize)>,
    welder: Welder,
    /// Bits of the first position seen of each welded point, and the slot that it came from.
    seen: Vec<([u32; 3], u32)>,
    edges: Vec<Edge>,
}

/// Checks the vertices and edges of all drawn leaves.
#[expect(clippy::too_many_arguments, reason = "a private step of one public call")]
pub(super) fn check<E>(
    topology: &Topology,
    snapshot: &Snapshot,
    leaves: &Leaves,
    grid: &BaseGrid,
    settings: &Settings,
    sight: Option<&Sight>,
    mut emit: impl FnMut(&[u32]) -> Result<Emitted, E>,
    findings: &mut Findings,
) -> Result<(), E> {
    let rim = rim(grid, settings.base_grid);
    let points = leaves.drawn.len() * rim.len();
    let mut matcher = Matcher {
        topology,
        snapshot,
        leaves,
        k: settings.base_grid,
        rim,
        welder: Welder::with_capacity(points * 5 / 8),
        seen: Vec::with_capacity(points * 5 / 8),
        edges: Vec::with_capacity(points),
    };
    for slots in leaves.drawn.chunks(PIECE) {
        let emitted = emit(slots)?;
        let count = grid.vertices.len();
        for ((&slot, positions), normals) in slots
            .iter()
            .zip(emitted.positions.chunks(count))
            .zip(emitted.normals.chunks(count))
        {
            let Some(place) = leaves.places[slot as usize] else {
                continue;
            };
            let drawn = Drawn {
                slot,
                place,
                is_pair: leaves.pairs[slot as usize],
                positions,
                normals,
            };
            check_vertices(&drawn, snapshot, findings);
            if let Some(sight) = sight.filter(|_| !leaves.visible[slot as usize])
                && let Some(detail) = wrongly_culled(&drawn, grid, settings.drawn_faces(), sight)
            {
                findings.add(FindingKind::Culled, [snapshot.leaves[slot as usize].key], || detail);
            }
            matcher.add(&drawn, findings);
        }
    }
    matcher.match_edges(findings);
    Ok(())
}

/// The vertices along the boundary of the base grid, counter-clockwise from (0, 0).
fn rim(grid: &BaseGrid, k: u32) -> Vec<([u32; 2], usize)> {
    let n = 1 << k;
    let corners = (0..n)
        .map(|i| [i, 0])
        .chain((0..n).map(|i| [n - i, i]))
        .chain((0..n).map(|i| [0, n - i]));
    let index = |[i, j]: [u32; 2]| grid.vertices.iter().position(|v| *v == i | j << 16);
    corners.filter_map(|at| Some((at, index(at)?))).collect()
}

/// Whether all vertices of a leaf are finite.
fn check_vertices(drawn: &Drawn<'_>, snapshot: &Snapshot, findings: &mut Findings) {
    let key = [snapshot.leaves[drawn.slot as usize].key];
    let finite = |v: &[f32; 3]| v.iter().all(|c| c.is_finite());
    let unit = |n: &[f32; 3]| (n.iter().map(|c| c * c).sum::<f32>().sqrt() - 1.0).abs() <= UNIT_TOLERANCE;
    if let Some(i) = drawn.positions.iter().position(|p| !finite(p)) {
        findings.add(FindingKind::NonFinite, key, || {
            format!("vertex {i} is at {:?}", drawn.positions[i])
        });
    }
    if let Some(i) = drawn.normals.iter().position(|n| !unit(n)) {
        findings.add(FindingKind::NonFinite, key, || {
            format!("the normal of vertex {i} is {:?}", drawn.normals[i])
        });
    }
}

/// What of a leaf that is not drawn should be seen: a vertex, or a vertex of a triangle that faces the eye where others are left out.
/// Approximate ways to leave out faces may lose any.
fn wrongly_culled(drawn: &Drawn<'_>, grid: &BaseGrid, back_faces: BackFaces, sight: &Sight) -> Option<String> {
    let in_view = |i: usize| sight.surely_sees(drawn.positions[i]);
    let seen = match back_faces {
        BackFaces::Drawn | BackFaces::Hidden => (0..drawn.positions.len()).find(|&i| in_view(i)),
        BackFaces::Leaves | BackFaces::Conservative => {
            let triangles = grid
                .indices
                .as_chunks::<3>()
                .0
                .iter()
                .map(|corners| corners.map(usize::from));
            let mut facing = triangles.filter(|corners| sight.surely_faces(corners.map(|i| drawn.positions[i])));
            facing.find_map(|corners| corners.into_iter().find(|&i| in_view(i)))
        }
        BackFaces::Light | BackFaces::Strong => None,
    };
    seen.map(|i| {
        format!(
            "vertex {i} is in view, {} from the eye",
            sight.from_eye(drawn.positions[i])
        )
    })
}

impl Matcher<'_> {
    fn point(&self, place: Place, is_pair: bool, segment: usize) -> RootPoint {
        grid_point(place, is_pair, self.rim[segment % self.rim.len()].0, self.k)
    }

    /// Enters the boundary of a drawn leaf, and compares the bits of its vertices with those of its neighbours.
    fn add(&mut self, drawn: &Drawn<'_>, findings: &mut Findings) {
        let count = self.rim.len();
        let (mut first, mut before) = (None, None);
        for segment in 0..=count {
            let point = self.point(drawn.place, drawn.is_pair, segment);
            let number = match first.filter(|_| segment == count) {
                Some(number) => number,
                None => self.number(drawn, segment, point, findings),
            };
            first = first.or(Some(number));
            if let Some((from, from_point)) = before.replace((number, point)) {
                self.enter(drawn.slot, segment - 1, [from, number], [from_point, point]);
            }
        }
    }

    fn number(&mut self, drawn: &Drawn<'_>, segment: usize, point: RootPoint, findings: &mut Findings) -> u32 {
        let (number, is_new) = self.welder.index(self.topology, point);
        let position = drawn.positions[self.rim[segment].1];
        let bits = position.map(f32::to_bits);
        if is_new {
            self.seen.push((bits, drawn.slot));
        } else if let (before, slot) = self.seen[number as usize]
            && before != bits
        {
            let keys = [slot, drawn.slot].map(|slot| self.key(slot));
            findings.add(FindingKind::Crack, keys, || {
                let other = before.map(f32::from_bits);
                format!("the same point {point:?} is at {other:?} ({before:08x?}) and at {position:?} ({bits:08x?})")
            });
        }
        number
    }

    fn enter(&mut self, slot: u32, segment: usize, [from, to]: [u32; 2], points: [RootPoint; 2]) {
        self.edges.push(Edge {
            ends: u64::from(from.max(to)) << 32 | u64::from(from.min(to)),
            slot,
            segment: segment as u16,
            is_forward: from < to,
            is_boundary: points[0].runs_along_boundary(points[1], self.topology),
        });
    }

    fn key(&self, slot: u32) -> Key {
        self.snapshot.leaves[slot as usize].key
    }

    /// Every edge must be there once in each direction, on a boundary of the mesh once.
    fn match_edges(&mut self, findings: &mut Findings) {
        self.edges.par_sort_unstable_by_key(|edge| edge.ends);
        let is_matched = |same: &[Edge]| match same {
            [edge] => edge.is_boundary,
            [a, b] => a.is_forward != b.is_forward && !a.is_boundary && !b.is_boundary,
            _ => false,
        };
        let unmatched: Vec<&[Edge]> = self
            .edges
            .chunk_by(|a, b| a.ends == b.ends)
            .filter(|same| !is_matched(same))
            .collect();
        let mut halves = QuickMap::default();
        let junctions: Vec<bool> = unmatched
            .iter()
            .map(|same| self.halve(self.ends(&same[0]), &mut halves))
            .collect();
        for (same, is_junction) in unmatched.iter().zip(junctions) {
            let edge = &same[0];
            if !is_junction && halves.contains_key(&edge.ends) {
                continue; // told with the edge that it is a part of
            }
            let keys = same.iter().map(|edge| self.key(edge.slot));
            let forward = same.iter().filter(|edge| edge.is_forward).count();
            let ends = self.ends(edge);
            let place = if edge.is_boundary {
                ", on a boundary of the mesh"
            } else {
                ""
            };
            let (kind, text) = match (is_junction, same.len()) {
                (true, _) => (FindingKind::TJunction, "has a vertex in its middle on the other side"),
                (false, 1) => (FindingKind::Crack, "has no other side"),
                (false, _) => (FindingKind::Overlap, "is drawn too often"),
            };
            findings.add(kind, keys, || {
                let backward = same.len() - forward;
                format!("the edge {ends:?}{place} {text} ({forward} forward, {backward} backward)")
            });
        }
    }

    fn ends(&self, edge: &Edge) -> [RootPoint; 2] {
        let slot = edge.slot as usize;
        let place = self.leaves.places[slot].unwrap_or(Place::of_root(0, 0)); // only leaves with a place have edges
        let is_pair = self.leaves.pairs[slot];
        [0, 1].map(|i| self.point(place, is_pair, usize::from(edge.segment) + i))
    }

    /// Whether the middle of an edge is a drawn vertex; notes the parts that the edge then consists of.
    fn halve(&self, [from, to]: [RootPoint; 2], halves: &mut QuickMap<u64, ()>) -> bool {
        let Some(middle) = from.middle(to).filter(|_| from != to) else {
            return false;
        };
        let number = |point| self.welder.find(self.topology, point);
        let (Some(a), Some(m), Some(b)) = (number(from), number(middle), number(to)) else {
            return false;
        };
        for ([x, y], part) in [([a, m], [from, middle]), ([m, b], [middle, to])] {
            halves.insert(u64::from(x.max(y)) << 32 | u64::from(x.min(y)), ());
            self.halve(part, halves);
        }
        true
    }
}
