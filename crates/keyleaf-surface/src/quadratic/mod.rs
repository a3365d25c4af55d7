//! One small Bézier patch a triangle: QAS and PN triangles. Twins of `shaders/surfaces/qas.wgsl` and `pn.wgsl`.
//!
//! # Theory
//!
//! Over every triangle lie two patches, one of positions and one of normals; shading follows the latter, so that the surface looks
//! smooth although its tangent planes jump at edges.
//!
//! - *QAS* (Boubekeur & Schlick 2007): both quadratic, through the limit positions and normals of a subdivision surface at the corners
//!   and the edge middles. With e in the middle of p and q the control point is 2 e − (p + q) / 2. The limit is that of Loop's scheme,
//!   of any surface that can be sampled, or, where the vertices must be kept, an edge middle of the modified Butterfly scheme.
//! - *PN triangles* (Vlachos et al. 2001): a cubic patch from the corners and their normals alone.
//!
//! The published QAS listing repeats two arguments; here edge r lies between the corners r and r + 1.
//!
//! # Practice
//!
//! | file | does |
//! |---|---|
//! | `net` | Bézier triangles in polar form: points, derivatives, hulls |
//! | `fan` | the triangles about a vertex |
//! | `samples`, `loop_limit`, `butterfly` | what quadratic patches interpolate |
//! | `mask` | what of that is a weighted sum of vertices |
//! | `point_normal` | the patches of PN triangles |
//! | `recipe` | how all of it follows from the vertices |
//! | `bound`, `tables` | bounds, and what the GPU reads |
//! | `pose` | what it reads to move |

mod bound;
mod butterfly;
mod error;
mod fan;
mod loop_limit;
mod mask;
mod net;
mod point_normal;
mod pose;
mod recipe;
mod samples;
mod tables;

pub use error::TrianglePatchError;
pub use loop_limit::LoopWeights;
pub use point_normal::CornerNormals;
pub use samples::{LimitSample, LimitSamples};

use crate::direction::{cross_direction, frame_normal};
use crate::mesh::unit_or_up;
use crate::root_bound::RootBound;
use crate::{
    ControlMesh, PolygonMesh, PoseShader, PoseTables, Surface, SurfaceBound, SurfaceFrame, SurfaceTables, diamond,
};
use glam::DVec3;
use keyleaf_key::{HalfEdge, ONE, Place, RootPoint, Site, Topology};
use loop_limit::Rules;
use net::{Barycentric, PositionNet, QuadraticNet};
use recipe::Recipe;

/// The face's parameters u and v as directions: from corner 0 to corner 1, and to corner 2.
const DU: Barycentric = [-1.0, 1.0, 0.0];
const DV: Barycentric = [-1.0, 0.0, 1.0];

/// A normal patch whose value is shorter than this says nothing: opposite normals cancel. As in the WGSL.
const SHORTEST_NORMAL: f64 = 1e-3;

/// A surface of one Bézier patch of positions and one of normals a triangle: QAS or PN triangles.
///
/// It is continuous; its normals are continuous where those that it was made of are. The normal of a frame is that of the normal patch
/// and not exactly at right angles to du and dv; where normals of the patch cancel, it is that of du × dv, and last the face's mean.
/// A point of a mesh edge comes from the patch that owns the edge, a vertex from the owner of the corner.
///
/// GPU memory: 256 bytes a triangle for QAS, 320 for PN triangles. Where the control mesh moves, about 280 more for QAS, 180 for that of
/// the Butterfly scheme, 90 for PN triangles.
///
/// ```
/// use glam::DVec3;
/// use keyleaf_surface::{CornerAttributes, CornerNormals, PolygonMesh, Surface, TrianglePatches};
/// let octahedron = PolygonMesh {
///     positions: vec![DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X, -DVec3::Y, -DVec3::Z],
///     faces: [[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]].into_iter().collect(),
///     corners: CornerAttributes::default(),
/// };
/// let round = TrianglePatches::point_normal(&octahedron, CornerNormals::AngleWeighted)?;
/// let middle = round.frame(round.face_coord(0, 0.5, 0.0)?);
/// assert!((middle.position.length() - 1.0).abs() < 0.12);
/// assert!(middle.normal.angle_between(DVec3::new(1.0, 1.0, 0.0)) < 1e-7);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct TrianglePatches {
    topology: Topology,
    /// By face, all of one kind.
    positions: Vec<PositionNet>,
    normals: Vec<QuadraticNet>,
    mean_normals: Vec<DVec3>,
    /// By half-edge.
    bounds: Vec<RootBound>,
    /// A box of all control points.
    extent: (DVec3, DVec3),
    /// The vertices of the control mesh; none where it was made of samples.
    cage: Vec<DVec3>,
    recipe: Recipe,
}

