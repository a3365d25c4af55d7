//! What the shaders of subdivision surfaces read.
//!
//! `surface_a`, four floats an entry: the control points of all patches, face after face, domain after domain, patch after patch: 16 a
//! patch of a Catmull-Clark surface, u fastest; 15 of a Loop surface, those without a third exponent first, as the control points with
//! exponents (4 0 0), (3 1 0), …, (0 4 0), (3 0 1), …, (0 0 4) of the three barycentric coordinates. Entry 0 of a patch is a position
//! relative to the origin, the others are differences to it. Then the mean normals of the faces.
//!
//! `surface_b`, words:
//! - a half-edge, 8 words: the half-edge that owns the edge; the half-edge whose start owns the corner at its start; bits of three bounds
//!   (size, ball, deviation); the word of the root node of the domain of this number, and the entry of its first patch; its face. A quad of a
//!   Catmull-Clark surface and a triangle of a Loop surface have one domain, at their first half-edge; both words of the others are 0. Other
//!   faces have a domain a corner;
//! - nodes of the trees, one word each: with bit 31 the number of a patch within its domain, else the word of the first of four children:
//!   at (0, 0), (1, 0), (0, 1), (1, 1) of the halves of u and v; of a triangle at corners 0, 1, 2 and in the middle. The corners of the
//!   middle one are the middles of the edges across from corners 0, 1, 2. Faces with the same neighbourhood share nodes.

use super::Subdivision;
use super::addresses::corner_owner;
use super::neighbourhoods::Neighbourhoods;
use super::tree::Node;
use crate::direction::round_up;
use crate::mesh::{POSITION_ERROR, vector_entry};
use crate::root_bound::RootBound;
use crate::surface::uniform;
use crate::{Surface, SurfaceTables};
use encase::ShaderType;
use glam::DVec3;
use keyleaf_key::{Place, Topology};

/// A node that is a patch.
const PATCH: u32 = 1 << 31;

const WORDS_OF_HALF_EDGE: usize = 8;

/// The uniform `surface`.
#[derive(ShaderType)]
struct SubdivisionParams {
    faces: u32,
    /// The entry of `surface_a` of the first normal.
    normals: u32,
    /// The word of `surface_b` of the first node.
    nodes: u32,
    /// The rounding error of a position, and how far terminal patches are off, from above.
    margin: f32,
}

/// The tables for positions relative to `origin`.
pub fn tables(surface: &Subdivision, origin: DVec3) -> SurfaceTables {
    let words = TopologyWords::new(surface.topology(), &surface.neighbourhoods, &surface.bounds, |entry| {
        entry
    });
    let params = words.params(
        surface.points.len(),
        POSITION_ERROR * surface.largest_coordinate(origin) + 2.0 * surface.terminal_error,
    );
    SurfaceTables {
        params,
        a: control_floats(surface, origin)
            .chain(surface.normals.iter().flat_map(|&normal| vector_entry(normal)))
            .collect(),
        b: words.words,
        heights: None,
        height_bounds: None,
    }
}

/// Half-edges and nodes.
pub struct TopologyWords {
    /// `surface_b`.
    pub words: Vec<u32>,
    faces: u32,
    nodes: u32,
}

impl TopologyWords {
    /// `entry_of` gives the entry of a patch of `surface_a` by that of its first control point, where control points have one entry
    /// each and nothing else is between them.
    pub fn new(
        topology: &Topology,
        all: &Neighbourhoods,
        bounds: &[RootBound],
        entry_of: impl Fn(usize) -> usize,
    ) -> Self {
        let first_node = WORDS_OF_HALF_EDGE * topology.half_edge_count() as usize;
        let (nodes, roots) = node_words(all, first_node);
        let mut words = Vec::with_capacity(first_node + nodes.len());
        for (at, bound) in topology.roots().zip(bounds) {
            words.extend(half_edge_words(topology, all, &roots, &entry_of, &at, bound));
        }
        words.extend(nodes);
        Self {
            words,
            faces: topology.face_count(),
            nodes: first_node as u32,
        }
    }

    /// The uniform, with the entry of the first normal.
    pub fn params(&self, normals: usize, margin: f64) -> Vec<u8> {
        uniform(&SubdivisionParams {
            faces: self.faces,
            normals: normals as u32,
            nodes: self.nodes,
            margin: round_up(margin),
        })
    }
}

fn control_floats(surface: &Subdivision, origin: DVec3) -> impl Iterator<Item = f32> {
    let patches = surface.points.chunks_exact(surface.neighbourhoods.control_points);
    patches.flat_map(move |patch| {
        let first = vector_entry(patch[0] - origin);
        [first]
            .into_iter()
            .chain(patch[1..].iter().map(|&point| vector_entry(point)))
            .flatten()
    })
}

/// The nodes of all trees, and the words of their roots by kind and domain.
fn node_words(all: &Neighbourhoods, first: usize) -> (Vec<u32>, Vec<Vec<u32>>) {
    let mut words = Vec::new();
    let mut roots = Vec::with_capacity(all.kinds.len());
    for kind in &all.kinds {
        let mut roots_of_kind = Vec::with_capacity(kind.trees.len());
        for tree in &kind.trees {
            let root = (first + words.len()) as u32;
            roots_of_kind.push(root);
            words.extend(tree.nodes.iter().map(|node| match node {
                Node::Patch(patch) => patch | PATCH,
                Node::Children(child) => root + child,
            }));
        }
        roots.push(roots_of_kind);
    }
    (words, roots)
}

fn half_edge_words(
    topology: &Topology,
    all: &Neighbourhoods,
    roots: &[Vec<u32>],
    entry_of: impl Fn(usize) -> usize,
    at: &Place,
    bound: &RootBound,
) -> [u32; WORDS_OF_HALF_EDGE] {
    let owner = topology.half_edge_owner(at.face, at.root);
    let corner = corner_owner(topology, at.face, at.root);
    let ring = &all.faces[at.face as usize];
    let domain = at.root as usize;
    let [size, ball, deviation] = [bound.size, bound.ball, bound.deviation].map(|bound| round_up(bound).to_bits());
    [
        topology.half_edge_index(owner.face, owner.root),
        topology.half_edge_index(corner.face, corner.root),
        size,
        ball,
        deviation,
        roots[ring.kind as usize].get(domain).copied().unwrap_or(0),
        ring.first_entries
            .get(domain)
            .map_or(0, |&entry| entry_of(entry) as u32),
        at.face,
    ]
}
