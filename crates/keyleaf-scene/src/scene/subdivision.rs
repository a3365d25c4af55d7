//! Shapes whose polygons are control meshes: subdivision surfaces, and patches of triangles.

use keyleaf_surface::{BoundaryRule, Creasing};
use serde::{Deserialize, Serialize};

/// A Catmull-Clark surface.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SubdivisionShape {
    /// How often the faces about extraordinary vertices are subdivided before a patch takes their place; 0..=16, default 8.
    pub isolation: u32,
    /// Boundaries, creases and corners, besides what the model's file says.
    pub sharpness: Sharpness,
}

impl Default for SubdivisionShape {
    fn default() -> Self {
        Self {
            isolation: ISOLATION,
            sharpness: Sharpness::default(),
        }
    }
}

/// A Loop surface. The control mesh has only triangles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LoopShape {
    /// See [`SubdivisionShape::isolation`]; 0..=16, default 8.
    pub isolation: u32,
    /// Weights of the vertices. Default `Loop`.
    pub weights: LoopWeights,
    /// See [`SubdivisionShape::sharpness`].
    pub sharpness: Sharpness,
}

impl Default for LoopShape {
    fn default() -> Self {
        Self {
            isolation: ISOLATION,
            weights: LoopWeights::default(),
            sharpness: Sharpness::default(),
        }
    }
}

/// Weights of Loop's scheme at vertices. They differ at valences other than 3 and 6.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum LoopWeights {
    /// Loop 1987.
    #[default]
    Loop,
    /// Warren 1995: 3/(8n), and 3/16 at valence 3.
    Warren,
}

/// Quadratic approximation of a Loop surface (Boubekeur and Schlick 2007): a quadratic patch a triangle. Only the approximating variant
/// knows creases and corners, those of the model's file.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct QasShape {
    /// What is approximated. Default `Approximating`.
    pub variant: QasVariant,
}

/// What the patches of a [`QasShape`] agree with at corners and middles of edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum QasVariant {
    /// The limit of Loop's scheme: smooth, inside the control mesh.
    #[default]
    Approximating,
    /// The limit of the modified butterfly scheme: through the vertices of the control mesh.
    Interpolating,
}

/// A Gaussian-product subdivision surface (Komar 2020): each vertex has a covariance, which says in which directions the surface
/// may leave it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct GaussianShape {
    /// The scheme behind it. Default `CatmullClark`.
    pub scheme: GaussianScheme,
    /// Where the covariances come from. Default `FromFile`.
    pub covariances: Covariances,
    /// See [`SubdivisionShape::isolation`]; 0..=16, default 8.
    pub isolation: u32,
    /// Whether covariances that are not positive definite, or too flat, are refused; else they are made rounder. Default false.
    pub strict: bool,
    /// How the matrices are inverted. Default `Ldlt`.
    pub solver: Solver,
    /// See [`SubdivisionShape::sharpness`].
    pub sharpness: Sharpness,
}

impl Default for GaussianShape {
    fn default() -> Self {
        Self {
            scheme: GaussianScheme::default(),
            covariances: Covariances::default(),
            isolation: ISOLATION,
            strict: false,
            solver: Solver::default(),
            sharpness: Sharpness::default(),
        }
    }
}

/// The linear scheme behind a Gaussian-product surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum GaussianScheme {
    /// Any polygons.
    #[default]
    CatmullClark,
    /// Triangles, with [`LoopWeights::Loop`].
    Loop,
    /// Triangles, with [`LoopWeights::Warren`].
    LoopWarren,
}

/// Where the covariances of a Gaussian-product surface come from.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub enum Covariances {
    /// The model's file (.off with six numbers more a vertex), else the file of the same name that ends in `.cov`.
    #[default]
    FromFile,
    /// A `.cov` file, relative to the scene's folder; its format: [`crate::read_covariances`].
    File(String),
    /// Balls whose standard deviation is this part of the mean length of all edges, 1e-6 to 1e6: the surface of the linear scheme.
    Isotropic(f64),
    /// Ellipsoids that follow the faces about a vertex: flat in a plane, long along an edge, small and round at a corner.
    FromNormals(NormalCovariances),
}

/// Ellipsoids that follow the faces about a vertex.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct NormalCovariances {
    /// Standard deviation along the surface in mean lengths of the edges, 1e-6 to 1e6; default 0.5.
    pub factor: f64,
    /// Standard deviation across the surface over that along it, 0.001 to 1; default 0.1.
    pub flatness: f64,
}

impl Default for NormalCovariances {
    fn default() -> Self {
        Self {
            factor: 0.5,
            flatness: 0.1,
        }
    }
}

/// How the matrices of a Gaussian-product surface are inverted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Solver {
    /// LDLᵀ, the largest pivot first.
    #[default]
    Ldlt,
    /// The adjugate over the determinant, as Komar has it: to compare with.
    Adjugate,
}

/// Where a control mesh is sharp, besides what the tags of its file say.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Sharpness {
    /// What becomes of boundaries; default `None`: as the file says, else `Edges`.
    pub boundary: Option<Boundary>,
    /// How sharpness falls from step to step; default `None`: as the file says, else `Uniform`.
    pub creasing: Option<CreaseMethod>,
    /// Sharp edges: two vertices, counted from 0, and the sharpness, at least 0. From 10 on they are sharp for ever; 0 makes an edge
    /// smooth that the file calls sharp.
    pub creases: Vec<(u32, u32, f64)>,
    /// Sharp vertices, each with its sharpness.
    pub corners: Vec<(u32, f64)>,
}

/// What becomes of the boundary of a control mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Boundary {
    /// Faces at the boundary are only control data: the surface ends before them.
    NotDrawn,
    /// Boundaries become smooth curves.
    Edges,
    /// Boundaries become curves that end sharply at vertices with one face.
    EdgesAndCorners,
}

impl From<Boundary> for BoundaryRule {
    fn from(boundary: Boundary) -> Self {
        match boundary {
            Boundary::NotDrawn => Self::None,
            Boundary::Edges => Self::Edges,
            Boundary::EdgesAndCorners => Self::EdgesAndCorners,
        }
    }
}

/// How the sharpness of a crease falls from step to step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum CreaseMethod {
    /// By one.
    Uniform,
    /// By one from an average with the neighbours along the crease.
    Chaikin,
}

impl From<CreaseMethod> for Creasing {
    fn from(method: CreaseMethod) -> Self {
        match method {
            CreaseMethod::Uniform => Self::Uniform,
            CreaseMethod::Chaikin => Self::Chaikin,
        }
    }
}

/// The isolation of a scene that gives none.
const ISOLATION: u32 = 8;