impl TrianglePatches {
    /// Quadratic patches through samples of a surface over the triangles of a topology (QAS).
    ///
    /// # Errors
    /// [`TrianglePatchError`] if a face is no triangle, or there is not one finite sample a half-edge.
    pub fn quadratic(topology: &Topology, samples: &LimitSamples) -> Result<Self, TrianglePatchError> {
        error::check_triangles(topology)?;
        samples.check(topology)?;
        let nets = recipe::quadratic_nets(topology, samples);
        Ok(Self::of_nets(topology.clone(), nets, Vec::new(), Recipe::Samples))
    }

    /// QAS of the Loop surface of a mesh without sharp edges and vertices: [`LimitSamples::of_loop`].
    ///
    /// # Errors
    /// [`TrianglePatchError`] if the mesh is no surface of triangles, has sharpness, or its faces at the boundary have no surface.
    pub fn of_loop(control: &ControlMesh, weights: LoopWeights) -> Result<Self, TrianglePatchError> {
        let topology = samples::triangles(&control.mesh)?;
        loop_limit::check(control)?;
        let boundary = control.boundary;
        Self::of_recipe(
            topology,
            &control.mesh.positions,
            Recipe::Limit(Rules { boundary, weights }),
        )
    }

    /// QAS through the vertices of a mesh: [`LimitSamples::of_butterfly`].
    ///
    /// # Errors
    /// [`TrianglePatchError`] if the mesh is no surface of triangles.
    pub fn butterfly(mesh: &PolygonMesh) -> Result<Self, TrianglePatchError> {
        Self::of_recipe(samples::triangles(mesh)?, &mesh.positions, Recipe::Butterfly)
    }

    /// PN triangles of a mesh. Where normals differ on both sides of an edge, the edge is the mean of what both say.
    ///
    /// # Errors
    /// [`TrianglePatchError`] if the mesh is no surface of triangles, or normals are to come from the mesh and are absent or not finite.
    pub fn point_normal(mesh: &PolygonMesh, normals: CornerNormals) -> Result<Self, TrianglePatchError> {
        let topology = samples::triangles(mesh)?;
        let given = point_normal::given_normals(&topology, mesh, normals)?;
        Self::of_recipe(topology, &mesh.positions, Recipe::PointNormal(given.into()))
    }

    /// The surface with the vertices of its control mesh elsewhere; `None` if it was made of samples, there are not as many vertices, or one
    /// is not finite. Normals that were given at the corners stay.
    pub fn posed(&self, positions: &[DVec3]) -> Option<Self> {
        let fits = positions.len() == self.cage.len() && positions.iter().all(|p| p.is_finite());
        let made = fits.then(|| Self::of_recipe(self.topology.clone(), positions, self.recipe.clone()));
        let mut posed = made?.ok()?;
        posed.allow_for(std::slice::from_ref(self));
        Some(posed)
    }

    /// Makes the box that of this surface and of others, which are this one posed: what does not change while the control mesh moves.
    pub fn allow_for(&mut self, others: &[Self]) {
        for other in others {
            self.extent = (self.extent.0.min(other.extent.0), self.extent.1.max(other.extent.1));
        }
    }

    /// The vertices of the control mesh; none if the surface was made of samples.
    pub fn control_positions(&self) -> &[DVec3] {
        &self.cage
    }

    fn of_recipe(topology: Topology, positions: &[DVec3], recipe: Recipe) -> Result<Self, TrianglePatchError> {
        let nets = recipe.nets(&topology, positions)?;
        Ok(Self::of_nets(topology, nets, positions.to_vec(), recipe))
    }

