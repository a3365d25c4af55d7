//! Which half-edges of a polygon mesh meet: all that the neighbours of a node need to know about the mesh.

mod adjacency;
mod error;
mod glue;

pub use error::TopologyError;

use crate::{MAX_CORNERS, Place};

/// The most half-edges (corners of all faces together) of one mesh, so that [`Topology::gpu_words`] has 32-bit addresses.
pub const MAX_HALF_EDGES: usize = 1 << 30;

/// Stands for "none" in [`Topology::gpu_words`].
const NONE: u32 = u32::MAX;

/// The directed edge of a face from corner `root` to the next corner: the hypotenuse of root `root`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct HalfEdge {
    /// The face, counted from 0.
    pub face: u32,
    /// The corner at which the half-edge starts, and the root whose hypotenuse it is.
    pub root: u32,
}

/// The adjacency of a mesh of polygons with any number of corners, from 3 to [`MAX_CORNERS`], mixed as they come.
///
/// Edges with one face are boundaries. Faces that touch in a vertex only, vertices without faces and two faces back to back
/// are fine. Memory: 12 bytes a half-edge, 4 a face, 4 a vertex.
///
/// ```
/// use keyleaf_key::{HalfEdge, Topology, TopologyError};
/// let two_triangles = Topology::new(4, [[0, 1, 2], [2, 1, 3]])?;
/// assert_eq!(two_triangles.twin(0, 1), Some(HalfEdge { face: 1, root: 0 }));
/// assert_eq!(two_triangles.twin(0, 0), None);
///
/// let turned = Topology::new(4, [[0, 1, 2], [1, 2, 3]]);
/// assert_eq!(turned, Err(TopologyError::InconsistentWinding { vertices: [1, 2], faces: [0, 1] }));
/// # Ok::<(), TopologyError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Topology {
    /// First half-edge of every face, and the number of half-edges: F + 1 entries.
    face_first: Vec<u32>,
    /// Start vertex of every half-edge.
    vertices: Vec<u32>,
    /// Twin of every half-edge.
    twins: Vec<Option<HalfEdge>>,
    /// The first half-edge that starts at each vertex.
    vertex_owners: Vec<Option<HalfEdge>>,
}

impl Topology {
    /// The adjacency of `faces`, each the list of its vertices, counter-clockwise seen from outside.
    ///
    /// # Errors
    /// [`TopologyError`] names the first face that is malformed; of well-formed faces that do not form an oriented surface,
    /// the edge with the smallest vertex indices.
    pub fn new<F: AsRef<[u32]>>(
        vertex_count: usize,
        faces: impl IntoIterator<Item = F>,
    ) -> Result<Self, TopologyError> {
        let (mut face_first, mut vertices) = (vec![0], Vec::new());
        let mut seen = adjacency::CornerOfVertex::new(vertex_count);
        for (face, corners) in (0..NONE).zip(faces) {
            let corners = corners.as_ref();
            seen.check(face, corners)?;
            vertices.extend_from_slice(corners);
            if vertices.len() > MAX_HALF_EDGES {
                return Err(TopologyError::TooManyHalfEdges { face });
            }
            face_first.push(vertices.len() as u32);
        }
        if vertices.is_empty() {
            return Err(TopologyError::Empty);
        }
        let half_edges = adjacency::half_edges(&face_first);
        let twins = adjacency::twins(&half_edges, &face_first, &vertices)?;
        let vertex_owners = adjacency::vertex_owners(vertex_count, &half_edges, &vertices);
        Ok(Self {
            face_first,
            vertices,
            twins,
            vertex_owners,
        })
    }

