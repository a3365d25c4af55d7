//! Catmull-Clark and Loop subdivision surfaces. Twin of `shaders/surfaces/catmull_clark.wgsl` and `loop.wgsl`.
//!
//! # Theory
//!
//! A face with all faces that touch it, its *ring*, determines the limit surface over the face. One step of subdivision gives the rings
//! of its children, as sums of the vertices of the ring; so a face is refined alone. Where the ring of a cell is the control net of a
//! spline (bicubic B-spline, quartic box spline), the cell is a Bézier patch, exactly. Only one child at an extraordinary vertex is
//! not; after `isolation` steps a terminal patch takes its place. So a face is a quadtree of patches (Niessner et al. 2012,
//! *Feature-adaptive GPU rendering of Catmull-Clark subdivision surfaces*; Brainerd et al. 2016, *Efficient GPU rendering of subdivision
//! surfaces using adaptive quadtrees*).
//!
//! Faces whose rings have the same shape and sharpness share the tree; cells of any trees whose rings do share the weights of their
//! children and of their control points. A face has only the list of the vertices of its ring. Of each patch there are the first control
//! point and the differences of the others to it, so that small patches deep in a tree keep their digits.
//!
//! The *domain* of a quad is the unit square, that of a triangle of a Loop surface its barycentric coordinates. Another face of a
//! Catmull-Clark surface has n domains, the quads of the first step: (0, 0) at a corner, (1, 0) in the middle of the edge after it, (1, 1)
//! at the centre, (0, 1) in the middle of the edge before it.
//!
//! # Practice
//!
//! | file | does |
//! |---|---|
//! | `control_mesh`, `error`, `cage` | checks what users give; rings of faces |
//! | `ring`, `sector`, `sharpness`, `stencil` | a ring, its smooth parts, how sharp it is, weighted sums |
//! | `scheme`, `refinement`, `catmull_clark`, `loop_scheme` | rings of children |
//! | `limit` | limits of vertices and their tangents |
//! | `bspline`, `box_spline` | regular cells, evaluated |
//! | `exact`, `cell` | points by local refinement: the truth |
//! | `bicubic`, `quartic`, `spectrum` | patches, regular and terminal |
//! | `shapes`, `tree`, `neighbourhoods` | cells that look alike, trees of them, and which faces share these |
//! | `bezier`, `approximation` | points by patches: what the GPU draws |
//! | `addresses`, `bound`, `tables` | what the GPU reads |
//! | `pose` | what it reads to move |

pub(crate) mod addresses;
pub(crate) mod approximation;
pub(crate) mod bezier;
pub(crate) mod bicubic;
pub(crate) mod bound;
mod box_spline;
mod bspline;
pub(crate) mod cage;
mod catmull_clark;
pub(crate) mod cell;
mod control_mesh;
mod error;
pub(crate) mod exact;
mod limit;
mod loop_scheme;
pub(crate) mod neighbourhoods;
mod pose;
mod quartic;
mod refinement;
mod ring;
mod scheme;
mod sector;
mod shapes;
mod sharpness;
mod spectrum;
pub(crate) mod stencil;
pub(crate) mod tables;
pub(crate) mod tree;

pub use control_mesh::{BoundaryRule, ControlMesh, Corner, Crease, Creasing, INFINITE_SHARPNESS};
pub use error::SubdivisionError;
pub use scheme::SubdivisionScheme;

use crate::direction::frame_normal;
use crate::mesh::unit_or_up;
use crate::root_bound::RootBound;
use crate::{
    ParameterError, PoseShader, PoseTables, SettingError, Surface, SurfaceBound, SurfaceFrame, SurfaceTables,
    coordinate, diamond,
};
use cage::Cage;
use cell::DomainPoint;
use exact::{ExactCells, ExactPoint};
use glam::DVec3;
use keyleaf_key::{HalfEdge, Place, RootPoint, Topology};
use neighbourhoods::{Evaluated, Neighbourhoods};

/// The most control points of patches, for which the tables have room.
pub(crate) const MAX_ENTRIES: usize = 1 << 28;

/// The largest isolation: cells are then 2⁻¹⁶ of a face.
pub(crate) const MAX_ISOLATION: u32 = 16;

/// The most faces about a vertex, and the most corners of a polygon: memory and time grow with their square.
pub(crate) const MAX_FAN: u32 = 1024;

/// How much greater than at their samples the error of terminal patches may be; measured up to 2.5 times at valences to 32.
pub(crate) const BETWEEN_SAMPLES: f64 = 2.5;

