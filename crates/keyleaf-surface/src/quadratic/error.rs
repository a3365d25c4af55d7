//! Why triangle patches could not be made.

use crate::MeshError;
use keyleaf_key::Topology;

/// Why a mesh has no triangle patches. Faces and corners are counted from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TrianglePatchError {
    /// The mesh is no surface.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// Patches lie over triangles.
    #[error("face {face} has {corners} corners; expected triangles: triangulate the mesh")]
    NotATriangle {
        /// The face.
        face: u32,
        /// How many corners it has.
        corners: u32,
    },
    /// The limit masks are those of smooth meshes.
    #[error(
        "the mesh has sharp edges or vertices, which the limit masks do not know; sample its Loop surface (LimitSamples::of_surface)"
    )]
    Sharp,
    /// With [`BoundaryRule::None`](crate::BoundaryRule::None) faces at the boundary have no surface.
    #[error(
        "the boundary rule is \"none\", which leaves the faces at the boundary without a surface; expected \"edges\" or \"edges and corners\""
    )]
    NoBoundary,
    /// There is not one sample a half-edge.
    #[error("the mesh has {half_edges} half-edges, but there are {found} samples of {what}; expected one a half-edge")]
    SampleCount {
        /// "corners" or "edges".
        what: &'static str,
        /// Half-edges of the mesh.
        half_edges: u32,
        /// Samples that were given.
        found: usize,
    },
    /// A sample is NaN, infinite or too large.
    #[error("the sample of half-edge {root} of face {face} ({what}) is not finite or larger than 1e16")]
    Sample {
        /// "corners" or "edges".
        what: &'static str,
        /// The face.
        face: u32,
        /// The half-edge.
        root: u32,
    },
    /// Normals were to come from the mesh, but it has none.
    #[error("the mesh has no normals at its corners; compute them from its faces instead")]
    NoNormals,
    /// A normal is NaN or infinite.
    #[error("corner {corner} of face {face} has a normal that is not finite")]
    Normal {
        /// The face.
        face: u32,
        /// The corner of that face.
        corner: u32,
    },
}

/// An error unless all faces are triangles.
pub fn check_triangles(topology: &Topology) -> Result<(), TrianglePatchError> {
    let corners = |face: u32| topology.corner_count(face);
    match (0..topology.face_count()).find(|&face| corners(face) != 3) {
        None => Ok(()),
        Some(face) => Err(TrianglePatchError::NotATriangle {
            face,
            corners: corners(face),
        }),
    }
}
