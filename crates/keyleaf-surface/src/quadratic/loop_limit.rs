//! The Loop limit surface at vertices and edge middles, by masks.
//!
//! Limit and tangent masks of a vertex with n edges (Loop 1987; Zorin & Schröder 2000): p = (1 − nχ) v + χ Σ e with
//! χ = 1 / (n + 3 / (8β)), tangents Σ cos(2πi/n) e_i and Σ sin(2πi/n) e_i. On a boundary p = (e_0 + 4 v + e_(k−1)) / 6, the tangent
//! along it e_0 − e_(k−1), and across it the exact left eigenvector for the eigenvalue 3/8 + cos(π / (k − 1)) / 4. With k ≥ 7 edges
//! another eigenvalue is at least 1/2, so that there is no tangent plane.

use super::error::TrianglePatchError;
use super::fan::Fan;
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

/// Where the masks change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Rule {
    Interior,
    Boundary,
    /// The vertex stays.
    Sharp,
}

/// A fan with its neighbours and its rule.
struct Vertex {
    fan: Fan,
    ring: Vec<u32>,
    rule: Rule,
}

/// The samples of a mesh of triangles.
pub fn samples(
    topology: &Topology,
    control: &ControlMesh,
    weights: LoopWeights,
) -> Result<LimitSamples, TrianglePatchError> {
    let is_sharp = control.creases.iter().any(|crease| crease.sharpness > 0.0)
        || control.corners.iter().any(|corner| corner.sharpness > 0.0);
    if is_sharp {
        return Err(TrianglePatchError::Sharp);
    }
    if control.boundary == BoundaryRule::None {
        return Err(TrianglePatchError::NoBoundary);
    }
    let vertices = vertices(topology, control.boundary);
    let positions = &control.mesh.positions;
    let step = Step::new(topology, positions, &vertices, weights);
    let none = LimitSample {
        position: DVec3::ZERO,
        normal: DVec3::Y,
    };
    let mut samples = LimitSamples {
        corners: vec![none; topology.half_edge_count() as usize],
        edges: topology.roots().map(|root| step.edge(root.face, root.root)).collect(),
    };
    for vertex in &vertices {
        let sample = corner(topology, positions, vertex, weights);
        for spoke in &vertex.fan.spokes {
            samples.corners[topology.half_edge_index(spoke.face, spoke.root) as usize] = sample;
        }
    }
    Ok(samples)
}

fn vertices(topology: &Topology, boundary: BoundaryRule) -> Vec<Vertex> {
    let fans = Fan::all(topology);
    let mut fans_of = vec![0; topology.vertex_count()];
    fans.iter().for_each(|fan| fans_of[fan.vertex(topology) as usize] += 1);
    let rule = |fan: &Fan| {
        let is_corner = !fan.closed && fan.spokes.len() == 1 && boundary == BoundaryRule::EdgesAndCorners;
        match fan.closed {
            _ if is_corner || fans_of[fan.vertex(topology) as usize] > 1 => Rule::Sharp,
            true => Rule::Interior,
            false => Rule::Boundary,
        }
    };
    fans.into_iter()
        .map(|fan| Vertex {
            ring: fan.ring(topology),
            rule: rule(&fan),
            fan,
        })
        .collect()
}

/// A vertex of the mesh on the limit surface.
fn corner(topology: &Topology, positions: &[DVec3], vertex: &Vertex, weights: LoopWeights) -> LimitSample {
    let own = positions[vertex.fan.vertex(topology) as usize];
    let ring: Vec<DVec3> = vertex.ring.iter().map(|&end| positions[end as usize]).collect();
    let fallback = || vertex.fan.mean_normal(topology, positions);
    match vertex.rule {
        Rule::Interior => interior(own, &ring, weights.chi(ring.len()), fallback),
        Rule::Boundary => on_boundary(own, &ring, fallback),
        Rule::Sharp => LimitSample {
            position: own,
            normal: fallback(),
        },
    }
}

fn interior(own: DVec3, ring: &[DVec3], chi: f64, fallback: impl FnOnce() -> DVec3) -> LimitSample {
    let n = ring.len() as f64;
    let edges = || ring.iter().map(|&end| end - own);
    let sum: DVec3 = edges().sum();
    let tangent = |wave: fn(f64) -> f64| -> DVec3 {
        let weight = |i: usize| wave(TAU * i as f64 / n);
        edges().enumerate().map(|(i, edge)| edge * weight(i)).sum()
    };
    LimitSample {
        position: own + sum * chi,
        normal: cross_direction(tangent(f64::cos), tangent(f64::sin)).unwrap_or_else(fallback),
    }
}

