//! What subdivision surfaces are made of: a mesh of polygons with sharpness.

use crate::PolygonMesh;

/// From this sharpness on an edge or a vertex stays sharp for ever (OpenSubdiv's convention).
pub const INFINITE_SHARPNESS: f64 = 10.0;

/// An edge that stays sharp for some steps of subdivision (DeRose, Kass and Truong 1998).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crease {
    /// The ends of the edge, in any order.
    pub vertices: [u32; 2],
    /// How many steps it stays sharp, 0 to [`INFINITE_SHARPNESS`]; a fraction blends in the last step. More counts as for ever.
    pub sharpness: f64,
}

/// A vertex that stays sharp for some steps of subdivision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// The vertex.
    pub vertex: u32,
    /// As of a [`Crease`].
    pub sharpness: f64,
}

/// What becomes of the boundary of a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BoundaryRule {
    /// Faces at a boundary vertex are only control data, also where boundary edges are tagged sharp: the surface ends before them.
    None,
    /// Boundary edges are sharp: their limit is a cubic B-spline curve.
    #[default]
    Edges,
    /// Boundary edges are sharp, and so are boundary vertices with one face.
    EdgesAndCorners,
}

/// How the sharpness of a crease falls from step to step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Creasing {
    /// By one.
    #[default]
    Uniform,
    /// By one from an average with the neighbours along the crease (Chaikin's corner cutting).
    Chaikin,
}

/// A control mesh, also called cage: polygons, and where they are sharp.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ControlMesh {
    /// The polygons.
    pub mesh: PolygonMesh,
    /// Sharp edges.
    pub creases: Vec<Crease>,
    /// Sharp vertices.
    pub corners: Vec<Corner>,
    /// The rule for boundaries.
    pub boundary: BoundaryRule,
    /// The rule for creases.
    pub creasing: Creasing,
}

impl From<PolygonMesh> for ControlMesh {
    /// A smooth control mesh with boundaries by [`BoundaryRule::Edges`].
    fn from(mesh: PolygonMesh) -> Self {
        Self {
            mesh,
            ..Self::default()
        }
    }
}
