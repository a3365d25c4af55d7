//! The Loop limit surface at vertices and edge middles, by masks.
//!
//! Limit and tangent masks of a vertex with n edges (Loop 1987; Zorin & Schröder 2000): p = (1 − nχ) v + χ Σ e with
//! χ = 1 / (n + 3 / (8β)), tangents Σ cos(2πi/n) e_i and Σ sin(2πi/n) e_i. On a boundary p = (e_0 + 4 v + e_(k−1)) / 6, the tangent
//! along it e_0 − e_(k−1), and across it the exact left eigenvector for the eigenvalue 3/8 + cos(π / (k − 1)) / 4. With k ≥ 7 edges
//! another eigenvalue is at least 1/2, so that there is no tangent plane.

use super::error::TrianglePatchError;
use super::fan::{Fan, mean_of_faces};
use super::mask::{Gatherer, Mask, Masked, Weights, edges, sides};
use super::samples::{LimitSample, LimitSamples};
use crate::direction::cross_direction;
use crate::{BoundaryRule, ControlMesh};
use glam::DVec3;
use keyleaf_key::{HalfEdge, Topology};
use std::f64::consts::{PI, TAU};

/// From this number of edges on, a boundary vertex has no tangent plane.
const EDGES_WITHOUT_TANGENTS: usize = 7;

/// The weights of vertices with other than 6 edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LoopWeights {
    /// Loop's own (1987).
    #[default]
    Loop,
    /// Warren's (1995): the same for 3 and for 6 edges, simpler otherwise.
    Warren,
}

impl LoopWeights {
    /// The weight of each of the n neighbours of a vertex in its next position.
    pub fn beta(self, n: usize) -> f64 {
        let n = n as f64;
        match self {
            Self::Loop => (0.625 - (0.375 + (TAU / n).cos() / 4.0).powi(2)) / n,
            Self::Warren if n == 3.0 => 3.0 / 16.0,
            Self::Warren => 3.0 / (8.0 * n),
        }
    }

    /// The weight of each of the n neighbours of a vertex in its limit position.
    pub fn chi(self, n: usize) -> f64 {
        1.0 / (n as f64 + 3.0 / (8.0 * self.beta(n)))
    }
}

/// An error unless the masks are those of the mesh.
pub fn check(control: &ControlMesh) -> Result<(), TrianglePatchError> {
    let is_sharp = control.creases.iter().any(|crease| crease.sharpness > 0.0)
        || control.corners.iter().any(|corner| corner.sharpness > 0.0);
    if is_sharp {
        return Err(TrianglePatchError::Sharp);
    }
    if control.boundary == BoundaryRule::None {
        return Err(TrianglePatchError::NoBoundary);
    }
    Ok(())
}

/// The rules of a mesh without sharpness.
#[derive(Clone, Copy, Debug)]
pub struct Rules {
    pub boundary: BoundaryRule,
    pub weights: LoopWeights,
}

/// The samples of a mesh of triangles.
pub fn samples(topology: &Topology, positions: &[DVec3], rules: Rules) -> LimitSamples {
    let fans = Fan::all(topology);
    let mut masks = LoopMasks::new(topology, &fans, rules);
    let none = LimitSample {
        position: DVec3::ZERO,
        normal: DVec3::Y,
    };
    let mut samples = LimitSamples {
        corners: vec![none; topology.half_edge_count() as usize],
        edges: vec![none; topology.half_edge_count() as usize],
    };
    for fan in &fans {
        let masked = masks.vertex(fan.vertex(topology)).apply(positions);
        let sample = sample(masked, || fan.mean_normal(topology, positions));
        for spoke in &fan.spokes {
            samples.corners[topology.half_edge_index(spoke.face, spoke.root) as usize] = sample;
        }
    }
    for owner in edges(topology) {
        let masked = masks.edge(owner).apply(positions);
        let faces = sides(topology, owner).map(|side| side.face);
        let sample = sample(masked, || mean_of_faces(topology, positions, faces));
        for side in sides(topology, owner) {
            samples.edges[topology.half_edge_index(side.face, side.root) as usize] = sample;
        }
    }
    samples
}

fn sample(masked: Masked, fallback: impl FnOnce() -> DVec3) -> LimitSample {
    let [along, across] = masked.tangents;
    LimitSample {
        position: masked.position,
        normal: cross_direction(along, across).unwrap_or_else(fallback),
    }
}

/// A vertex that moves when the mesh is subdivided.
#[derive(Clone, Debug)]
enum Vertex {
    Interior(Vec<u32>),
    Boundary(Vec<u32>),
    /// It stays: a corner, and where triangles touch in a point only.
    Sharp,
}

/// The masks of a mesh.
pub struct LoopMasks<'a> {
    topology: &'a Topology,
    weights: LoopWeights,
    vertices: Vec<Vertex>,
    gatherer: Gatherer,
}

impl<'a> LoopMasks<'a> {
    pub fn new(topology: &'a Topology, fans: &[Fan], rules: Rules) -> Self {
        let mut fans_of = vec![0; topology.vertex_count()];
        fans.iter().for_each(|fan| fans_of[fan.vertex(topology) as usize] += 1);
        let mut vertices = vec![Vertex::Sharp; topology.vertex_count()];
        for fan in fans {
            let vertex = fan.vertex(topology) as usize;
            let is_corner = fan.spokes.len() == 1 && rules.boundary == BoundaryRule::EdgesAndCorners;
            vertices[vertex] = match fan.closed {
                _ if fans_of[vertex] > 1 => Vertex::Sharp,
                true => Vertex::Interior(fan.ring(topology)),
                false if is_corner => Vertex::Sharp,
                false => Vertex::Boundary(fan.ring(topology)),
            };
        }
        Self {
            topology,
            weights: rules.weights,
            vertices,
            gatherer: Gatherer::new(topology.vertex_count()),
        }
    }