fn on_boundary(own: DVec3, ring: &[DVec3], fallback: impl FnOnce() -> DVec3) -> LimitSample {
    let edges: Vec<DVec3> = ring.iter().map(|&end| end - own).collect();
    let (first, last) = (edges[0], edges[edges.len() - 1]);
    let normal = (edges.len() < EDGES_WITHOUT_TANGENTS)
        .then(|| cross_direction(first - last, across_boundary(&edges)))
        .flatten();
    LimitSample {
        position: own + (first + last) / 6.0,
        normal: normal.unwrap_or_else(fallback),
    }
}

/// The tangent across the boundary, of edges relative to the vertex. The weights of a mask sum to zero, so that the vertex drops out.
fn across_boundary(edges: &[DVec3]) -> DVec3 {
    let k = edges.len();
    let ends = edges[0] + edges[k - 1];
    match k {
        2 => ends,
        3 => edges[1],
        _ => {
            let angle = PI / (k - 1) as f64;
            let d = 1.0 + 2.0 * angle.cos();
            let inner: DVec3 = (1..k - 1).map(|i| edges[i] * (i as f64 * angle).sin()).sum();
            inner - ends * (angle.cos() / ((angle / 2.0).tan() * d))
        }
    }
}

/// The mesh after one step of subdivision.
struct Step<'a> {
    topology: &'a Topology,
    /// By vertex.
    vertices: Vec<DVec3>,
    /// By half-edge: its middle.
    edges: Vec<DVec3>,
}

impl<'a> Step<'a> {
    fn new(topology: &'a Topology, positions: &[DVec3], vertices: &[Vertex], weights: LoopWeights) -> Self {
        let mut moved = positions.to_vec();
        for vertex in vertices {
            let index = vertex.fan.vertex(topology) as usize;
            let (own, ends) = (positions[index], || {
                vertex.ring.iter().map(|&end| positions[end as usize])
            });
            match vertex.rule {
                Rule::Interior => {
                    let sum: DVec3 = ends().map(|end| end - own).sum();
                    moved[index] = own + sum * weights.beta(vertex.ring.len());
                }
                Rule::Boundary => {
                    let [first, last] = [0, vertex.ring.len() - 1].map(|i| positions[vertex.ring[i] as usize]);
                    moved[index] = own * 0.75 + (first + last) / 8.0;
                }
                Rule::Sharp => {}
            }
        }
        let at = |face, corner: u32| positions[topology.vertex(face, corner % 3) as usize];
        let middle = |root: keyleaf_key::Place| {
            let HalfEdge { face, root } = topology.half_edge_owner(root.face, root.root);
            let ends = at(face, root) + at(face, root + 1);
            match topology.twin(face, root) {
                Some(twin) => ends * 0.375 + (at(face, root + 2) + at(twin.face, twin.root + 2)) / 8.0,
                None => ends / 2.0,
            }
        };
        Self {
            topology,
            vertices: moved,
            edges: topology.roots().map(middle).collect(),
        }
    }

    fn vertex(&self, face: u32, corner: u32) -> DVec3 {
        self.vertices[self.topology.vertex(face, corner % 3) as usize]
    }

    fn middle(&self, face: u32, corner: u32) -> DVec3 {
        self.edges[self.topology.half_edge_index(face, corner % 3) as usize]
    }

    /// The middle of a half-edge on the limit surface, as its owner sees it. After one step it has 6 edges, or 4 on a boundary.
    fn edge(&self, face: u32, root: u32) -> LimitSample {
        let HalfEdge { face, root } = self.topology.half_edge_owner(face, root);
        let own = self.middle(face, root);
        let mut ring = vec![
            self.vertex(face, root + 1),
            self.middle(face, root + 1),
            self.middle(face, root + 2),
            self.vertex(face, root),
        ];
        let corners = [0, 1, 2].map(|corner| self.vertex(face, root + corner));
        let fallback = || super::fan::angle_weighted([[corners[1] - corners[0], corners[2] - corners[0]]].into_iter());
        match self.topology.twin(face, root) {
            Some(twin) => {
                ring.extend([1, 2].map(|step| self.middle(twin.face, twin.root + step)));
                interior(own, &ring, 1.0 / 12.0, fallback)
            }
            None => on_boundary(own, &ring, fallback),
        }
    }
}
