//! What the GPU reads to find patches of Gaussian products from a covariance mesh that moves. Twin of `shaders/passes/pose_gaussian.wgsl`.
//!
//! `words`:
//! - a face, 8 words: the entry in `surface_a` of its first patch; the word of the first vertex of its ring, and how many there are; the
//!   float in `rows` of its first row; its patches; the word that says of its first patch whether it counts for the mean normal; its first
//!   float of `scratch`; 0;
//! - rings, vertices of the control mesh;
//! - by kind of neighbourhood, a word a patch: whether it counts for the mean normal.

use super::GaussianProduct;
use super::surface::counts_for_normal;
use super::tables::entries_of_patch;
use crate::subdivision::neighbourhoods::Kind;
use crate::subdivision::tree::CellPlace;
use crate::surface::uniform;
use crate::{PoseDispatch, PoseTables, Surface};
use encase::ShaderType;

const WORDS_OF_FACE: usize = 8;

/// Floats in which the GPU keeps what it finds about a vertex of a ring, and about a patch.
const SCRATCH_OF_VERTEX: usize = 9;
const SCRATCH_OF_PATCH: usize = 24;

/// The uniform `pose`.
#[derive(ShaderType)]
struct GaussianPoseParams {
    faces: u32,
    /// The entry of `surface_a` of the first normal.
    normals: u32,
    /// Control points a patch.
    controls: u32,
}

/// The tables of a surface.
pub fn tables(surface: &GaussianProduct) -> PoseTables {
    let (all, size) = (&surface.neighbourhoods, surface.patches.size);
    let entries = entries_of_patch(surface.settings().scheme);
    let ring_words: usize = all.faces.iter().map(|face| face.vertices.len()).sum();
    let first_ring = WORDS_OF_FACE * all.faces.len();
    let (mut counts, mut counts_of) = (Vec::new(), Vec::new());
    for kind in &all.kinds {
        counts_of.push((first_ring + ring_words + counts.len()) as u32);
        counts.extend(places(kind).map(|place| u32::from(counts_for_normal(place))));
    }
    let (rows, rows_of) = all.rows_of_kinds();
    let mut words = Vec::with_capacity(first_ring + ring_words + counts.len());
    let (mut ring, mut scratch) = (first_ring, 0);
    for face in &all.faces {
        let (kind, width) = (face.kind as usize, face.vertices.len());
        let patches = places(&all.kinds[kind]).count();
        words.extend([
            (face.first_entries[0] / size * entries) as u32,
            ring as u32,
            width as u32,
            rows_of[kind],
            patches as u32,
            counts_of[kind],
            scratch as u32,
            0,
        ]);
        ring += width;
        scratch += SCRATCH_OF_VERTEX * width + SCRATCH_OF_PATCH * patches;
    }
    words.extend(all.faces.iter().flat_map(|face| face.vertices.iter().copied()));
    words.extend(counts);
    PoseTables {
        params: uniform(&GaussianPoseParams {
            faces: surface.topology().face_count(),
            normals: (surface.patches.frames.len() * entries) as u32,
            controls: size as u32,
        }),
        words,
        rows,
        scratch,
        vertices: surface.control_positions().len(),
        has_covariances: true,
        dispatches: vec![PoseDispatch::Groups(surface.topology().face_count())],
    }
}

/// Where the patches of a kind are in their domains.
fn places(kind: &Kind) -> impl Iterator<Item = &CellPlace> {
    kind.trees.iter().flat_map(|tree| &tree.places)
}
