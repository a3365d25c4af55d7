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
use super::dual::DualFrame;
use super::lanes::{CONTROLS, Lanes};
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
    let rounding = (POSITION_ERROR + surface.lost_by_posing) * largest + surface.rounding;
    let mut floats = Vec::with_capacity(4 * (patches.frames.len() * entries + surface.normals.len()));
    for (own, net) in patches.frames.iter().zip(&patches.nets) {
        push_frame(&mut floats, &own.frame, origin);
        push_controls(&mut floats, net, patches.size);
    }
    floats.extend(surface.normals.iter().flat_map(|&normal| vector_entry(normal)));
    SurfaceTables {
        params: words.params(
            patches.frames.len() * entries,
            rounding + 2.0 * surface.terminal_error(),
        ),
        a: floats,
        b: words.words,
        heights: None,
        height_bounds: None,
    }
}

fn push_frame(floats: &mut Vec<f32>, frame: &DualFrame, origin: DVec3) {
    let centre = (frame.centre - origin).to_array();
    for (column, centre) in [frame.axes.x_axis, frame.axes.y_axis, frame.axes.z_axis]
        .into_iter()
        .zip(centre)
    {
        floats.extend([column.x, column.y, column.z, centre].map(|x| x as f32));
    }
}

fn push_controls(floats: &mut Vec<f32>, net: &Lanes<CONTROLS>, size: usize) {
    let [others @ .., last] = &net.0;
    for k in 0..size {
        floats.extend(others.each_ref().map(|lane| lane[k] as f32));
    }
    let in_fours = 0..size.next_multiple_of(4);
    floats.extend(in_fours.map(|k| if k < size { last[k] as f32 } else { 0.0 }));
}
