//! One address for every corner and every edge of a joined model, poles included.

use super::basis::{BasisMethod, values};
use super::classes::Classes;
use super::evaluation::KsQuad;
use super::layout::Side;
use super::span::Fraction;
use keyleaf_key::{HalfEdge, ONE, RootPoint, Topology};

/// The addresses that the sides of an edge, or all faces about a vertex or a pole, agree on.
#[derive(Clone, Debug)]
pub struct Addresses {
    /// By half-edge: the first half-edge that starts at the same point.
    pub corners: Vec<HalfEdge>,
    /// By half-edge: whether the edge is a point.
    pub collapsed: Vec<bool>,
}

impl Addresses {
    pub fn new<'a>(topology: &Topology, quad_of: impl Fn(u32) -> KsQuad<'a>) -> Self {
        let collapsed: Vec<bool> = topology
            .roots()
            .map(|root| {
                let owner = topology.half_edge_owner(root.face, root.root);
                is_collapsed(&quad_of(owner.face), Side::ALL[owner.root as usize])
            })
            .collect();
        let mut classes = Classes::new(topology.vertex_count());
        for (root, _) in topology.roots().zip(&collapsed).filter(|(_, is)| **is) {
            let ends = [root.root, (root.root + 1) % 4].map(|corner| topology.vertex(root.face, corner) as usize);
            classes.unite(ends[0], ends[1]);
        }
        // Vertices are numbered by their first corner, so that the first vertex of a pole has its first corner.
        let corner = |root: keyleaf_key::Place| {
            let vertex = classes.first(topology.vertex(root.face, root.root) as usize);
            let own = HalfEdge {
                face: root.face,
                root: root.root,
            };
            topology.vertex_owner(vertex as u32).unwrap_or(own)
        };
        Self {
            corners: topology.roots().map(corner).collect(),
            collapsed,
        }
    }

    /// The address of a point whose operands all its faces use.
    pub fn canonical(&self, topology: &Topology, at: RootPoint) -> RootPoint {
        let corner_of = |root: u32| {
            let corner = self.corners[topology.half_edge_index(at.face, root) as usize];
            RootPoint {
                face: corner.face,
                root: corner.root,
                x: ONE,
                y: 0,
            }
        };
        if !at.is_on_mesh_edge() {
            return at;
        }
        if at.y == ONE {
            return corner_of((at.root + 1) % 4);
        }
        let own = topology.half_edge_index(at.face, at.root) as usize;
        if at.x == ONE || self.collapsed[own] {
            return corner_of(at.root);
        }
        let owner = topology.half_edge_owner(at.face, at.root);
        let is_own = (owner.face, owner.root) == (at.face, at.root);
        let [x, y] = if is_own { [at.x, at.y] } else { [at.y, at.x] };
        RootPoint {
            face: owner.face,
            root: owner.root,
            x,
            y,
        }
    }
}

/// Whether all control points that an edge of a KSQuad depends on are one.
fn is_collapsed(quad: &KsQuad<'_>, side: Side) -> bool {
    let across = 1 - side.along();
    let span = quad.spans[across];
    let at = if side.is_at_end() {
        Fraction::END
    } else {
        Fraction::START
    };
    let weights = values(BasisMethod::Triangular, span.degree, span, at);
    let mut points = quad
        .control_indices()
        .filter(|&(i, j, _)| weights[[i, j][across]] != 0.0)
        .map(|(_, _, index)| quad.surface.control(index))
        .filter(|(_, weight)| *weight > 0.0)
        .map(|(point, _)| point);
    let first = points.next();
    points.all(|point| Some(point) == first)
}