/// How a subdivision surface is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SubdivisionSettings {
    /// The rules of refinement.
    pub scheme: SubdivisionScheme,
    /// After how many steps a terminal patch replaces what is left about an extraordinary vertex, 0 to 16. Sharpness is refined until it
    /// is used up in any case.
    pub isolation: u32,
}

impl Default for SubdivisionSettings {
    fn default() -> Self {
        Self {
            scheme: SubdivisionScheme::default(),
            isolation: 8,
        }
    }
}

/// The limit surface of a control mesh.
///
/// [`Surface::point`] and [`Surface::frame`] are those of the limit surface. What is drawn, [`Surface::drawn`], is the same
/// but for terminal patches, see [`terminal_error`](Self::terminal_error). Bounds are of what is drawn, and allow for the difference.
///
/// Faces are those of the control mesh, without those that [`BoundaryRule::None`] leaves out. At a crease or a corner the normal of a frame
/// is that of the face's own side. At extraordinary vertices du and dv only span the tangent plane.
///
/// GPU memory: 256 bytes a bicubic patch, 240 a quartic one, 48 a face, 32 a corner. A regular face is one patch, another one about 3 a
/// step of isolation and extraordinary corner.
///
/// ```
/// use glam::DVec3;
/// use keyleaf_surface::{ControlMesh, CornerAttributes, PolygonMesh, Subdivision, SubdivisionSettings, Surface};
/// let corner = |k: u32| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)) * 2.0 - 1.0;
/// let cube = PolygonMesh {
///     positions: (0..8).map(corner).collect(),
///     faces: [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]].into_iter().collect(),
///     corners: CornerAttributes::default(),
/// };
/// let surface = Subdivision::new(&ControlMesh::from(cube), SubdivisionSettings::default())?;
/// let corner = surface.point(surface.face_coord(0, 0.0, 0.0)?);
/// assert!((corner + DVec3::splat(0.5)).length() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Subdivision {
    scheme: SubdivisionScheme,
    cage: Cage,
    /// Of the faces that are drawn, with a vertex a fan.
    topology: Topology,
    neighbourhoods: Neighbourhoods,
    /// Control points of all patches.
    points: Vec<DVec3>,
    /// Mean normals of the faces.
    normals: Vec<DVec3>,
    /// By half-edge.
    bounds: Vec<RootBound>,
    terminal_error: f64,
    /// A box of all control points of patches.
    extent: (DVec3, DVec3),
    /// Of the limit surface, as far as it was asked for.
    exact: ExactCells<DVec3>,
}

impl Subdivision {
    /// The surface of a control mesh.
    ///
    /// # Errors
    /// [`SubdivisionError`] if the faces make up no surface, a crease or corner names nothing or something twice, a sharpness is no finite
    /// number from 0, a face does not suit the scheme, a vertex has more than 1024 faces or a face as many corners, nothing is left to
    /// draw, the isolation is above 16 or the tables would be too large.
    pub fn new(control: &ControlMesh, settings: SubdivisionSettings) -> Result<Self, SubdivisionError> {
        let SubdivisionSettings { scheme, isolation } = settings;
        let is_possible = isolation <= MAX_ISOLATION;
        SettingError::check("isolation", f64::from(isolation), is_possible, "a number from 0 to 16")?;
        let cage = Cage::new(control, scheme)?;
        let topology = drawn_topology(&cage)?;
        let neighbourhoods = Neighbourhoods::new(&cage, scheme, isolation);
        if neighbourhoods.entries > MAX_ENTRIES {
            return Err(SubdivisionError::TooManyPatches {
                entries: neighbourhoods.entries,
                limit: MAX_ENTRIES,
                isolation,
            });
        }
        let mut surface = Self {
            scheme,
            cage,
            neighbourhoods,
            points: Vec::new(),
            normals: Vec::new(),
            bounds: Vec::new(),
            terminal_error: 0.0,
            extent: (DVec3::INFINITY, DVec3::NEG_INFINITY),
            exact: ExactCells::new(0),
            topology,
        };
        surface.follow_cage();
        Ok(surface)
    }

    /// The surface with the vertices of its control mesh elsewhere; `None` if there are not as many or one is not finite.
    pub fn posed(&self, positions: &[DVec3]) -> Option<Self> {
        let fits = positions.len() == self.cage.positions.len() && positions.iter().all(|p| p.is_finite());
        fits.then(|| {
            let mut posed = self.clone();
            posed.cage.positions = positions.to_vec();
            posed.follow_cage();
            posed
        })
    }

