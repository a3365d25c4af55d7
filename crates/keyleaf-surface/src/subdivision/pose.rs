//! What the GPU reads to find the control points of a surface from a control mesh that moves. Twin of `shaders/passes/pose.wgsl`.
//!
//! `words`:
//! - a face, 8 words: the entry in `surface_a` of its first control point; the word of the first vertex of its ring, and how many there
//!   are; the float in `rows` of its first row; its patches; the word of the record of its kind; its first half-edge, and how many it has;
//! - a half-edge: the half-edge on the other side, or `0xffffffff`;
//! - rings, vertices of the control mesh;
//! - a kind of neighbourhood, a record: bits of a float a patch, by which derivatives in the patch become those in its domain; two words a
//!   root, the word of a list relative to the record and its length; those lists, patches that the root touches, with bit 31 where
//!   their parameters are the root's exchanged.

use super::neighbourhoods::Kind;
use super::{Subdivision, SubdivisionScheme};
use crate::surface::uniform;
use crate::{PoseDispatch, PoseShader, PoseTables, Surface};
use encase::ShaderType;
use keyleaf_key::Topology;

const WORDS_OF_FACE: usize = 8;
const NONE: u32 = u32::MAX;
const TURNED: u32 = 1 << 31;

/// Floats in which the GPU keeps what it finds about a patch, and about a half-edge.
const SCRATCH_OF_PATCH: usize = 8;
const SCRATCH_OF_HALF_EDGE: usize = 2;

/// The uniform `pose`.
#[derive(ShaderType)]
struct PoseParams {
    faces: u32,
    half_edges: u32,
    /// The entry of `surface_a` of the first normal.
    normals: u32,
}

/// The WGSL about the patches of a scheme.
pub fn shader(scheme: SubdivisionScheme) -> PoseShader {
    match scheme {
        SubdivisionScheme::CatmullClark => PoseShader::CATMULL_CLARK,
        SubdivisionScheme::Loop(_) => PoseShader::LOOP,
    }
}

/// The tables of a surface.
pub fn tables(surface: &Subdivision) -> PoseTables {
    let (all, topology) = (&surface.neighbourhoods, surface.topology());
    let half_edges = topology.half_edge_count() as usize;
    let first_ring = WORDS_OF_FACE * all.faces.len() + half_edges;
    let ring_words: usize = all.faces.iter().map(|face| face.vertices.len()).sum();
    let kinds = Kinds::new(surface, first_ring + ring_words);

    let mut words = Vec::with_capacity(first_ring + ring_words + kinds.words.len());
    let mut ring = first_ring;
    for (number, face) in (0..).zip(&all.faces) {
        let kind = face.kind as usize;
        words.extend([
            face.first_entries[0] as u32,
            ring as u32,
            face.vertices.len() as u32,
            kinds.rows_of[kind],
            patches(&all.kinds[kind]) as u32,
            kinds.records[kind],
            topology.first_half_edge(number),
            topology.corner_count(number),
        ]);
        ring += face.vertices.len();
    }
    words.extend(other_sides(topology));
    words.extend(all.faces.iter().flat_map(|face| face.vertices.iter().copied()));
    words.extend(kinds.words);
    PoseTables {
        params: uniform(&PoseParams {
            faces: topology.face_count(),
            half_edges: topology.half_edge_count(),
            normals: all.entries as u32,
        }),
        words,
        rows: kinds.rows,
        scratch: SCRATCH_OF_PATCH * (all.entries / all.control_points) + SCRATCH_OF_HALF_EDGE * half_edges,
        vertices: surface.cage.positions.len(),
        has_covariances: false,
        dispatches: vec![
            PoseDispatch::Groups(topology.face_count()),
            PoseDispatch::Invocations(topology.half_edge_count()),
        ],
    }
}

fn patches(kind: &Kind) -> usize {
    kind.trees.iter().map(|tree| tree.places.len()).sum()
}

/// The half-edge on the other side, by half-edge.
fn other_sides(topology: &Topology) -> impl Iterator<Item = u32> + '_ {
    topology.roots().map(|root| {
        let twin = topology.twin(root.face, root.root);
        twin.map_or(NONE, |twin| topology.half_edge_index(twin.face, twin.root))
    })
}

/// What faces of a kind share.
struct Kinds {
    words: Vec<u32>,
    /// The word of each record.
    records: Vec<u32>,
    rows: Vec<f32>,
    /// The float of the first row of each.
    rows_of: Vec<u32>,
}

impl Kinds {
    fn new(surface: &Subdivision, first: usize) -> Self {
        let all = &surface.neighbourhoods;
        let (rows, rows_of) = all.rows_of_kinds();
        let mut kinds = Self {
            words: Vec::new(),
            records: Vec::new(),
            rows,
            rows_of,
        };
        for kind in &all.kinds {
            kinds.records.push((first + kinds.words.len()) as u32);
            kinds.words.extend(record(kind));
        }
        kinds
    }
}

/// The record of a kind.
fn record(kind: &Kind) -> Vec<u32> {
    let corners = kind.touched.len();
    let places = kind.trees.iter().flat_map(|tree| &tree.places);
    let mut words: Vec<u32> = places
        .map(|place| (1.0 / place.right[0].abs()) as f32)
        .map(f32::to_bits)
        .collect();
    let mut first_patch = vec![0];
    for tree in &kind.trees {
        first_patch.push(first_patch[first_patch.len() - 1] + tree.places.len() as u32);
    }
    let lists: Vec<Vec<u32>> = (0..corners)
        .map(|root| {
            let touched = kind.touched[root].iter();
            touched
                .map(|touched| {
                    let patch = first_patch[touched.domain] + touched.patch;
                    if touched.is_turned { patch | TURNED } else { patch }
                })
                .collect()
        })
        .collect();
    let mut start = words.len() + 2 * corners;
    for list in &lists {
        words.extend([start as u32, list.len() as u32]);
        start += list.len();
    }
    words.extend(lists.concat());
    words
}
