//! The meshes that importers make and surfaces are made of.

use crate::MeshError;
use glam::DVec3;
use keyleaf_key::Topology;

/// Coordinates beyond this overflow in f32 arithmetic such as squared lengths of scaled models.
const LARGEST_COORDINATE: f64 = 1e15;

/// Texture coordinates beyond this have no fraction left in f32.
const LARGEST_TEXTURE_COORDINATE: f32 = 65_536.0;

/// Polygons as lists of vertices, flat.
///
/// ```
/// use keyleaf_surface::Faces;
/// let faces: Faces = [vec![0, 1, 2], vec![2, 1, 3, 4]].into_iter().collect();
/// assert_eq!((faces.len(), faces.corner_count()), (2, 7));
/// assert_eq!(faces.get(1), Some(&[2, 1, 3, 4][..]));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Faces {
    corners: Vec<u32>,
    ends: Vec<usize>,
}

impl Faces {
    /// No faces.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a face with these vertices, counter-clockwise seen from outside.
    pub fn push(&mut self, vertices: &[u32]) {
        self.corners.extend_from_slice(vertices);
        self.ends.push(self.corners.len());
    }

    /// How many faces there are.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The corners of all faces together.
    pub fn corner_count(&self) -> usize {
        self.corners.len()
    }

    /// The index of a face's first corner among all corners.
    pub fn first_corner(&self, face: usize) -> Option<usize> {
        (face < self.len()).then(|| if face == 0 { 0 } else { self.ends[face - 1] })
    }

    /// The vertices of a face.
    pub fn get(&self, face: usize) -> Option<&[u32]> {
        self.first_corner(face)
            .map(|first| &self.corners[first..self.ends[face]])
    }

    /// The vertices of every face.
    pub fn iter(&self) -> impl Iterator<Item = &[u32]> {
        (0..self.len()).filter_map(|face| self.get(face))
    }
}

impl<F: AsRef<[u32]>> FromIterator<F> for Faces {
    fn from_iter<I: IntoIterator<Item = F>>(faces: I) -> Self {
        let mut all = Self::new();
        faces.into_iter().for_each(|face| all.push(face.as_ref()));
        all
    }
}

/// What corners of faces have besides their vertex: one value a corner, in the order of the faces.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CornerAttributes {
    /// Texture coordinates; v grows upwards, (0, 0) is the lower left corner of the picture.
    pub uvs: Option<Vec<[f32; 2]>>,
    /// Normals for shading.
    pub normals: Option<Vec<[f32; 3]>>,
    /// Colours, linear RGBA.
    pub colours: Option<Vec<[f32; 4]>>,
}

/// A mesh of polygons. Faces that meet share vertices: equal positions are welded before.
///
/// ```
/// use glam::DVec3;
/// use keyleaf_surface::{CornerAttributes, Mesh, PolygonMesh, Surface};
/// let triangle = PolygonMesh {
///     positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
///     faces: [[0, 1, 2]].into_iter().collect(),
///     corners: CornerAttributes::default(),
/// };
/// let surface = Mesh::new(&triangle)?;
/// let middle = surface.face_coord(0, 0.5, 0.5).expect("in the triangle");
/// assert_eq!(surface.point(middle), DVec3::new(0.5, 0.5, 0.0));
/// # Ok::<(), keyleaf_surface::MeshError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolygonMesh {
    /// A position a vertex.
    pub positions: Vec<DVec3>,
    /// The polygons.
    pub faces: Faces,
    /// Attributes of their corners.
    pub corners: CornerAttributes,
}

impl PolygonMesh {
    /// How the faces meet, if they make up a surface with finite positions and complete attributes.
    ///
    /// # Errors
    /// [`MeshError`] naming the vertex, face or attribute.
    pub fn topology(&self) -> Result<Topology, MeshError> {
        let topology = Topology::new(self.positions.len(), self.faces.iter())?;
        for (vertex, &DVec3 { x, y, z }) in self.positions.iter().enumerate() {
            let is_small = [x, y, z].iter().all(|c| c.abs() <= LARGEST_COORDINATE);
            if !is_small {
                return Err(MeshError::Position { vertex, x, y, z });
            }
        }
        self.check_attributes()?;
        Ok(topology)
    }

    fn check_attributes(&self) -> Result<(), MeshError> {
        let corners = self.faces.corner_count();
        let counts = [
            ("texture coordinates", self.corners.uvs.as_ref().map(Vec::len)),
            ("normals", self.corners.normals.as_ref().map(Vec::len)),
            ("colours", self.corners.colours.as_ref().map(Vec::len)),
        ];
        for (attribute, found) in counts {
            if let Some(found) = found.filter(|&found| found != corners) {
                return Err(MeshError::AttributeCount {
                    attribute,
                    corners,
                    found,
                });
            }
        }
        let Some(uvs) = &self.corners.uvs else { return Ok(()) };
        let is_small = |c: &f32| c.abs() <= LARGEST_TEXTURE_COORDINATE;
        match uvs.iter().position(|uv| !uv.iter().all(is_small)) {
            None => Ok(()),
            Some(index) => {
                let face = self.faces.ends.partition_point(|&end| end <= index);
                let corner = index - self.faces.first_corner(face).unwrap_or(0);
                let [u, v] = uvs[index];
                Err(MeshError::TextureCoordinate {
                    face: face as u32,
                    corner: corner as u32,
                    u,
                    v,
                })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quad(uvs: Option<Vec<[f32; 2]>>) -> PolygonMesh {
        PolygonMesh {
            positions: vec![DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y],
            faces: [[0, 1, 2], [2, 3, 0]].into_iter().collect(),
            corners: CornerAttributes {
                uvs,
                ..CornerAttributes::default()
            },
        }
    }

    #[test]
    fn bad_positions_and_attributes_are_named() {
        let mut mesh = quad(None);
        mesh.positions[2].y = f64::NAN;
        assert!(matches!(mesh.topology(), Err(MeshError::Position { vertex: 2, .. })));
        mesh.positions[2].y = 1e38;
        assert!(matches!(mesh.topology(), Err(MeshError::Position { vertex: 2, .. })));
        assert!(matches!(
            quad(Some(vec![[0.0; 2]; 5])).topology(),
            Err(MeshError::AttributeCount {
                corners: 6,
                found: 5,
                ..
            })
        ));
        let mut uvs = vec![[0.0; 2]; 6];
        uvs[4][1] = f32::INFINITY;
        assert!(matches!(
            quad(Some(uvs)).topology(),
            Err(MeshError::TextureCoordinate { face: 1, corner: 1, .. })
        ));
        assert!(matches!(PolygonMesh::default().topology(), Err(MeshError::Topology(_))));
        assert!(quad(Some(vec![[0.5; 2]; 6])).topology().is_ok());
    }
}
