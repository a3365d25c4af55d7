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
use super::net::{QuadraticNet, edge_control};
use super::samples::{LimitSample, LimitSamples};
use crate::direction::cross_direction;
use crate::mesh::unit_or_up;
use glam::DVec3;
use keyleaf_key::{HalfEdge, Place, Topology};
use std::f64::consts::{PI, TAU};

/// The edges of a regular vertex.
const REGULAR: usize = 6;

/// A fan with the positions of its full ring.
struct Ring {
    fan: Fan,
    own: DVec3,
    /// The real ones first.
    points: Vec<DVec3>,
}

impl Ring {
    fn new(topology: &Topology, positions: &[DVec3], fan: Fan) -> Self {
        let own = positions[fan.vertex(topology) as usize];
        let mut points: Vec<DVec3> = fan.ring(topology).iter().map(|&end| positions[end as usize]).collect();
        if !fan.closed {
            let k = points.len();
            let along = points[0] - points[k - 1];
            for j in (1..k - 1).rev() {
                let cosine = (PI * j as f64 / (k - 1) as f64).cos();
                points.push(own * 2.0 - points[j] + along * cosine);
            }
        }
        Self { fan, own, points }
    }

    /// The ring from a place on.
    fn at(&self, place: usize, step: usize) -> DVec3 {
        self.points[(place + step) % self.points.len()]
    }

    /// The stencil of an end with other than six ring vertices, none for fewer than three.
    fn extraordinary(&self, place: usize) -> Option<DVec3> {
        let k = self.points.len();
        let weight = |i: usize| match k {
            3 => [5.0 / 12.0, -1.0 / 12.0, -1.0 / 12.0][i],
            4 => [0.375, 0.0, -0.125, 0.0][i],
            _ => {
                let angle = TAU * i as f64 / k as f64;
                (0.25 + angle.cos() + (2.0 * angle).cos() / 2.0) / k as f64
            }
        };
        let sum: DVec3 = (0..k).map(|i| (self.at(place, i) - self.own) * weight(i)).sum();
        (k >= 3).then(|| self.own + sum)
    }
}

/// The rings of a mesh, and where in them its half-edges are.
struct Rings<'a> {
    topology: &'a Topology,
    positions: &'a [DVec3],
    rings: Vec<Ring>,
    /// By half-edge: its ring and its place there.
    places: Vec<(usize, usize)>,
}

impl<'a> Rings<'a> {
    fn new(topology: &'a Topology, positions: &'a [DVec3]) -> Self {
        let fans = Fan::all(topology);
        let rings: Vec<Ring> = fans
            .into_iter()
            .map(|fan| Ring::new(topology, positions, fan))
            .collect();
        let mut places = vec![(0, 0); topology.half_edge_count() as usize];
        for (ring, Ring { fan, .. }) in rings.iter().enumerate() {
            for (place, spoke) in fan.spokes.iter().enumerate() {
                places[topology.half_edge_index(spoke.face, spoke.root) as usize] = (ring, place);
            }
        }
        Self {
            topology,
            positions,
            rings,
            places,
        }
    }

    fn of(&self, half_edge: HalfEdge) -> (&Ring, usize) {
        let (ring, place) = self.places[self.topology.half_edge_index(half_edge.face, half_edge.root) as usize];
        (&self.rings[ring], place)
    }

    /// The middle of a half-edge.
    fn middle(&self, face: u32, root: u32) -> DVec3 {
        let owner = self.topology.half_edge_owner(face, root);
        match self.topology.twin(owner.face, owner.root) {
            Some(twin) => self.inside([owner, twin]),
            None => self.on_boundary(owner),
        }
    }

    fn inside(&self, sides: [HalfEdge; 2]) -> DVec3 {
        let ends = sides.map(|side| self.of(side));
        let [a, b] = ends.map(|(ring, _)| ring.own);
        if ends.iter().all(|(ring, _)| ring.points.len() == REGULAR) {
            let (first, place) = ends[0];
            let opposite = first.at(place, 1) + first.at(place, REGULAR - 1);
            let wings: DVec3 = ends
                .map(|(ring, place)| ring.at(place, 2) + ring.at(place, REGULAR - 2))
                .into_iter()
                .sum();
            return (a + b) / 2.0 + opposite / 8.0 - wings / 16.0;
        }
        let stencil = |(ring, place): (&Ring, usize)| match ring.points.len() {
            REGULAR => None,
            _ => ring.extraordinary(place),
        };
        match ends.map(stencil) {
            [Some(first), Some(second)] => (first + second) / 2.0,
            [one, other] => one.or(other).unwrap_or((a + b) / 2.0),
        }
    }

    /// The vertices before and after the edge along the boundary are the last of the fan at its start and the first of that at its end.
    fn on_boundary(&self, owner: HalfEdge) -> DVec3 {
        let (start, _) = self.of(owner);
        let next = HalfEdge {
            root: (owner.root + 1) % 3,
            ..owner
        };
        let (end, _) = self.of(next);
        let [from, to] = [start, end].map(|ring| ring.fan.ring(self.topology));
        let at = |vertex: u32| self.positions[vertex as usize];
        let neighbours = from.last().map_or(start.own, |&v| at(v)) + to.first().map_or(end.own, |&v| at(v));
        ((start.own + end.own) * 9.0 - neighbours) / 16.0
    }
}

/// Vertices, edge middles, and the normals of the quadratic patches through them.
pub fn samples(topology: &Topology, positions: &[DVec3]) -> LimitSamples {
    let rings = Rings::new(topology, positions);
    let middles: Vec<DVec3> = topology
        .roots()
        .map(|root| rings.middle(root.face, root.root))
        .collect();
    let nets: Vec<QuadraticNet> = (0..topology.face_count())
        .map(|face| net(topology, positions, &middles, face))
        .collect();
    let mut corners = vec![
        LimitSample {
            position: DVec3::ZERO,
            normal: DVec3::Y
        };
        middles.len()
    ];
    for ring in &rings.rings {
        let sector = |spoke: &HalfEdge| nets[spoke.face as usize].corner_tangents(spoke.root as usize);
        let sample = LimitSample {
            position: ring.own,
            normal: angle_weighted(ring.fan.spokes.iter().map(sector)),
        };
        for spoke in &ring.fan.spokes {
            corners[topology.half_edge_index(spoke.face, spoke.root) as usize] = sample;
        }
    }
    let edge = |(root, &position): (Place, &DVec3)| LimitSample {
        position,
        normal: edge_normal(topology, &nets, topology.half_edge_owner(root.face, root.root)),
    };
    LimitSamples {
        corners,
        edges: topology.roots().zip(&middles).map(edge).collect(),
    }
}

fn net(topology: &Topology, positions: &[DVec3], middles: &[DVec3], face: u32) -> QuadraticNet {
    let corners = [0, 1, 2].map(|corner| positions[topology.vertex(face, corner) as usize]);
    let first = topology.first_half_edge(face) as usize;
    let edges = [0, 1, 2].map(|r| edge_control(middles[first + r], corners[r], corners[(r + 1) % 3]));
    QuadraticNet { corners, edges }
}

/// The mean of the normals of both patches at the middle of an edge.
fn edge_normal(topology: &Topology, nets: &[QuadraticNet], owner: HalfEdge) -> DVec3 {
    let twin = topology.twin(owner.face, owner.root);
    let normals = [Some(owner), twin].into_iter().flatten().filter_map(|side| {
        let [along, inwards] = nets[side.face as usize].middle_tangents(side.root as usize);
        cross_direction(along, inwards)
    });
    unit_or_up(normals.sum())
}
