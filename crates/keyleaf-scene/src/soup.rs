//! The list of polygons that every model reader fills, before it is welded and checked.

use std::path::Path;

use glam::DVec3;

use crate::MAX_COORDINATE;
use crate::error::{FilePlace, ImportError};

/// Polygons with attributes at their corners, as a file states them: nothing is welded, nothing is checked but that
/// coordinates are finite and indices are in range.
#[derive(Debug, Default)]
pub(crate) struct Soup {
    /// Positions of the vertices.
    pub positions: Vec<DVec3>,
    /// Vertex of each corner, face after face.
    pub corners: Vec<u32>,
    /// End of each face in `corners`.
    pub ends: Vec<u32>,
    /// Texture coordinates of each corner (v = 0 is the bottom of the picture); empty if there are none.
    pub uvs: Vec<[f32; 2]>,
    /// Unit normal of each corner; empty if there are none.
    pub normals: Vec<[f32; 3]>,
    /// Linear RGBA of each corner; empty if there are none.
    pub colours: Vec<[f32; 4]>,
    /// Covariance of each vertex (xx, xy, xz, yy, yz, zz); empty if there are none.
    pub covariances: Vec<[f64; 6]>,
    /// Material of each face; empty if all faces have material 0.
    pub materials: Vec<u32>,
    /// Line of each face; empty if the format has no lines.
    pub lines: Vec<u32>,
    /// Whether equal indices in the file mean topology (OBJ, PLY, OFF), or are an accident of storage (STL, glTF).
    pub states_topology: bool,
}

impl Soup {
    /// How many faces there are.
    pub fn face_count(&self) -> usize {
        self.ends.len()
    }

    /// The corners of a face, as a range in [`Self::corners`].
    pub fn face(&self, face: usize) -> std::ops::Range<usize> {
        let first = if face == 0 { 0 } else { self.ends[face - 1] as usize };
        first..self.ends[face] as usize
    }

    /// Where a face stands in the file.
    pub fn place_of_face(&self, face: usize) -> FilePlace {
        match self.lines.get(face) {
            Some(&line) => FilePlace::Line(line as usize),
            None => FilePlace::Face(face),
        }
    }
}

/// Refuses numbers that are not finite or too large for f32 arithmetic on the GPU. `what` names the numbers.
pub(crate) fn check_finite(
    file: &Path,
    place: impl Fn() -> FilePlace,
    what: &'static str,
    values: &[f64],
) -> Result<(), ImportError> {
    let is_small = |value: &&f64| value.abs() <= MAX_COORDINATE;
    match values.iter().find(|value| !is_small(value)) {
        None => Ok(()),
        Some(&value) => Err(ImportError::NotFinite {
            file: file.to_path_buf(),
            place: place(),
            what,
            value,
        }),
    }
}

/// A normal scaled to length 1; zero if it has none.
pub(crate) fn unit(normal: DVec3) -> [f32; 3] {
    normal.normalize_or_zero().as_vec3().to_array()
}

/// Linear value of an sRGB-encoded one, both 0..1 (IEC 61966-2-1).
pub(crate) fn linear_from_srgb(value: f32) -> f32 {
    if value <= 0.040_45 {
        value / 12.92
    } else {
        ((value + 0.055) / 1.055).powf(2.4)
    }
}
