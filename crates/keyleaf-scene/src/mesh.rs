//! PROVISIONAL The meshes that importers make and surfaces are made of.

use glam::DVec3;



/// Polygons as lists of vertices, flat.
///
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
        self.first_corner(face).map(|first| &self.corners[first..self.ends[face]])
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
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolygonMesh {
    /// A position a vertex.
    pub positions: Vec<DVec3>,
    /// The polygons.
    pub faces: Faces,
    /// Attributes of their corners.
    pub corners: CornerAttributes,
}

