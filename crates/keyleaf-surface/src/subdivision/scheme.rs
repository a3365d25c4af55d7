//! Which rules refine a mesh.

use super::loop_scheme::{self, Part};
use super::refinement::Child;
use super::ring::Ring;
use super::stencil::Stencil;
use super::{Creasing, catmull_clark};
use crate::LoopWeights;

/// Steps after which a corner is its limit to the rounding of f64.
const STEPS_TO_LIMIT: u32 = 60;

/// The rules by which a control mesh is refined.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SubdivisionScheme {
    /// Catmull and Clark 1978, for all polygons: the limit of quads is bicubic.
    #[default]
    CatmullClark,
    /// Loop 1987, for triangles: their limit is quartic.
    Loop(LoopWeights),
}

impl SubdivisionScheme {
    /// Control points of a patch.
    pub(crate) fn control_points(self) -> usize {
        match self {
            Self::CatmullClark => super::bicubic::CONTROL_POINTS,
            Self::Loop(_) => super::quartic::CONTROL_POINTS,
        }
    }

    /// The child of a quad or triangle at a corner, where sharpness is settled.
    pub(super) fn child_at(self, ring: &Ring, corner: usize) -> Child {
        match self {
            Self::CatmullClark => catmull_clark::child(ring, corner, Creasing::Uniform),
            Self::Loop(weights) => loop_scheme::child(ring, Part::Corner(corner), weights, Creasing::Uniform),
        }
    }

    /// The limit of a settled corner whose mask has no closed form.
    pub(super) fn limit_by_refinement(self, ring: &Ring, corner: usize) -> Stencil {
        let width = ring.vertex_count;
        let mut rows: Vec<f64> = (0..width * width)
            .map(|k| if k % (width + 1) == 0 { 1.0 } else { 0.0 })
            .collect();
        let mut ring = ring.clone();
        for _ in 0..STEPS_TO_LIMIT {
            let child = self.child_at(&ring, corner);
            rows = child
                .stencils
                .iter()
                .flat_map(|stencil| stencil.apply_to_rows(&rows, width))
                .collect();
            ring = child.ring;
        }
        let first = ring.fans[corner].vertex as usize * width;
        Stencil((0..).zip(rows[first..first + width].iter().copied()).collect())
    }
}
