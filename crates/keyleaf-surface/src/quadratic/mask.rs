//! Points of a surface as weighted sums of the vertices of its control mesh. Twin of `shaders/passes/pose_points.wgsl`.

use glam::DVec3;
use keyleaf_key::{HalfEdge, Topology};

const NONE: u32 = u32::MAX;

/// The weights of a position and of two tangents.
pub type Weights = [f64; 3];

/// A point and two tangents there, relative to a vertex: that makes the weight of the vertex itself drop out, and keeps the digits of what
/// is far from zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Mask {
    /// The vertex.
    pub centre: u32,
    /// Other vertices, each once.
    pub terms: Vec<(u32, Weights)>,
}

/// What a mask says of a pose.
pub struct Masked {
    pub position: DVec3,
    /// Both zero where the mask has none.
    pub tangents: [DVec3; 2],
}

impl Mask {
    /// A vertex itself, without tangents.
    pub fn vertex(vertex: u32) -> Self {
        Self {
            centre: vertex,
            terms: Vec::new(),
        }
    }

    /// The sums of positions by vertex.
    pub fn apply(&self, positions: &[DVec3]) -> Masked {
        let own = positions[self.centre as usize];
        let mut sums = [DVec3::ZERO; 3];
        for &(vertex, weights) in &self.terms {
            let edge = positions[vertex as usize] - own;
            sums.iter_mut()
                .zip(weights)
                .for_each(|(sum, weight)| *sum += edge * weight);
        }
        let [offset, along, across] = sums;
        Masked {
            position: own + offset,
            tangents: [along, across],
        }
    }
}

/// Makes masks of terms in which vertices occur more than once.
pub struct Gatherer {
    /// By vertex: its place in the mask that is being made.
    places: Vec<u32>,
}

impl Gatherer {
    /// Of a mesh with so many vertices.
    pub fn new(vertices: usize) -> Self {
        Self {
            places: vec![NONE; vertices],
        }
    }

    /// The terms in the order in which their vertices first occur, so that neighbourhoods of the same shape have the same weights.
    pub fn gather(&mut self, centre: u32, terms: &[(u32, Weights)]) -> Mask {
        let mut gathered: Vec<(u32, Weights)> = Vec::with_capacity(terms.len());
        for &(vertex, weights) in terms.iter().filter(|(vertex, _)| *vertex != centre) {
            let place = &mut self.places[vertex as usize];
            if *place == NONE {
                *place = gathered.len() as u32;
                gathered.push((vertex, [0.0; 3]));
            }
            let sums = &mut gathered[*place as usize].1;
            sums.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += weight);
        }
        for (vertex, _) in &gathered {
            self.places[*vertex as usize] = NONE;
        }
        Mask {
            centre,
            terms: gathered,
        }
    }
}

/// The half-edges that own the edges of a mesh, in the order of half-edges.
pub fn edges(topology: &Topology) -> impl Iterator<Item = HalfEdge> + '_ {
    topology
        .roots()
        .map(|root| HalfEdge {
            face: root.face,
            root: root.root,
        })
        .filter(|half_edge| {
            let owner = topology.half_edge_owner(half_edge.face, half_edge.root);
            owner == *half_edge
        })
}

/// The half-edges of an edge: its owner, and the one on the other side.
pub fn sides(topology: &Topology, owner: HalfEdge) -> impl Iterator<Item = HalfEdge> {
    [Some(owner), topology.twin(owner.face, owner.root)]
        .into_iter()
        .flatten()
}
