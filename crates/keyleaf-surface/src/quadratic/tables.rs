//! What the shaders of triangle patches read.
//!
//! `surface_a`, four floats an entry (the last is 0), face after face, [`ENTRIES_OF_QUADRATIC`] or [`ENTRIES_OF_CUBIC`] each:
//! - the base: corner 0 relative to the origin;
//! - the other control points as differences to corner 0, taken in f64: corner 1, corner 2, then the edges 0, 1, 2 with one control
//!   point each (quadratic) or two (cubic, the one near the start of the half-edge first), then the centre (cubic);
//! - the normal patch: its corners 0, 1, 2 and its edges 0, 1, 2. Not of unit length;
//! - the mean normal.
//!
//! `surface_b`, [`WORDS_OF_HALF_EDGE`] words a half-edge (3 · face + root): the half-edge that owns the edge; the half-edge that owns
//! the corner at its start; bits of two bounds: `size`, to be multiplied by 2^−level, and `deviation`, by 4^−level. The radius of the
//! ball is `size` times 2^−min(level, 30), that of the guard ball twice the radius.
//!
//! # Equal bits
//!
//! With D_i the difference of control point i (zero for corner 0), a point is `base + sum`. At a vertex, `sum` is D of the owner's
//! corner. Inside an edge, t of the way from the start r of the owner's half-edge to its end s, with w = 1 − t:
//! quadratic `(w² D_r + t² D_s) + 2 w t D_e`, cubic `(w³ D_r + t³ D_s) + 3 w t (w D_e + t D_f)`, from the owner's entries alone. Elsewhere all
//! control points count, weighted by b_r = x + z/3, b_(r+1) = y + z/3, b_(r+2) = z/3, so that both sides of a spoke agree.

use super::TrianglePatches;
use super::net::PositionNet;
use crate::direction::round_up;
use crate::mesh::{POSITION_ERROR, vector_entry};
use crate::surface::uniform;
use crate::{Surface, SurfaceTables};
use encase::ShaderType;
use glam::DVec3;

/// Base, 5 differences, 6 normals, mean normal.
const ENTRIES_OF_QUADRATIC: u32 = 13;
/// Base, 9 differences, 6 normals, mean normal.
const ENTRIES_OF_CUBIC: u32 = 17;
/// Owner of the edge, owner of the corner, size, deviation.
#[cfg(test)]
const WORDS_OF_HALF_EDGE: usize = 4;

/// The uniform `surface`.
#[derive(ShaderType)]
struct TrianglePatchParams {
    faces: u32,
    /// Entries of `surface_a` a face.
    entries: u32,
    /// The rounding error of a position, from above.
    margin: f32,
}

/// The tables for positions relative to `origin`.
pub fn tables(patches: &TrianglePatches, origin: DVec3) -> SurfaceTables {
    let (low, high) = patches.bounding_box();
    let largest = (low - origin).abs().max((high - origin).abs()).max_element();
    let params = TrianglePatchParams {
        faces: patches.topology.face_count(),
        entries: entries_of(patches),
        margin: round_up(POSITION_ERROR * largest),
    };
    SurfaceTables {
        params: uniform(&params),
        a: patch_floats(patches, origin).collect(),
        b: half_edge_words(patches).collect(),
        heights: None,
        height_bounds: None,
    }
}

/// Entries of `surface_a` a face.
pub fn entries_of(patches: &TrianglePatches) -> u32 {
    match patches.positions.first() {
        Some(PositionNet::Cubic(_)) => ENTRIES_OF_CUBIC,
        _ => ENTRIES_OF_QUADRATIC,
    }
}

fn patch_floats(patches: &TrianglePatches, origin: DVec3) -> impl Iterator<Item = f32> {
    let normals = patches.normals.iter().zip(&patches.mean_normals);
    patches
        .positions
        .iter()
        .zip(normals)
        .flat_map(move |(net, (normal, &mean))| {
            let controls = net.controls();
            let base = controls[0];
            let differences = controls[1..].iter().map(|&control| control - base);
            let normals = [normal.corners, normal.edges].concat();
            let entries: Vec<DVec3> = [base - origin]
                .into_iter()
                .chain(differences)
                .chain(normals)
                .chain([mean])
                .collect();
            entries.into_iter().flat_map(vector_entry)
        })
}

fn half_edge_words(patches: &TrianglePatches) -> impl Iterator<Item = u32> {
    let topology = &patches.topology;
    topology.roots().zip(&patches.bounds).flat_map(|(root, bound)| {
        let edge = topology.half_edge_owner(root.face, root.root);
        let corner = super::corner_owner(topology, root.face, root.root);
        let [size, deviation] = [bound.size, bound.deviation].map(|bound| round_up(bound).to_bits());
        let [edge, corner] = [edge, corner].map(|owner| topology.half_edge_index(owner.face, owner.root));
        [edge, corner, size, deviation]
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{CornerAttributes, CornerNormals, PolygonMesh};

    #[test]
    fn tables_have_the_documented_lengths_and_begin_with_the_base() {
        let mesh = PolygonMesh {
            positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(1.0, 1.0, 1.0)],
            faces: [[0, 1, 2], [2, 1, 3]].into_iter().collect(),
            corners: CornerAttributes::default(),
        };
        let origin = DVec3::new(0.0, -2.0, 0.0);
        let cubic = TrianglePatches::point_normal(&mesh, CornerNormals::AngleWeighted).expect("a surface");
        let quadratic = TrianglePatches::butterfly(&mesh).expect("a surface");
        for (patches, entries) in [(&cubic, ENTRIES_OF_CUBIC), (&quadratic, ENTRIES_OF_QUADRATIC)] {
            let tables = patches.tables(origin);
            assert_eq!(tables.a.len(), 2 * 4 * entries as usize);
            assert_eq!(tables.b.len(), 6 * WORDS_OF_HALF_EDGE);
            assert_eq!(tables.a[..8], [0.0, 2.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
            // The edge between vertices 1 and 2 is root 1 of the first face, and vertex 2 its corner 2.
            assert_eq!(tables.b[3 * WORDS_OF_HALF_EDGE..][..2], [1, 2]);
        }
    }
}
