//! How far terminal patches are from the limit surface.

use super::dual::Dual;
use super::dual_patches::{DualPatches, DualVertices};
use crate::subdivision::BETWEEN_SAMPLES;
use crate::subdivision::exact::Located;
use crate::subdivision::neighbourhoods::Neighbourhoods;
use crate::subdivision::stencil::Vector;

/// The greatest distance at samples of the terminal patches, with room for what is between them; object units.
///
/// The trees have the errors of samples in dual space. In space they are what they are at the corner of the patch where they count most.
pub fn error(all: &Neighbourhoods, patches: &DualPatches, vertices: &DualVertices) -> f64 {
    let mut greatest: f64 = 0.0;
    for face in &all.faces {
        let ring = || face.vertices.iter().map(|&vertex| vertices.values[vertex as usize]);
        for (tree, first) in all.kinds[face.kind as usize].iter().zip(&face.first_entries) {
            let rows = tree.errors.chunks_exact(tree.width).zip(&tree.error_patches);
            for (row, &patch) in rows {
                // Rows sum to zero.
                let origin = ring().next().unwrap_or_default();
                let terms = ring().zip(row);
                let missed = terms.fold(Dual::ZERO, |sum, (value, &weight)| sum.plus(value - origin, weight));
                let patch = first / patches.size + patch as usize;
                greatest = greatest.max(in_space(patches, vertices, patch, &missed));
            }
        }
    }
    BETWEEN_SAMPLES * greatest
}

/// The greatest motion of a corner of a patch whose value changes so.
fn in_space(patches: &DualPatches, vertices: &DualVertices, patch: usize, missed: &Dual) -> f64 {
    let own = &patches.frames[patch];
    let missed = own.of_vertices(missed, vertices);
    let controls = patches.controls(patch);
    let motion = |&corner: &usize| (own.frame.axes * controls[corner].motion(missed)).length();
    patches.corners().iter().map(motion).fold(0.0, f64::max)
}
