//! What makes a control mesh no subdivision surface.

use crate::{MeshError, SettingError};
use keyleaf_key::TopologyError;

/// Why a control mesh has no subdivision surface. Faces, vertices, creases and corners are counted from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SubdivisionError {
    /// The faces do not make up a surface, or a position is not finite.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A setting is out of range.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// A crease is between vertices that no edge joins.
    #[error("crease {crease} is between vertices {} and {}, which no edge joins; name both ends of an edge or remove it", vertices[0], vertices[1])]
    NoSuchEdge {
        /// The crease.
        crease: usize,
        /// Its vertices.
        vertices: [u32; 2],
    },
    /// Two creases name the same edge.
    #[error("creases {} and {} are both between vertices {} and {}; remove one", creases[0], creases[1], vertices[0], vertices[1])]
    DuplicateCrease {
        /// The creases, the earlier one first.
        creases: [usize; 2],
        /// The ends of the edge.
        vertices: [u32; 2],
    },
    /// A corner names a vertex that is not there.
    #[error("corner {corner} refers to vertex {vertex}, but there are only {vertex_count} vertices")]
    NoSuchVertex {
        /// The corner.
        corner: usize,
        /// The vertex it names.
        vertex: u32,
        /// How many vertices there are.
        vertex_count: usize,
    },
    /// Two corners name the same vertex.
    #[error("corners {} and {} are both vertex {vertex}; remove one", corners[0], corners[1])]
    DuplicateCorner {
        /// The corners, the earlier one first.
        corners: [usize; 2],
        /// The vertex.
        vertex: u32,
    },
    /// A sharpness is NaN, infinite or negative.
    #[error("{what} {index} has the sharpness {sharpness}; expected a finite number from 0, 10 stays sharp for ever")]
    Sharpness {
        /// "crease" or "corner".
        what: &'static str,
        /// Which one.
        index: usize,
        /// Its sharpness.
        sharpness: f64,
    },
    /// Loop subdivision refines triangles only.
    #[error(
        "face {face} has {corners} corners, but Loop subdivision needs triangles; triangulate the mesh or use Catmull-Clark"
    )]
    NoTriangle {
        /// The face.
        face: u32,
        /// How many corners it has.
        corners: u32,
    },
    /// The rings of the faces about a vertex, and of the quads of a polygon, grow with the square of their number.
    #[error(
        "{what} {index} has {found} {of}; at most {} are possible in a subdivision surface: divide it among several",
        super::MAX_FAN
    )]
    TooManyAround {
        /// "vertex" or "face".
        what: &'static str,
        /// Which one.
        index: u32,
        /// "faces" or "corners".
        of: &'static str,
        /// How many it has.
        found: u32,
    },
    /// Without a rule for boundaries no face is left.
    #[error(
        "every face touches a boundary, and the boundary rule is none; choose a rule that keeps boundaries, or close the mesh"
    )]
    NothingDrawn,
    /// The control points of all patches do not fit.
    #[error(
        "the surface needs {entries} control points of patches; at most {limit} are possible: choose a smaller isolation than {isolation}"
    )]
    TooManyPatches {
        /// Control points that are needed.
        entries: usize,
        /// How many fit.
        limit: usize,
        /// The isolation that was asked for.
        isolation: u32,
    },
}

impl From<TopologyError> for SubdivisionError {
    fn from(error: TopologyError) -> Self {
        Self::Mesh(error.into())
    }
}
