//! Metrics that are the same bits in any language: made of 64-bit integers, or of sums, products, quotients and square roots.

use keyleaf_key::{Key, ONE, Place, RootPoint, Topology, neighbour};
use proptest::prelude::*;
use std::cell::RefCell;
use std::collections::HashMap;

/// SplitMix64, one step.
pub fn mix(z: u64) -> u64 {
    let z = z.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ z >> 31
}

pub fn hash(key: Key, seed: u64) -> u64 {
    mix(mix(mix(seed ^ u64::from(key.face())) ^ u64::from(key.root())) ^ key.node())
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// 2 or 1/2. Nested.
    Random,
    /// From 1/4 to 60, many buckets. Nested.
    Graded,
    /// Length of the hypotenuse over the distance of its middle from an eye, on the unit cube. Nested.
    Distance,
    /// As `Graded`, but not nested.
    Wild,
    /// As `Wild`, and the two halves of a diamond differ.
    Lopsided,
}

#[derive(Clone, Copy, Debug)]
pub struct Metric {
    kind: Kind,
    seed: u64,
}

impl Metric {
    pub fn new(kind: Kind, seed: u64) -> Self {
        Self { kind, seed }
    }

    /// Metric over threshold of the nodes of a mesh, each computed once.
    pub fn on(self, topology: &Topology) -> impl Fn(&Place) -> f64 {
        let known = RefCell::new(HashMap::new());
        move |node| self.remembered(topology, *node, &mut known.borrow_mut())
    }

    fn remembered(self, topology: &Topology, node: Place, known: &mut HashMap<Place, f64>) -> f64 {
        if let Some(&value) = known.get(&node) {
            return value;
        }
        let own = hash(node.key(), self.seed);
        let of_diamond = || neighbour::h(topology, node).map_or(own, |other| own.min(hash(other.key(), self.seed)));
        let value = match self.kind {
            Kind::Lopsided => graded(own),
            Kind::Wild | Kind::Graded => graded(of_diamond()),
            Kind::Random => self.coin(of_diamond()),
            Kind::Distance => self.nearness(node),
        };
        let is_nested = matches!(self.kind, Kind::Random | Kind::Graded | Kind::Distance);
        let value = match node.parent().filter(|_| is_nested) {
            Some(parent) => value.min(self.remembered(topology, parent, known)),
            None => value,
        };
        known.insert(node, value);
        value
    }

    fn coin(self, hash: u64) -> f64 {
        let per_cent = [50, 35, 70, 90][(self.seed % 4) as usize];
        if hash % 100 < per_cent { 2.0 } else { 0.5 }
    }

    fn nearness(self, node: Place) -> f64 {
        let eye: [f64; 3] = std::array::from_fn(|k| (mix(self.seed + 1 + k as u64) % 1601) as f64 / 1000.0 - 0.3);
        let limit = [0.1, 0.2, 0.35, 0.6][(self.seed % 4) as usize];
        let [_, right, up] = node.corners().map(on_unit_cube);
        let middle = std::array::from_fn(|k| (right[k] + up[k]) / 2.0);
        distance(right, up) / distance(middle, eye).max(1e-9) / limit
    }
}

fn graded(hash: u64) -> f64 {
    2.0_f64.powi((hash % 8) as i32 - 2) * (1.0 + (hash >> 8) as u8 as f64 % 8.0 / 8.0)
}

/// Position on the cube of [`crate::meshes::cube`].
fn on_unit_cube(at: RootPoint) -> [f64; 3] {
    let face = &crate::meshes::cube().faces[at.face as usize];
    let weight = |value: u32| f64::from(value) / f64::from(ONE);
    std::array::from_fn(|axis| {
        let coordinate = |corner: usize| f64::from(face[corner % 4] >> (2 - axis) & 1);
        let centre = (0..4).map(coordinate).sum::<f64>() / 4.0;
        let root = at.root as usize;
        centre * weight(at.z()) + coordinate(root) * weight(at.x) + coordinate(root + 1) * weight(at.y)
    })
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let [x, y, z] = std::array::from_fn(|k| a[k] - b[k]);
    (x * x + y * y + z * z).sqrt()
}

/// Metrics that work on every mesh.
pub fn any_kind() -> impl Strategy<Value = Metric> {
    (
        prop::sample::select(vec![Kind::Random, Kind::Graded, Kind::Wild, Kind::Lopsided]),
        any::<u64>(),
    )
        .prop_map(|(kind, seed)| Metric::new(kind, seed))
}

pub fn nested() -> impl Strategy<Value = Metric> {
    (prop::sample::select(vec![Kind::Random, Kind::Graded]), any::<u64>())
        .prop_map(|(kind, seed)| Metric::new(kind, seed))
}
