//! What makes a list of polygons no surface.

use thiserror::Error;

/// Why a list of polygons cannot be refined. Faces, corners and vertices are counted from 0.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum TopologyError {
    /// There is no face at all.
    #[error("the mesh has no faces")]
    Empty,
    /// A polygon needs three corners.
    #[error("face {face} has {corners} corner(s); a polygon needs at least 3")]
    TooFewCorners {
        /// The face.
        face: u32,
        /// How many corners it has.
        corners: usize,
    },
    /// A root is stored in 16 bits of a key.
    #[error(
        "face {face} has {corners} corners; at most {} are possible, split it into smaller polygons",
        crate::MAX_CORNERS
    )]
    TooManyCorners {
        /// The face.
        face: u32,
        /// How many corners it has.
        corners: usize,
    },
    /// The tables are addressed with 32 bits.
    #[error(
        "the faces up to face {face} have more than {} corners together; split the mesh",
        super::MAX_HALF_EDGES
    )]
    TooManyHalfEdges {
        /// The face at which the limit is passed.
        face: u32,
    },
    /// A corner refers to a vertex that is not there.
    #[error("corner {corner} of face {face} refers to vertex {vertex}, but there are only {vertex_count} vertices")]
    IndexOutOfRange {
        /// The face.
        face: u32,
        /// The corner of the face.
        corner: u32,
        /// The index found there.
        vertex: u32,
        /// How many vertices the mesh has.
        vertex_count: usize,
    },
    /// A polygon visits a vertex twice.
    #[error("corners {} and {} of face {face} are the same vertex {vertex}", corners[0], corners[1])]
    RepeatedIndex {
        /// The face.
        face: u32,
        /// The two corners of the face.
        corners: [u32; 2],
        /// The vertex at both.
        vertex: u32,
    },
    /// Two faces have the same vertices in the same order, perhaps from another start.
    #[error("faces {} and {} are the same polygon; remove one", faces[0], faces[1])]
    DuplicateFace {
        /// The two faces, the earlier one first.
        faces: [u32; 2],
    },
    /// Three or more faces meet in one edge.
    #[error("the edge between vertices {} and {} is used by {} faces ({}); a surface has at most 2 at an edge",
        vertices[0], vertices[1], faces.len(), listed(faces))]
    NonManifoldEdge {
        /// The ends of the edge, the smaller index first.
        vertices: [u32; 2],
        /// All faces at the edge, ascending.
        faces: Vec<u32>,
    },
    /// Two neighbours run through their common edge in the same direction.
    #[error("faces {} and {} both run from vertex {} to vertex {}; one of them must be turned round",
        faces[0], faces[1], vertices[0], vertices[1])]
    InconsistentWinding {
        /// Start and end of the edge as both faces have it.
        vertices: [u32; 2],
        /// The two faces, the earlier one first.
        faces: [u32; 2],
    },
    /// A pair names a half-edge that is not there.
    #[error("a pair names half-edge {root} of face {face}, but there is no such half-edge")]
    NoSuchHalfEdge {
        /// The face.
        face: u32,
        /// The corner at which the half-edge would start.
        root: u32,
    },
    /// A half-edge is in two pairs.
    #[error("half-edge {root} of face {face} is in two pairs; it can meet only one other")]
    PairedTwice {
        /// The face.
        face: u32,
        /// The corner at which the half-edge starts.
        root: u32,
    },
    /// Both halves of a pair are the same half-edge.
    #[error("half-edge {root} of face {face} is paired with itself")]
    PairedWithItself {
        /// The face.
        face: u32,
        /// The corner at which the half-edge starts.
        root: u32,
    },
}

/// At most eight faces by number, so that a message stays one line.
fn listed(faces: &[u32]) -> String {
    const SHOWN: usize = 8;
    let mut text = faces
        .iter()
        .take(SHOWN)
        .map(u32::to_string)
        .collect::<Vec<_>>()
        .join(", ");
    if faces.len() > SHOWN {
        text.push_str(", …");
    }
    text
}
