//! The triangles about a vertex, in order.

use crate::direction::cross_direction;
use crate::mesh::unit_or_up;
use glam::DVec3;
use keyleaf_key::{HalfEdge, Topology};

/// The triangles about a vertex that are connected through edges, counter-clockwise seen from outside. A vertex where triangles
/// touch in a point only has several fans.
#[derive(Clone, Debug)]
pub struct Fan {
    /// The half-edges that start at the vertex, one a triangle. The first of an open fan lies on the boundary.
    pub spokes: Vec<HalfEdge>,
    /// Whether the last triangle meets the first.
    pub closed: bool,
}

impl Fan {
    /// The fan of which `corner` is a spoke.
    pub fn about(topology: &Topology, corner: HalfEdge) -> Self {
        let clockwise = |spoke: HalfEdge| topology.twin(spoke.face, spoke.root).map(next);
        let counter_clockwise = |spoke: HalfEdge| topology.twin(spoke.face, (spoke.root + 2) % 3);
        let (mut first, mut closed) = (corner, false);
        while let Some(before) = clockwise(first) {
            closed = before == corner;
            if closed {
                break;
            }
            first = before;
        }
        let first = if closed { corner } else { first };
        let mut spokes = vec![first];
        let mut last = first;
        while let Some(after) = counter_clockwise(last).filter(|&after| after != first) {
            spokes.push(after);
            last = after;
        }
        Self { spokes, closed }
    }

    /// Every fan of a mesh once.
    pub fn all(topology: &Topology) -> Vec<Self> {
        let mut seen = vec![false; topology.half_edge_count() as usize];
        let mut fans = Vec::new();
        for root in topology.roots() {
            if seen[topology.half_edge_index(root.face, root.root) as usize] {
                continue;
            }
            let corner = HalfEdge {
                face: root.face,
                root: root.root,
            };
            let fan = Self::about(topology, corner);
            fan.spokes
                .iter()
                .for_each(|spoke| seen[topology.half_edge_index(spoke.face, spoke.root) as usize] = true);
            fans.push(fan);
        }
        fans
    }

    /// The vertex.
    pub fn vertex(&self, topology: &Topology) -> u32 {
        let first = self.spokes[0];
        topology.vertex(first.face, first.root)
    }

    /// The vertices at the other ends of the edges: one more than triangles if the fan is open.
    pub fn ring(&self, topology: &Topology) -> Vec<u32> {
        let end = |spoke: &HalfEdge, step: u32| topology.vertex(spoke.face, (spoke.root + step) % 3);
        let last = self.spokes.last().filter(|_| !self.closed).map(|spoke| end(spoke, 2));
        self.spokes.iter().map(|spoke| end(spoke, 1)).chain(last).collect()
    }

    /// The mean of the unit normals of the triangles, weighted by their angles at the vertex.
    pub fn mean_normal(&self, topology: &Topology, positions: &[DVec3]) -> DVec3 {
        let at = |face, corner: u32| positions[topology.vertex(face, corner % 3) as usize];
        angle_weighted(self.spokes.iter().map(|spoke| {
            let tip = at(spoke.face, spoke.root);
            [1, 2].map(|step| at(spoke.face, spoke.root + step) - tip)
        }))
    }
}

/// The half-edge that follows in its triangle.
fn next(half_edge: HalfEdge) -> HalfEdge {
    HalfEdge {
        root: (half_edge.root + 1) % 3,
        ..half_edge
    }
}

/// The mean of the unit normals of triangles.
pub fn mean_of_faces(topology: &Topology, positions: &[DVec3], faces: impl Iterator<Item = u32>) -> DVec3 {
    let normals = faces.filter_map(|face| {
        let [p, q, r] = [0, 1, 2].map(|corner| positions[topology.vertex(face, corner) as usize]);
        cross_direction(q - p, r - p)
    });
    unit_or_up(normals.sum())
}

/// The direction of the sum of a × b / |a × b|, weighted by the angles between a and b. Of unit length always.
pub fn angle_weighted(sectors: impl Iterator<Item = [DVec3; 2]>) -> DVec3 {
    let sum = sectors
        .filter_map(|[a, b]| cross_direction(a, b).map(|normal| normal * a.angle_between(b)))
        .sum();
    unit_or_up(sum)
}
