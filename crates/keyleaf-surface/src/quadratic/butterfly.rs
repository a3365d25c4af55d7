//! One step of the modified Butterfly scheme (Zorin, Schröder & Sweldens 1996), which interpolates.
//!
//! With the ring r_0 … r_(K−1) about an end v of the edge v–r_j:
//! - K = 6 at both ends: the eight-point stencil, 1/2 at both ends, 1/8 at the two opposite vertices, −1/16 at the four wings;
//! - K ≠ 6 at one end: 3/4 v + Σ s_i r_(j+i), with s = (5/12, −1/12, −1/12) for K = 3, (3/8, 0, −1/8, 0) for K = 4, and
//!   (1/4 + cos(2πi/K) + cos(4πi/K) / 2) / K for more; at both ends: the mean of both;
//! - boundary edges: the four-point stencil (−1, 9, 9, −1) / 16 along the boundary.
//!
//! The ring of a boundary vertex with k edges is completed by its mirror image to K = 2 (k − 1): the vertices of a regular fan have
//! the images 2 v − r_j + cos(π j / (k − 1)) (r_0 − r_(k−1)), which reproduces linear functions for any mesh. An end with fewer than
//! three ring vertices has no stencil: the other end's counts, or else the middle of the chord.

use super::fan::{Fan, angle_weighted};
use super::mask::{Gatherer, Mask, Weights, edges, sides};
use super::net::{QuadraticNet, edge_control};
use super::samples::{LimitSample, LimitSamples};
use crate::direction::cross_direction;
use crate::mesh::unit_or_up;
use glam::DVec3;
use keyleaf_key::{HalfEdge, Topology};
use std::f64::consts::{PI, TAU};

/// The edges of a regular vertex.
const REGULAR: usize = 6;

/// The full ring about a vertex.
struct Ring {
    own: u32,
    /// The real ones.
    vertices: Vec<u32>,
    /// With their mirror images.
    len: usize,
}

impl Ring {
    fn new(topology: &Topology, fan: &Fan) -> Self {
        let vertices = fan.ring(topology);
        let images = if fan.closed { 0 } else { vertices.len() - 2 };
        Self {
            own: fan.vertex(topology),
            len: vertices.len() + images,
            vertices,
        }
    }

    /// Adds what is at a place of the ring, counted from another one.
    fn add(&self, terms: &mut Vec<(u32, Weights)>, place: usize, step: usize, weight: f64) {
        let place = (place + step) % self.len;
        if let Some(&vertex) = self.vertices.get(place) {
            return terms.push(position(vertex, weight));
        }
        let k = self.vertices.len();
        let mirrored = self.len - place;
        let cosine = (PI * mirrored as f64 / (k - 1) as f64).cos();
        terms.extend([
            position(self.own, 2.0 * weight),
            position(self.vertices[mirrored], -weight),
            position(self.vertices[0], cosine * weight),
            position(self.vertices[k - 1], -cosine * weight),
        ]);
    }

    /// Adds the stencil of an end with other than six ring vertices, times a factor.
    fn add_extraordinary(&self, terms: &mut Vec<(u32, Weights)>, place: usize, factor: f64) {
        let weights: Vec<f64> = match self.len {
            3 => vec![5.0 / 12.0, -1.0 / 12.0, -1.0 / 12.0],
            4 => vec![0.375, 0.0, -0.125, 0.0],
            k => (0..k)
                .map(|i| {
                    let angle = TAU * i as f64 / k as f64;
                    (0.25 + angle.cos() + (2.0 * angle).cos() / 2.0) / k as f64
                })
                .collect(),
        };
        let others: f64 = weights.iter().sum();
        terms.push(position(self.own, factor * (1.0 - others)));
        for (i, weight) in weights.iter().enumerate() {
            self.add(terms, place, i, factor * weight);
        }
    }
}

fn position(vertex: u32, weight: f64) -> (u32, Weights) {
    (vertex, [weight, 0.0, 0.0])
}

/// The rings of a mesh, and where in them its half-edges are.
pub struct ButterflyMasks<'a> {
    topology: &'a Topology,
    rings: Vec<Ring>,
    /// By half-edge: its ring and its place there.
    places: Vec<(usize, usize)>,
    gatherer: Gatherer,
}

impl<'a> ButterflyMasks<'a> {
    pub fn new(topology: &'a Topology, fans: &[Fan]) -> Self {
        let mut places = vec![(0, 0); topology.half_edge_count() as usize];
        for (ring, fan) in fans.iter().enumerate() {
            for (place, spoke) in fan.spokes.iter().enumerate() {
                places[topology.half_edge_index(spoke.face, spoke.root) as usize] = (ring, place);
            }
        }
        Self {
            topology,
            rings: fans.iter().map(|fan| Ring::new(topology, fan)).collect(),
            places,
            gatherer: Gatherer::new(topology.vertex_count()),
        }
    }

    fn of(&self, half_edge: HalfEdge) -> (&Ring, usize) {
        let (ring, place) = self.places[self.topology.half_edge_index(half_edge.face, half_edge.root) as usize];
        (&self.rings[ring], place)
    }

