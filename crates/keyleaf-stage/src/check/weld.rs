//! Numbers for the points of the base grid: equal exactly where the points are the same point of the surface.

use keyleaf::key::{Place, RootPoint, Site, Topology};
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::hash::{BuildHasherDefault, Hasher};

/// The root-space point of vertex (i, j) of the base grid of 4^k triangles on a drawn leaf; twin of `shaders/shared/grid.wgsl`.
///
/// A pair is drawn as one triangle by its even half: [`Place::at_of_pair`]. Level and k together are at most 31.
pub fn grid_point(leaf: Place, is_pair: bool, [i, j]: [u32; 2], k: u32) -> RootPoint {
    let step = leaf.unit() >> k;
    if is_pair {
        leaf.at_of_pair(i * step, j * step)
    } else {
        leaf.at(i * step, j * step)
    }
}

/// A number for the site of a point: two points have the same iff they are the same point of the surface.
pub fn site_number(topology: &Topology, point: RootPoint) -> u128 {
    let half_edge = |face, corner| u128::from(topology.half_edge_index(face, corner)) << 64;
    let (kind, number): (u128, u128) = match Site::of(topology, point) {
        Site::Vertex { vertex, .. } => (0, vertex.into()),
        Site::Edge { owner, t } => (1, half_edge(owner.face, owner.root) | u128::from(t)),
        Site::Spoke { face, corner, t } => (2, half_edge(face, corner) | u128::from(t)),
        Site::Centre { face } => (3, face.into()),
        Site::Interior(p) => (4, half_edge(p.face, p.root) | u128::from(p.x) << 32 | u128::from(p.y)),
    };
    kind << 96 | number
}

/// A number for a place of this mesh.
pub(super) fn place_number(topology: &Topology, place: Place) -> u128 {
    let half_edge = u128::from(topology.half_edge_index(place.face, place.root));
    u128::from(place.level) << 100
        | u128::from(place.orientation) << 96
        | half_edge << 64
        | u128::from(place.x) << 32
        | u128::from(place.y)
}

/// A hasher for numbers that no adversary chose: multiply and fold. Some ten times faster than the default.
#[derive(Default)]
pub struct QuickHasher(u64);

impl Hasher for QuickHasher {
    fn write(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.write_u64(u64::from(*byte));
        }
    }

    fn write_u64(&mut self, n: u64) {
        const GOLDEN: u128 = 0x9e37_79b9_7f4a_7c15; // 2^64 over the golden ratio, odd
        let product = u128::from(self.0.rotate_left(29) ^ n) * GOLDEN;
        self.0 = (product ^ (product >> 64)) as u64;
    }

    fn write_u128(&mut self, n: u128) {
        self.write_u64(n as u64);
        self.write_u64((n >> 64) as u64);
    }

    fn finish(&self) -> u64 {
        self.0
    }
}

/// A hash map from such numbers.
pub(super) type QuickMap<K, V> = HashMap<K, V, BuildHasherDefault<QuickHasher>>;

/// Gives the points of a surface consecutive indices.
#[derive(Default)]
pub struct Welder {
    indices: QuickMap<u128, u32>,
}

impl Welder {
    /// A welder with room for `points` points.
    pub fn with_capacity(points: usize) -> Self {
        Self {
            indices: QuickMap::with_capacity_and_hasher(points, Default::default()),
        }
    }

    /// The index of a point, and whether it is new.
    pub fn index(&mut self, topology: &Topology, point: RootPoint) -> (u32, bool) {
        let next = self.indices.len() as u32;
        match self.indices.entry(site_number(topology, point)) {
            Entry::Occupied(there) => (*there.get(), false),
            Entry::Vacant(free) => (*free.insert(next), true),
        }
    }

    /// The index of a point that is already there.
    pub fn find(&self, topology: &Topology, point: RootPoint) -> Option<u32> {
        self.indices.get(&site_number(topology, point)).copied()
    }
}