    fn of_nets(topology: Topology, nets: Vec<(PositionNet, QuadraticNet)>, cage: Vec<DVec3>, recipe: Recipe) -> Self {
        let mean_normals = nets
            .iter()
            .map(|(positions, normals)| mean_normal(positions, normals))
            .collect();
        let (positions, normals): (Vec<_>, Vec<_>) = nets.into_iter().unzip();
        let bounds = bound::of_roots(&topology, &positions);
        let controls = || positions.iter().flat_map(PositionNet::controls);
        let extent = (
            controls().fold(DVec3::INFINITY, DVec3::min),
            controls().fold(DVec3::NEG_INFINITY, DVec3::max),
        );
        Self {
            topology,
            positions,
            normals,
            mean_normals,
            bounds,
            extent,
            cage,
            recipe,
        }
    }

    /// The face and the barycentric coordinates at which all addresses of a point evaluate its position.
    fn canonical(&self, at: RootPoint) -> (u32, Barycentric) {
        let on = |HalfEdge { face, root }: HalfEdge, t: u32| {
            let (x, y) = (ONE - t, t);
            (face, barycentric(RootPoint { face, root, x, y }))
        };
        match Site::of(&self.topology, at) {
            Site::Vertex { owner, .. } => on(owner, 0),
            Site::Edge { owner, t } => on(owner, t),
            _ => (at.face, barycentric(at)),
        }
    }
}

/// The half-edge from which all faces about a vertex take its position.
fn corner_owner(topology: &Topology, face: u32, root: u32) -> HalfEdge {
    let owner = topology.vertex_owner(topology.vertex(face, root));
    owner.unwrap_or(HalfEdge { face, root })
}

/// Both addresses of a point on a spoke have the same.
fn barycentric(at: RootPoint) -> Barycentric {
    let [x, y, z] = [at.x, at.y, at.z()].map(|weight| f64::from(weight) / f64::from(ONE));
    let mut b = [z / 3.0; 3];
    b[at.root as usize] += x;
    b[(at.root as usize + 1) % 3] += y;
    b
}

/// Of the triangle of the corners; without area, of the normals at them.
fn mean_normal(positions: &PositionNet, normals: &QuadraticNet) -> DVec3 {
    let controls = positions.controls();
    cross_direction(controls[1] - controls[0], controls[2] - controls[0])
        .unwrap_or_else(|| unit_or_up(normals.corners.iter().sum()))
}

impl Surface for TrianglePatches {
    fn topology(&self) -> &Topology {
        &self.topology
    }

    fn point(&self, at: RootPoint) -> DVec3 {
        let (face, b) = self.canonical(at);
        self.positions[face as usize].point(b)
    }

    fn frame(&self, at: RootPoint) -> SurfaceFrame {
        let face = at.face as usize;
        let (net, b) = (&self.positions[face], barycentric(at));
        let [du, dv] = [DU, DV].map(|h| net.derivative(b, h));
        let smooth = self.normals[face].polar(b, b);
        let normal = if smooth.length() > SHORTEST_NORMAL {
            smooth.normalize()
        } else {
            frame_normal(du, dv, net.second_derivative(b, DU, DV), self.mean_normals[face])
        };
        SurfaceFrame {
            position: self.point(at),
            du,
            dv,
            normal,
        }
    }

    fn bound(&self, leaf: &Place) -> SurfaceBound {
        let bound = self.bounds[self.topology.half_edge_index(leaf.face, leaf.root) as usize];
        bound.of_leaf(leaf, self.point(diamond::centre(leaf)), 0.0)
    }

    fn bounding_box(&self) -> (DVec3, DVec3) {
        self.extent
    }

    fn shader(&self) -> &'static str {
        match self.positions.first() {
            Some(PositionNet::Cubic(_)) => "surfaces/pn.wgsl",
            _ => "surfaces/qas.wgsl",
        }
    }

    fn tables(&self, origin: DVec3) -> SurfaceTables {
        tables::tables(self, origin)
    }

    fn pose_shader(&self) -> Option<PoseShader> {
        self.recipe.pose_shader()
    }

    fn pose_tables(&self) -> Option<PoseTables> {
        pose::tables(self)
    }
}