    /// Makes the box and the error of terminal patches those of this surface and of others, which are this one posed: what does not
    /// change while the control mesh moves.
    pub fn allow_for(&mut self, others: &[Self]) {
        for other in others {
            self.terminal_error = self.terminal_error.max(other.terminal_error);
            self.extent = (self.extent.0.min(other.extent.0), self.extent.1.max(other.extent.1));
        }
    }

    /// Control points, normals and bounds of the present control mesh. The box and the error of terminal patches only grow.
    fn follow_cage(&mut self) {
        let Evaluated { points, errors, .. } = self.neighbourhoods.evaluate(&self.cage.positions);
        let error = BETWEEN_SAMPLES * errors.iter().map(|(_, error)| error.length()).fold(0.0, f64::max);
        self.terminal_error = self.terminal_error.max(error);
        for patch in points.chunks_exact(self.neighbourhoods.control_points) {
            for (k, &point) in patch.iter().enumerate() {
                let point = if k == 0 { point } else { patch[0] + point };
                self.extent = (self.extent.0.min(point), self.extent.1.max(point));
            }
        }
        self.exact = ExactCells::new(self.cage.topology.half_edge_count() as usize);
        self.points = points;
        self.normals = (0..self.topology.face_count())
            .map(|face| self.mean_normal(face))
            .collect();
        self.bounds = self.root_bounds();
    }

    /// The rules of refinement.
    pub fn scheme(&self) -> SubdivisionScheme {
        self.scheme
    }

    /// The vertices of the control mesh.
    pub fn control_positions(&self) -> &[DVec3] {
        &self.cage.positions
    }

    /// The faces of the control mesh that are drawn: by face of the surface, its number in the control mesh.
    pub fn drawn_faces(&self) -> &[u32] {
        &self.cage.drawn
    }

    /// How far what is drawn is from the limit surface at equal parameters, estimated at points of the terminal patches; object units.
    pub fn terminal_error(&self) -> f64 {
        self.terminal_error
    }

    /// The frame by the patches, terminal ones included: what the GPU computes, in f64. Position and derivatives are those of the face
    /// itself, also on its edges.
    pub fn approximate(&self, at: RootPoint) -> SurfaceFrame {
        let corners = self.topology.corner_count(at.face);
        let (jet, [s, t]) = match self.scheme {
            SubdivisionScheme::CatmullClark => {
                let point = DomainPoint::of(at, corners);
                let jet = approximation::in_square_domain(&self.neighbourhoods, &self.points, at.face, &point);
                (jet, point.rates)
            }
            SubdivisionScheme::Loop(_) => {
                let jet = approximation::in_triangle(&self.neighbourhoods, &self.points, at);
                (jet, [[1.0, 0.0], [0.0, 1.0]])
            }
        };
        SurfaceFrame {
            position: jet.value,
            du: jet.du * s[0] + jet.dv * t[0],
            dv: jet.du * s[1] + jet.dv * t[1],
            normal: frame_normal(jet.du, jet.dv, jet.duv, self.normals[at.face as usize]),
        }
    }

    /// By local refinement of the face itself.
    fn exact(&self, at: RootPoint) -> ExactPoint {
        let position = |vertex: u32| self.cage.positions[vertex as usize];
        self.exact
            .evaluate(&self.cage, self.scheme, self.cage.place(at), position)
    }

    /// The direction of the sum of the patches' area vectors, each from its corners.
    fn mean_normal(&self, face: u32) -> DVec3 {
        let all = &self.neighbourhoods;
        let corners: &[usize] = match self.scheme {
            SubdivisionScheme::CatmullClark => &[3, 15, 12],
            SubdivisionScheme::Loop(_) => &[4, 14],
        };
        let (mut sum, mut lengths, mut longest) = (DVec3::ZERO, 0.0, DVec3::ZERO);
        for (domain, tree) in all.trees(face).iter().enumerate() {
            for patch in 0..tree.places.len() as u32 {
                let points = approximation::patch_points(all, &self.points, face, domain, patch);
                for pair in corners.windows(2) {
                    let area = points[pair[0]].cross(points[pair[1]]);
                    sum += area;
                    lengths += area.length();
                    if area.length_squared() > longest.length_squared() {
                        longest = area;
                    }
                }
            }
        }
        unit_or_up(if sum.length() > 1e-9 * lengths { sum } else { longest })
    }

    /// The larger of both roots of every mesh edge.
    fn root_bounds(&self) -> Vec<RootBound> {
        let topology = &self.topology;
        let of_face = |face: u32| {
            bound::of_roots(self.neighbourhoods.kind(face), self.scheme, |domain, patch, place| {
                let points = approximation::patch_points(&self.neighbourhoods, &self.points, face, domain, patch);
                bound::in_domain(bezier::slopes(points), place)
            })
        };
        RootBound::of_both_sides(topology, (0..topology.face_count()).flat_map(of_face).collect())
    }