    /// A vertex on the limit surface.
    pub fn vertex(&self, vertex: u32) -> Mask {
        let (ring, weights) = match &self.vertices[vertex as usize] {
            Vertex::Interior(ring) => (ring, interior(ring.len(), self.weights.chi(ring.len()))),
            Vertex::Boundary(ring) => (ring, on_boundary(ring.len())),
            Vertex::Sharp => return Mask::vertex(vertex),
        };
        Mask {
            centre: vertex,
            terms: ring.iter().copied().zip(weights).collect(),
        }
    }

    /// The middle of an edge on the limit surface, as its owner sees it: relative to the start of that. After one step of subdivision it
    /// has 6 edges, or 4 on a boundary.
    pub fn edge(&mut self, HalfEdge { face, root }: HalfEdge) -> Mask {
        let twin = self.topology.twin(face, root);
        let ring = if twin.is_some() {
            interior(6, 1.0 / 12.0)
        } else {
            on_boundary(4)
        };
        let others: Weights = std::array::from_fn(|k| ring.iter().map(|weights| weights[k]).sum());
        let mut terms = Vec::new();
        self.add_middle(&mut terms, face, root, [1.0 - others[0], -others[1], -others[2]]);
        self.add_middle(&mut terms, face, root + 1, ring[1]);
        self.add_middle(&mut terms, face, root + 2, ring[2]);
        if let Some(twin) = twin {
            self.add_middle(&mut terms, twin.face, twin.root + 1, ring[4]);
            self.add_middle(&mut terms, twin.face, twin.root + 2, ring[5]);
        }
        // What differs most between neighbourhoods comes last.
        self.add_vertex(&mut terms, self.at(face, root + 1), ring[0]);
        self.add_vertex(&mut terms, self.at(face, root), ring[3]);
        self.gatherer.gather(self.topology.vertex(face, root), &terms)
    }

    fn at(&self, face: u32, corner: u32) -> u32 {
        self.topology.vertex(face, corner % 3)
    }

    /// The middle of a half-edge after one step.
    fn add_middle(&self, terms: &mut Vec<(u32, Weights)>, face: u32, root: u32, weights: Weights) {
        let HalfEdge { face, root } = self.topology.half_edge_owner(face, root % 3);
        let ends = [0, 1].map(|step| self.at(face, root + step));
        match self.topology.twin(face, root) {
            Some(twin) => {
                let opposite = [self.at(face, root + 2), self.at(twin.face, twin.root + 2)];
                terms.extend(ends.map(|end| (end, times(weights, 0.375))));
                terms.extend(opposite.map(|opposite| (opposite, times(weights, 0.125))));
            }
            None => terms.extend(ends.map(|end| (end, times(weights, 0.5)))),
        }
    }

    /// A vertex after one step.
    fn add_vertex(&self, terms: &mut Vec<(u32, Weights)>, vertex: u32, weights: Weights) {
        match &self.vertices[vertex as usize] {
            Vertex::Interior(ring) => {
                let beta = self.weights.beta(ring.len());
                terms.push((vertex, times(weights, 1.0 - ring.len() as f64 * beta)));
                terms.extend(ring.iter().map(|&end| (end, times(weights, beta))));
            }
            Vertex::Boundary(ring) => {
                terms.push((vertex, times(weights, 0.75)));
                terms.extend([0, ring.len() - 1].map(|end| (ring[end], times(weights, 0.125))));
            }
            Vertex::Sharp => terms.push((vertex, weights)),
        }
    }
}

fn times(weights: Weights, factor: f64) -> Weights {
    weights.map(|weight| weight * factor)
}

/// The weights of the neighbours of a vertex, relative to it.
fn interior(n: usize, chi: f64) -> Vec<Weights> {
    let angle = |i: usize| TAU * i as f64 / n as f64;
    (0..n).map(|i| [chi, angle(i).cos(), angle(i).sin()]).collect()
}

/// The same on a boundary.
fn on_boundary(n: usize) -> Vec<Weights> {
    let mut weights = vec![[0.0; 3]; n];
    (weights[0][0], weights[n - 1][0]) = (1.0 / 6.0, 1.0 / 6.0);
    if n < EDGES_WITHOUT_TANGENTS {
        (weights[0][1], weights[n - 1][1]) = (1.0, -1.0);
        (0..n).for_each(|i| weights[i][2] = across_boundary(n, i));
    }
    weights
}

/// The weight of neighbour i of n in the tangent across the boundary. Those of a mask sum to zero, so that the vertex drops out.
fn across_boundary(n: usize, i: usize) -> f64 {
    let is_end = i == 0 || i == n - 1;
    match n {
        2 => 1.0,
        3 => f64::from(u8::from(!is_end)),
        _ => {
            let angle = PI / (n - 1) as f64;
            let d = 1.0 + 2.0 * angle.cos();
            if is_end {
                -angle.cos() / ((angle / 2.0).tan() * d)
            } else {
                (i as f64 * angle).sin()
            }
        }
    }
}