    /// The middle of an edge, relative to the start of its owner. Without tangents.
    pub fn edge(&mut self, owner: HalfEdge) -> Mask {
        let terms = match self.topology.twin(owner.face, owner.root) {
            Some(twin) => self.inside([owner, twin]),
            None => self.on_boundary(owner),
        };
        self.gatherer
            .gather(self.topology.vertex(owner.face, owner.root), &terms)
    }

    fn inside(&self, sides: [HalfEdge; 2]) -> Vec<(u32, Weights)> {
        let ends = sides.map(|side| self.of(side));
        let mut terms = Vec::new();
        if ends.iter().all(|(ring, _)| ring.len == REGULAR) {
            let (first, place) = ends[0];
            terms.extend(ends.map(|(ring, _)| position(ring.own, 0.5)));
            for step in [1, REGULAR - 1] {
                first.add(&mut terms, place, step, 0.125);
            }
            for ((ring, place), step) in ends.into_iter().flat_map(|end| [(end, 2), (end, REGULAR - 2)]) {
                ring.add(&mut terms, place, step, -0.0625);
            }
            return terms;
        }
        let has_stencil = |ring: &Ring| ring.len != REGULAR && ring.len >= 3;
        let counted: Vec<(&Ring, usize)> = ends.into_iter().filter(|(ring, _)| has_stencil(ring)).collect();
        for (ring, place) in &counted {
            ring.add_extraordinary(&mut terms, *place, 1.0 / counted.len() as f64);
        }
        if counted.is_empty() {
            terms.extend(ends.map(|(ring, _)| position(ring.own, 0.5)));
        }
        terms
    }

    /// The vertices before and after the edge along the boundary are the last of the fan at its start and the first of that at its end.
    fn on_boundary(&self, owner: HalfEdge) -> Vec<(u32, Weights)> {
        let (start, _) = self.of(owner);
        let next = HalfEdge {
            root: (owner.root + 1) % 3,
            ..owner
        };
        let (end, _) = self.of(next);
        let before = start.vertices.last().copied().unwrap_or(start.own);
        let after = end.vertices.first().copied().unwrap_or(end.own);
        let ends = [start.own, end.own].map(|vertex| position(vertex, 9.0 / 16.0));
        let neighbours = [before, after].map(|vertex| position(vertex, -1.0 / 16.0));
        [ends, neighbours].concat()
    }
}

/// Vertices, edge middles, and the normals of the quadratic patches through them.
pub fn samples(topology: &Topology, positions: &[DVec3]) -> LimitSamples {
    let fans = Fan::all(topology);
    let mut masks = ButterflyMasks::new(topology, &fans);
    let mut middles = vec![DVec3::ZERO; topology.half_edge_count() as usize];
    for owner in edges(topology) {
        let middle = masks.edge(owner).apply(positions).position;
        for side in sides(topology, owner) {
            middles[topology.half_edge_index(side.face, side.root) as usize] = middle;
        }
    }
    let nets: Vec<QuadraticNet> = (0..topology.face_count())
        .map(|face| net(topology, positions, &middles, face))
        .collect();
    let none = LimitSample {
        position: DVec3::ZERO,
        normal: DVec3::Y,
    };
    let mut samples = LimitSamples {
        corners: vec![none; middles.len()],
        edges: vec![none; middles.len()],
    };
    for fan in &fans {
        let sector = |spoke: &HalfEdge| nets[spoke.face as usize].corner_tangents(spoke.root as usize);
        let sample = LimitSample {
            position: positions[fan.vertex(topology) as usize],
            normal: angle_weighted(fan.spokes.iter().map(sector)),
        };
        for spoke in &fan.spokes {
            samples.corners[topology.half_edge_index(spoke.face, spoke.root) as usize] = sample;
        }
    }
    for owner in edges(topology) {
        let normal = edge_normal(&nets, sides(topology, owner));
        for side in sides(topology, owner) {
            let index = topology.half_edge_index(side.face, side.root) as usize;
            let position = middles[index];
            samples.edges[index] = LimitSample { position, normal };
        }
    }
    samples
}

fn net(topology: &Topology, positions: &[DVec3], middles: &[DVec3], face: u32) -> QuadraticNet {
    let corners = [0, 1, 2].map(|corner| positions[topology.vertex(face, corner) as usize]);
    let first = topology.first_half_edge(face) as usize;
    let edges = [0, 1, 2].map(|r| edge_control(middles[first + r], corners[r], corners[(r + 1) % 3]));
    QuadraticNet { corners, edges }
}

/// The mean of the normals of the patches at the middle of an edge.
fn edge_normal(nets: &[QuadraticNet], sides: impl Iterator<Item = HalfEdge>) -> DVec3 {
    let normals = sides.filter_map(|side| {
        let [along, inwards] = nets[side.face as usize].middle_tangents(side.root as usize);
        cross_direction(along, inwards)
    });
    unit_or_up(normals.sum())
}
