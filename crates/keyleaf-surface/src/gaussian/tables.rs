//! What the shaders of Gaussian-product surfaces read.
//!
//! `surface_b` is that of a subdivision surface, with 39 entries a patch of a Catmull-Clark surface, 37 of a Loop surface.
//!
//! `surface_a`, four floats an entry. A patch, whose control points have the order of subdivision surfaces:
//! - 3 entries: the columns of the axes of its frame, each with a coordinate of the centre relative to the origin;
//! - 2 entries a control point: q̂ xx, xy, xz, yy; q̂ yz, zz, q̄ x, y;
//! - q̄ z of all, four an entry.
//!
//! Then the mean normals of the faces.

use super::GaussianProduct;
use super::dual::{Dual, DualFrame};
use crate::mesh::{POSITION_ERROR, vector_entry};
use crate::subdivision::tables::TopologyWords;
use crate::{SubdivisionScheme, Surface, SurfaceTables};
use glam::DVec3;

/// Entries of the frame of a patch.
const FRAME: usize = 3;

/// Entries a patch.
pub fn entries_of_patch(scheme: SubdivisionScheme) -> usize {
    let points = scheme.control_points();
    FRAME + 2 * points + points.div_ceil(4)
}

/// The tables for positions relative to `origin`.
pub fn tables(surface: &GaussianProduct, origin: DVec3) -> SurfaceTables {
    let patches = &surface.patches;
    let entries = entries_of_patch(surface.settings().scheme);
    let words = TopologyWords::new(surface.topology(), &surface.neighbourhoods, &surface.bounds, |entry| {
        entry / patches.size * entries
    });
    let (low, high) = surface.bounding_box();
    let largest = (low - origin).abs().max((high - origin).abs()).max_element();
    let rounding = POSITION_ERROR * largest + surface.rounding;
    let own = patches.frames.iter().zip(patches.controls.chunks_exact(patches.size));
    SurfaceTables {
        params: words.params(
            patches.frames.len() * entries,
            rounding + 2.0 * surface.terminal_error(),
        ),
        a: own
            .flat_map(|(own, controls)| frame_floats(&own.frame, origin).chain(control_floats(controls)))
            .chain(surface.normals.iter().flat_map(|&normal| vector_entry(normal)))
            .collect(),
        b: words.words,
        heights: None,
        height_bounds: None,
    }
}

fn frame_floats(frame: &DualFrame, origin: DVec3) -> impl Iterator<Item = f32> {
    let centre = (frame.centre - origin).to_array();
    let columns = [frame.axes.x_axis, frame.axes.y_axis, frame.axes.z_axis];
    let entry = |(column, centre): (DVec3, f64)| [column.x, column.y, column.z, centre];
    columns.into_iter().zip(centre).flat_map(entry).map(|x| x as f32)
}

fn control_floats(controls: &[Dual]) -> impl Iterator<Item = f32> + '_ {
    let first = controls.iter().flat_map(|control| {
        let [xx, xy, xz, yy, yz, zz, x, y, _] = control.to_array();
        [xx, xy, xz, yy, yz, zz, x, y]
    });
    let padding = controls.len().next_multiple_of(4) - controls.len();
    let last = controls.iter().map(|control| control.information.z);
    first
        .chain(last)
        .chain(std::iter::repeat_n(0.0, padding))
        .map(|x| x as f32)
}