    /// The largest coordinate of a control point of a patch relative to the origin.
    fn largest_coordinate(&self, origin: DVec3) -> f64 {
        let (low, high) = self.bounding_box();
        (low - origin).abs().max((high - origin).abs()).max_element()
    }
}

/// How the drawn faces meet, without the vertices of the control mesh: faces that touch in a vertex only do not meet.
pub(crate) fn drawn_topology(cage: &Cage) -> Result<Topology, SubdivisionError> {
    let mut number = vec![None; cage.topology.face_count() as usize];
    for (face, &drawn) in (0u32..).zip(&cage.drawn) {
        number[drawn as usize] = Some(face);
    }
    let renumbered = |HalfEdge { face, root }: HalfEdge| number[face as usize].map(|face| HalfEdge { face, root });
    let pairs = cage.topology.roots().filter_map(|place| {
        let own = HalfEdge {
            face: place.face,
            root: place.root,
        };
        let twin = cage.topology.twin(own.face, own.root).filter(|&twin| own < twin)?;
        Some([renumbered(own)?, renumbered(twin)?])
    });
    let counts = cage.drawn.iter().map(|&face| cage.topology.corner_count(face));
    Ok(Topology::glued(counts, pairs)?)
}

impl Surface for Subdivision {
    fn topology(&self) -> &Topology {
        &self.topology
    }

    fn point(&self, at: RootPoint) -> DVec3 {
        self.exact(addresses::canonical(&self.topology, at)).position
    }

    fn frame(&self, at: RootPoint) -> SurfaceFrame {
        let ExactPoint {
            position,
            du,
            dv,
            normal,
        } = self.exact(at);
        let owner = addresses::canonical(&self.topology, at);
        SurfaceFrame {
            position: if owner == at {
                position
            } else {
                self.exact(owner).position
            },
            du,
            dv,
            normal: normal.unwrap_or(self.normals[at.face as usize]),
        }
    }

    /// [`approximate`](Self::approximate), with the position from the face that owns the edge or the vertex.
    fn drawn(&self, at: RootPoint) -> SurfaceFrame {
        let owner = addresses::canonical(&self.topology, at);
        SurfaceFrame {
            position: self.approximate(owner).position,
            ..self.approximate(at)
        }
    }

    fn bound(&self, leaf: &Place) -> SurfaceBound {
        let root = &self.bounds[self.topology.half_edge_index(leaf.face, leaf.root) as usize];
        root.of_leaf(leaf, self.point(diamond::centre(leaf)), 2.0 * self.terminal_error)
    }

    fn bounding_box(&self) -> (DVec3, DVec3) {
        let (low, high) = self.extent;
        (low - self.terminal_error, high + self.terminal_error)
    }

    fn shader(&self) -> &'static str {
        match self.scheme {
            SubdivisionScheme::CatmullClark => "surfaces/catmull_clark.wgsl",
            SubdivisionScheme::Loop(_) => "surfaces/loop.wgsl",
        }
    }

    fn tables(&self, origin: DVec3) -> SurfaceTables {
        tables::tables(self, origin)
    }

    fn pose_shader(&self) -> Option<PoseShader> {
        Some(pose::shader(self.scheme))
    }

    fn pose_tables(&self) -> Option<PoseTables> {
        Some(pose::tables(self))
    }

    /// Faces have the numbers of the control mesh.
    fn face_coord(&self, face: u32, u: f64, v: f64) -> Result<RootPoint, ParameterError> {
        face_coord(&self.cage, &self.topology, face, u, v)
    }
}

/// The point of a face of the control mesh; `topology` is that of the drawn faces.
pub(crate) fn face_coord(
    cage: &Cage,
    topology: &Topology,
    face: u32,
    u: f64,
    v: f64,
) -> Result<RootPoint, ParameterError> {
    let faces = cage.topology.face_count();
    if face >= faces {
        return Err(ParameterError::Face { face, faces });
    }
    match cage.drawn.binary_search(&face) {
        Ok(drawn) => coordinate::root_point(topology, drawn as u32, u, v).map_err(|error| named(error, face)),
        Err(_) => Err(ParameterError::NotDrawn { face }),
    }
}

/// The error with the number that the user gave.
fn named(error: ParameterError, of_user: u32) -> ParameterError {
    match error {
        ParameterError::OutOfDomain { u, v, expected, .. } => ParameterError::OutOfDomain {
            face: of_user,
            u,
            v,
            expected,
        },
        other => other,
    }
}
