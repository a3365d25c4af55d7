//! Creases and corners of a control mesh: whether its edges and vertices are there, and which of two statements counts.

use std::collections::{HashMap, HashSet};
use std::path::Path;

use keyleaf_surface::{ControlMesh, Corner, Crease, PolygonMesh};

use crate::error::{FilePlace, ImportError};

/// A statement of a file, with its place.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Placed<T> {
    pub value: T,
    pub place: FilePlace,
}

/// Adds creases, of which a later one of the same edge takes the place of an earlier one. Without sharpness an edge is smooth.
pub(crate) fn add_creases(
    file: &Path,
    control: &mut ControlMesh,
    creases: impl IntoIterator<Item = Placed<Crease>>,
) -> Result<(), ImportError> {
    let mut creases = creases.into_iter().peekable();
    if creases.peek().is_none() {
        return Ok(());
    }
    let edges = edges(&control.mesh);
    let mut known: HashMap<[u32; 2], usize> = control
        .creases
        .iter()
        .enumerate()
        .map(|(index, crease)| (sorted(crease.vertices), index))
        .collect();
    for Placed { value, place } in creases {
        let edge = sorted(value.vertices);
        if !edges.contains(&edge) {
            let [a, b] = value.vertices;
            let reason = format!("the crease from vertex {a} to vertex {b}, counted from 0, is no edge of the mesh");
            return Err(ImportError::malformed(file, place, reason));
        }
        let index = *known.entry(edge).or_insert_with(|| {
            control.creases.push(value);
            control.creases.len() - 1
        });
        control.creases[index] = value;
    }
    control.creases.retain(|crease| crease.sharpness > 0.0);
    Ok(())
}

/// Adds corners, of which a later one of the same vertex takes the place of an earlier one.
pub(crate) fn add_corners(
    file: &Path,
    control: &mut ControlMesh,
    corners: impl IntoIterator<Item = Placed<Corner>>,
) -> Result<(), ImportError> {
    let mut known: HashMap<u32, usize> = control
        .corners
        .iter()
        .enumerate()
        .map(|(index, corner)| (corner.vertex, index))
        .collect();
    let count = control.mesh.positions.len();
    for Placed { value, place } in corners {
        if value.vertex as usize >= count {
            return Err(ImportError::IndexOutOfRange {
                file: file.to_path_buf(),
                place,
                what: "vertex of a corner, counted from 0,",
                index: value.vertex.into(),
                count,
            });
        }
        let index = *known.entry(value.vertex).or_insert_with(|| {
            control.corners.push(value);
            control.corners.len() - 1
        });
        control.corners[index] = value;
    }
    control.corners.retain(|corner| corner.sharpness > 0.0);
    Ok(())
}

fn edges(mesh: &PolygonMesh) -> HashSet<[u32; 2]> {
    let of_face = |face: &[u32]| -> Vec<[u32; 2]> {
        let next = face.iter().cycle().skip(1);
        face.iter().zip(next).map(|(&a, &b)| sorted([a, b])).collect()
    };
    mesh.faces.iter().flat_map(of_face).collect()
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}