    /// The adjacency of faces with these numbers of corners whose half-edges meet in `pairs`, for surfaces whose boundaries are
    /// joined without common vertices. The half-edges of a pair run against each other: the start of one is the end of the other.
    ///
    /// Vertices are derived: corners are one vertex when pairs connect them, and vertices are numbered by their first corner. A face
    /// may meet itself, so that a vertex may be at several of its corners.
    ///
    /// ```
    /// use keyleaf_key::{HalfEdge, Topology, TopologyError};
    /// let side = |root| HalfEdge { face: 0, root };
    /// let torus = Topology::glued([4], [[side(0), side(2)], [side(1), side(3)]])?;
    /// assert_eq!((torus.vertex_count(), torus.twin(0, 3)), (1, Some(side(1))));
    /// # Ok::<(), TopologyError>(())
    /// ```
    ///
    /// # Errors
    /// [`TopologyError`] names the first face whose number of corners is impossible, or the half-edge of the first pair that does not
    /// exist, is paired with itself, or is in two pairs.
    pub fn glued(
        corner_counts: impl IntoIterator<Item = u32>,
        pairs: impl IntoIterator<Item = [HalfEdge; 2]>,
    ) -> Result<Self, TopologyError> {
        let mut face_first = vec![0];
        let mut half_edge_count = 0;
        for (face, corners) in (0..NONE).zip(corner_counts) {
            adjacency::check_corner_count(face, corners as usize)?;
            half_edge_count += corners as usize;
            if half_edge_count > MAX_HALF_EDGES {
                return Err(TopologyError::TooManyHalfEdges { face });
            }
            face_first.push(half_edge_count as u32);
        }
        if half_edge_count == 0 {
            return Err(TopologyError::Empty);
        }
        let half_edges = adjacency::half_edges(&face_first);
        let twins = glue::twins(&face_first, pairs)?;
        let (vertices, vertex_count) = glue::vertices(&half_edges, &face_first, &twins);
        let vertex_owners = adjacency::vertex_owners(vertex_count, &half_edges, &vertices);
        Ok(Self {
            face_first,
            vertices,
            twins,
            vertex_owners,
        })
    }

    /// Number of faces.
    pub fn face_count(&self) -> u32 {
        self.face_first.len() as u32 - 1
    }

    /// Number of vertices that the mesh was made with, used or not.
    pub fn vertex_count(&self) -> usize {
        self.vertex_owners.len()
    }

    /// Number of half-edges: of corners, and of roots, of all faces together.
    pub fn half_edge_count(&self) -> u32 {
        self.vertices.len() as u32
    }

    /// Number of corners, and of roots, of a face.
    ///
    /// This and the other questions about a face or a root panic when the mesh does not have it, as slices do:
    /// see [`Topology::has_root`].
    pub fn corner_count(&self, face: u32) -> u32 {
        self.face_first[face as usize + 1] - self.face_first[face as usize]
    }

    /// Whether the mesh has this root.
    pub fn has_root(&self, face: u32, root: u32) -> bool {
        face < self.face_count() && root < self.corner_count(face)
    }

    /// The vertices of a face, by corner.
    pub fn vertices(&self, face: u32) -> &[u32] {
        &self.vertices[self.face_first[face as usize] as usize..self.face_first[face as usize + 1] as usize]
    }

    /// The vertex at a corner of a face.
    pub fn vertex(&self, face: u32, corner: u32) -> u32 {
        self.vertices(face)[corner as usize]
    }

    /// The root whose hypotenuse is the other half of the same mesh edge, none on a boundary.
    pub fn twin(&self, face: u32, root: u32) -> Option<HalfEdge> {
        self.twins[self.half_edge_index(face, root) as usize]
    }

    /// The index of the first half-edge of a face; those of its other corners follow.
    pub fn first_half_edge(&self, face: u32) -> u32 {
        self.face_first[face as usize]
    }

    /// The index of a half-edge among all those of the mesh.
    pub fn half_edge_index(&self, face: u32, root: u32) -> u32 {
        debug_assert!(root < self.corner_count(face));
        self.face_first[face as usize] + root
    }

    /// Of the two half-edges of a mesh edge, the one with the smaller index: it owns what both sides must agree about.
    pub fn half_edge_owner(&self, face: u32, root: u32) -> HalfEdge {
        let this = HalfEdge { face, root };
        self.twin(face, root).map_or(this, |twin| this.min(twin))
    }

    /// The half-edge with the smallest index that starts at a vertex; none when no face uses the vertex.
    pub fn vertex_owner(&self, vertex: u32) -> Option<HalfEdge> {
        self.vertex_owners[vertex as usize]
    }

    /// All roots, as places of level 0, in the order of their half-edges.
    pub fn roots(&self) -> impl Iterator<Item = Place> {
        (0..self.face_count()).flat_map(|face| (0..self.corner_count(face)).map(move |root| Place::of_root(face, root)))
    }

    /// The table that the shaders read: the numbers F of faces and E of half-edges, F + 1 first half-edges, and twin face and
    /// twin root of every half-edge, both `0xffffffff` on a boundary. 3 + F + 2 E words.
    pub fn gpu_words(&self) -> Vec<u32> {
        let mut words = Vec::with_capacity(2 + self.face_first.len() + 2 * self.twins.len());
        words.extend([self.face_count(), self.half_edge_count()]);
        words.extend_from_slice(&self.face_first);
        words.extend(
            self.twins
                .iter()
                .flat_map(|twin| twin.map_or([NONE; 2], |twin| [twin.face, twin.root])),
        );
        words
    }
}

#[cfg(test)]
mod tests;
