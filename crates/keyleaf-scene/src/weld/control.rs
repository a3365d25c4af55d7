//! From the polygons of a file to a control mesh: faces keep their corners, vertices their numbers.
//!
//! A control mesh is not drawn itself, so that its polygons may be concave or bent. Where the file states its topology (OBJ, PLY,
//! OFF), nothing is welded or dropped: creases, covariances and blend shapes count its vertices. In a soup of triangles (STL, glTF) a
//! vertex is there several times, for its normals and texture coordinates: equal positions are welded, and triangles dropped that
//! collapse by it.

use std::path::Path;

use glam::DVec3;
use keyleaf_key::Topology;
use keyleaf_surface::{CornerAttributes, PolygonMesh};

use crate::error::ImportError;
use crate::note::Note;
use crate::soup::Soup;

use super::{Welded, gather, origin_of, tame_uvs, weld_positions, without_collapsed, without_doubled};

/// Makes and checks the control mesh of `file`.
pub(crate) fn weld_control(file: &Path, soup: &Soup, notes: &mut Vec<Note>) -> Result<Welded, ImportError> {
    if soup.face_count() == 0 {
        let reason = format!("the mesh is empty: {} vertices, no faces", soup.positions.len());
        return Err(ImportError::empty(file, reason));
    }
    if soup.states_topology {
        let mut welded = as_stated(file, soup, notes);
        check(file, soup, &mut welded, Some)?;
        return Ok(welded);
    }
    let (vertex_of, distinct) = weld_positions(&soup.positions);
    let vertex = |corner: u32| vertex_of[soup.corners[corner as usize] as usize];
    let (faces, collapsed) = without_collapsed(soup, &vertex);
    let (faces, doubled) = without_doubled(&vertex, faces);
    let (mut welded, _) = gather(soup, &vertex_of, &faces);
    let mut tell = |count: usize, what: &str| {
        if count > 0 {
            notes.push(Note::remark(file, format!("{what}: {count}")));
        }
    };
    tell(
        soup.positions.len() - distinct,
        "vertices welded to one with equal position",
    );
    tell(collapsed, "faces dropped that have fewer than 3 different corners");
    tell(doubled, "faces dropped that are there twice");
    if welded.mesh.faces.is_empty() {
        let reason = "the mesh is empty: all its faces are degenerate";
        return Err(ImportError::empty(file, reason));
    }
    check(file, soup, &mut welded, |face| faces.origin.get(face as usize).copied())?;
    Ok(welded)
}

/// The mesh just as the file has it.
fn as_stated(file: &Path, soup: &Soup, notes: &mut Vec<Note>) -> Welded {
    let (_, distinct) = weld_positions(&soup.positions);
    let doubled = soup.positions.len() - distinct;
    if doubled > 0 {
        let text = format!(
            "vertices with the position of another one: {doubled}; they are not welded, and the surface is open between them"
        );
        notes.push(Note::warning(file, text));
    }
    let corners = CornerAttributes {
        uvs: (!soup.uvs.is_empty()).then(|| soup.uvs.clone()),
        normals: (!soup.normals.is_empty()).then(|| soup.normals.clone()),
        colours: (!soup.colours.is_empty()).then(|| soup.colours.clone()),
    };
    let faces = (0..soup.face_count()).map(|face| &soup.corners[soup.face(face)]);
    let mesh = PolygonMesh {
        positions: soup.positions.iter().map(|&p| p + DVec3::ZERO).collect(),
        faces: faces.collect(),
        corners,
    };
    Welded {
        mesh,
        materials: soup.materials.clone(),
    }
}

/// Moves far texture coordinates, and refuses what is no surface. `origin` gives the face of the soup that a face comes from.
fn check(
    file: &Path,
    soup: &Soup,
    welded: &mut Welded,
    origin: impl Fn(u32) -> Option<u32>,
) -> Result<(), ImportError> {
    if let Some((face, [u, v])) = tame_uvs(&mut welded.mesh) {
        let place = soup.place_of_face(origin(face as u32).unwrap_or(0) as usize);
        let reason = format!("the texture coordinate ({u}, {v}) is too large for its face");
        return Err(ImportError::malformed(file, place, reason));
    }
    Topology::new(welded.mesh.positions.len(), welded.mesh.faces.iter()).map_err(|source| {
        let origin = origin_of(soup, origin, &source);
        ImportError::Topology {
            file: file.to_path_buf(),
            source,
            origin,
        }
    })?;
    Ok(())
}
