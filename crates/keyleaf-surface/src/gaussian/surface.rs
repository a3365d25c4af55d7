//! Gaussian-product surfaces. Twin of `shaders/surfaces/gaussian_catmull_clark.wgsl` and `gaussian_loop.wgsl`.

use super::bound::Regions;
use super::covariance::Covariance;
use super::covariance_mesh::CovarianceMesh;
use super::dual::{Dual, DualFrame, MeanJet};
use super::dual_patches::{DualPatches, DualVertices};
use super::face_bounds::FaceBounds;
use super::lanes::Square;
use super::lanes_of_triangle::BARYCENTRIC;
use super::symmetric::Symmetric3;
use super::{pose, rounding, tables, terminal};
use crate::direction::frame_normal;
use crate::mesh::{F32_ROUNDING, unit_or_up};
use crate::root_bound::RootBound;
use crate::subdivision::addresses::canonical;
use crate::subdivision::approximation::{square_patch, triangle_patch};
use crate::subdivision::cage::Cage;
use crate::subdivision::cell::{DomainPoint, TrianglePoint};
use crate::subdivision::exact::{ExactCells, ExactPoint};
use crate::subdivision::neighbourhoods::Neighbourhoods;
use crate::subdivision::tree::CellPlace;
use crate::subdivision::{MAX_ENTRIES, MAX_ISOLATION, drawn_topology, face_coord};
use crate::{
    ParameterError, PoseShader, PoseTables, SettingError, SubdivisionError, SubdivisionScheme, Surface, SurfaceBound,
    SurfaceFrame, SurfaceTables, diamond,
};
use glam::DVec3;
use keyleaf_key::{Place, RootPoint, Topology};

/// Patches that are less of their domain are left out of the normal of the face.
const LEAST_PART: f64 = 0.125;

/// What poses on the GPU may lose of positions, as a part of the largest coordinate: 61 roundings have been seen (`tests/posing_gaussian.rs`).
const LOST_BY_POSING: f64 = 128.0 * F32_ROUNDING;

/// How the shader finds a mean from its precision.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Solver {
    /// By LDLᵀ with the largest pivot first.
    #[default]
    Ldlt,
    /// By the adjugate over the determinant (Komar 2020), to compare with: it squares the condition.
    Adjugate,
}

/// How a Gaussian-product surface is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GaussianSettings {
    /// The linear scheme behind it.
    pub scheme: SubdivisionScheme,
    /// As of [`SubdivisionSettings`](crate::SubdivisionSettings).
    pub isolation: u32,
    /// What the shader solves with.
    pub solver: Solver,
}

impl Default for GaussianSettings {
    fn default() -> Self {
        Self {
            scheme: SubdivisionScheme::default(),
            isolation: 8,
            solver: Solver::default(),
        }
    }
}

/// The surface of a covariance mesh: the means of the limit surface in dual space.
///
/// [`Surface::point`] and [`Surface::frame`] are those of the limit surface. What is drawn, [`approximate`](Self::approximate), is the same
/// but for terminal patches, see [`terminal_error`](Self::terminal_error). Bounds are of what is drawn, and allow for the difference.
///
/// Faces, creases, boundaries and domains are those of [`Subdivision`](crate::Subdivision), to which the surface is equal where all
/// covariances are the same multiple of the unit matrix.
///
/// GPU memory: 624 bytes a bicubic patch, 592 a quartic one, 48 a face, 32 a corner.
///
/// ```
/// use keyleaf_surface::gaussian::{CovarianceMesh, GaussianProduct, GaussianSettings};
/// use keyleaf_surface::{ControlMesh, CornerAttributes, PolygonMesh, Surface};
/// use glam::DVec3;
/// let corner = |k: u32| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)) * 2.0 - 1.0;
/// let cube = PolygonMesh {
///     positions: (0..8).map(corner).collect(),
///     faces: [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]].into_iter().collect(),
///     corners: CornerAttributes::default(),
/// };
/// let mesh = CovarianceMesh::isotropic(ControlMesh::from(cube), 0.2)?;
/// let surface = GaussianProduct::new(&mesh, GaussianSettings::default())?;
/// let corner = surface.point(surface.face_coord(0, 0.0, 0.0)?);
/// assert!((corner + DVec3::splat(0.5)).length() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct GaussianProduct {
    settings: GaussianSettings,
    /// Its positions are the means.
    cage: Cage,
    precisions: Vec<Symmetric3>,
    /// Of the faces that are drawn, with a vertex a fan.
    topology: Topology,
    pub(super) neighbourhoods: Neighbourhoods,
    pub(super) patches: DualPatches,
    /// Where the rings of the faces are refined.
    frames: Vec<DualFrame>,
    /// Mean normals of the faces.
    pub(super) normals: Vec<DVec3>,
    /// By half-edge.
    pub(super) bounds: Vec<RootBound>,
    box_of_patches: (DVec3, DVec3),
    terminal_error: f64,
    /// Of the limit surface, as far as it was asked for.
    exact: ExactCells<Dual>,
    /// What f32 loses of a mean, from above.
    pub(super) rounding: f64,
    /// What is lost besides, as a part of the largest coordinate, where the GPU poses the surface.
    pub(super) lost_by_posing: f64,
}

impl GaussianProduct {
    /// The surface of a covariance mesh.
    ///
    /// # Errors
    /// [`SubdivisionError`] as [`Subdivision::new`](crate::Subdivision::new).
    pub fn new(mesh: &CovarianceMesh, settings: GaussianSettings) -> Result<Self, SubdivisionError> {
        let GaussianSettings { scheme, isolation, .. } = settings;
        let is_possible = isolation <= MAX_ISOLATION;
        SettingError::check("isolation", f64::from(isolation), is_possible, "a number from 0 to 16")?;
        let cage = Cage::new(mesh.control(), scheme)?;
        let topology = drawn_topology(&cage)?;
        let neighbourhoods = Neighbourhoods::new(&cage, scheme, isolation);
        let entries = neighbourhoods.entries / neighbourhoods.control_points * tables::entries_of_patch(scheme);
        if entries > MAX_ENTRIES {
            return Err(SubdivisionError::TooManyPatches {
                entries,
                limit: MAX_ENTRIES,
                isolation,
            });
        }
        let mut surface = Self {
            settings,
            terminal_error: 0.0,
            rounding: 0.0,
            lost_by_posing: 0.0,
            frames: Vec::new(),
            normals: Vec::new(),
            bounds: Vec::new(),
            box_of_patches: (DVec3::ZERO, DVec3::ZERO),
            exact: ExactCells::new(cage.topology.half_edge_count() as usize),
            cage,
            precisions: common_unit(mesh.covariances()),
            patches: DualPatches::none(neighbourhoods.control_points),
            neighbourhoods,
            topology,
        };
        surface.follow_cage();
        Ok(surface)
    }

    /// The surface with these means and covariances: the GPU poses it alike. None if there are not as many as before or a mean is not
    /// finite.
    pub fn posed(&self, means: &[DVec3], covariances: &[Covariance]) -> Option<Self> {
        let count = self.cage.positions.len();
        let fits = [means.len(), covariances.len()] == [count; 2] && means.iter().all(|mean| mean.is_finite());
        fits.then(|| {
            let mut posed = self.clone();
            posed.cage.positions = means.to_vec();
            posed.precisions = common_unit(covariances);
            posed.follow_cage();
            posed
        })
    }

    /// Makes bounds and errors those of this surface and of others, which are this one posed: what does not change while the control mesh
    /// moves.
    pub fn allow_for(&mut self, others: &[Self]) {
        self.lost_by_posing = LOST_BY_POSING;
        for other in others {
            self.terminal_error = self.terminal_error.max(other.terminal_error);
            self.rounding = self.rounding.max(other.rounding);
            for (own, other) in self.bounds.iter_mut().zip(&other.bounds) {
                *own = own.max(*other);
            }
            let ((low, high), (other_low, other_high)) = (self.box_of_patches, other.box_of_patches);
            self.box_of_patches = (low.min(other_low), high.max(other_high));
        }
    }

    /// Patches, normals, bounds and errors of the present covariance mesh.
    fn follow_cage(&mut self) {
        let (means, scheme) = (&self.cage.positions, self.settings.scheme);
        let vertices = DualVertices::new(means, &self.precisions);
        let (patches, errors) = DualPatches::new(&self.neighbourhoods, &vertices);
        self.terminal_error = terminal::error(&patches, &errors, vertices.centre);
        self.rounding = match scheme {
            SubdivisionScheme::CatmullClark => rounding::error(&Square, &patches, self.settings.solver),
            SubdivisionScheme::Loop(_) => rounding::error(&BARYCENTRIC, &patches, self.settings.solver),
        };
        self.frames = ring_frames(&self.neighbourhoods, means, &self.precisions);
        self.exact = ExactCells::new(self.cage.topology.half_edge_count() as usize);
        self.patches = patches;
        self.normals = (0..self.topology.face_count())
            .map(|face| self.mean_normal(face))
            .collect();
        self.set_bounds();
    }

    /// The means of the vertices of the control mesh.
    pub fn control_positions(&self) -> &[DVec3] {
        &self.cage.positions
    }

    /// How it was made.
    pub fn settings(&self) -> GaussianSettings {
        self.settings
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
        let (jet, [s, t]) = match self.settings.scheme {
            SubdivisionScheme::CatmullClark => self.in_square(at),
            SubdivisionScheme::Loop(_) => (self.in_triangle(at), [[1.0, 0.0], [0.0, 1.0]]),
        };
        let [du, dv] = jet.first;
        SurfaceFrame {
            position: jet.mean,
            du: du * s[0] + dv * t[0],
            dv: du * s[1] + dv * t[1],
            normal: frame_normal(du, dv, jet.second[1], self.normals[at.face as usize]),
        }
    }

    /// In the parameters of the domain, and these by the face's.
    fn in_square(&self, at: RootPoint) -> (MeanJet, [[f64; 2]; 2]) {
        let point = DomainPoint::of(at, self.topology.corner_count(at.face));
        let tree = &self.neighbourhoods.trees(at.face)[point.domain];
        let (patch, inner, scale) = square_patch(tree, point.at);
        let patch = self.patch(at.face, point.domain, patch);
        let jet = self.patches.square(patch).map(|net| net.jet(inner.to_f64()));
        let jet = jet.and_then(|jet| jet.mean());
        (scaled(self.patches.in_object_space(patch, jet), scale), point.rates)
    }

    fn in_triangle(&self, at: RootPoint) -> MeanJet {
        let tree = &self.neighbourhoods.trees(at.face)[0];
        let (patch, inner, scale) = triangle_patch(tree, TrianglePoint::of(at));
        let patch = self.patch(at.face, 0, patch);
        let [_, u, v] = inner.to_f64();
        let jet = self.patches.triangle(patch).map(|net| net.jet([u, v]));
        let jet = jet.and_then(|jet| jet.mean());
        scaled(self.patches.in_object_space(patch, jet), scale)
    }

    /// The number of a patch of a domain among all.
    fn patch(&self, face: u32, domain: usize, patch: u32) -> usize {
        self.neighbourhoods.faces[face as usize].first_entries[domain] / self.patches.size + patch as usize
    }

    /// By local refinement of the face itself.
    fn exact(&self, at: RootPoint) -> ExactPoint {
        let frame = &self.frames[at.face as usize];
        let value = |vertex: u32| {
            let vertex = vertex as usize;
            Dual::of_precision(self.cage.positions[vertex], self.precisions[vertex], frame)
        };
        let exact = self
            .exact
            .evaluate(&self.cage, self.settings.scheme, self.cage.place(at), value);
        // The unit of the frame is another one, its axes are the same.
        ExactPoint {
            position: frame.point(exact.position),
            du: frame.axes * exact.du,
            dv: frame.axes * exact.dv,
            ..exact
        }
    }

    /// The direction of the sum of the patches' area vectors, each from its corners, without the smallest patches.
    fn mean_normal(&self, face: u32) -> DVec3 {
        let (mut sum, mut lengths, mut longest) = (DVec3::ZERO, 0.0, DVec3::ZERO);
        for (domain, tree) in self.neighbourhoods.trees(face).iter().enumerate() {
            for (patch, place) in (0..).zip(&tree.places) {
                if !counts_for_normal(place) {
                    continue;
                }
                let patch = self.patch(face, domain, patch);
                let mut corners = self.patches.corners().iter();
                let mut corner = || self.patches.offset(patch, *corners.next()?);
                let Some(first) = corner() else { continue };
                let mut last = DVec3::ZERO;
                while let Some(next) = corner() {
                    let area = last.cross(next - first);
                    last = next - first;
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

    /// The larger of both roots of every mesh edge, and the box of all patches.
    fn set_bounds(&mut self) {
        let topology = &self.topology;
        let all = &self.neighbourhoods;
        let (mut roots, mut low, mut high) = (Vec::new(), DVec3::INFINITY, DVec3::NEG_INFINITY);
        let regions: Vec<Regions> = all.kinds.iter().map(Regions::roots).collect();
        for (face, ring) in (0..).zip(&all.faces) {
            let regions = &regions[ring.kind as usize];
            let own = FaceBounds::new(all, &self.patches, self.settings.scheme, face, regions);
            roots.extend(own.roots);
            (low, high) = (low.min(own.low), high.max(own.high));
        }
        self.bounds = RootBound::of_both_sides(topology, roots);
        self.box_of_patches = (low, high);
    }
}

/// Whether the normal of a face takes a patch into account.
pub fn counts_for_normal(place: &CellPlace) -> bool {
    place.right[0].abs() >= LEAST_PART
}

/// Precisions of the vertices in a unit in which the largest trace is 1. A common factor changes nothing.
fn common_unit(covariances: &[Covariance]) -> Vec<Symmetric3> {
    let precisions = covariances.iter().map(|covariance| covariance.precision());
    let precisions: Vec<Symmetric3> = precisions.collect();
    let largest = precisions.iter().map(|precision| precision.trace()).fold(0.0, f64::max);
    precisions
        .iter()
        .map(|&precision| precision * (1.0 / largest))
        .collect()
}

/// Frames of the rings of the faces: about the mean of their means, in their units.
fn ring_frames(all: &Neighbourhoods, means: &[DVec3], precisions: &[Symmetric3]) -> Vec<DualFrame> {
    let frame = |vertices: &[u32]| {
        let vertices = || vertices.iter().map(|&vertex| vertex as usize);
        let traces = vertices().map(|vertex| precisions[vertex].trace());
        let centre = vertices().map(|vertex| means[vertex]).sum::<DVec3>() / vertices().count().max(1) as f64;
        DualFrame::round(centre, traces.fold(0.0, f64::max))
    };
    all.faces.iter().map(|face| frame(&face.vertices)).collect()
}

/// With derivatives in the parameters of a domain.
fn scaled(jet: MeanJet, scale: f64) -> MeanJet {
    MeanJet {
        mean: jet.mean,
        first: jet.first.map(|d| d * scale),
        second: jet.second.map(|d| d * (scale * scale)),
    }
}

impl Surface for GaussianProduct {
    fn topology(&self) -> &Topology {
        &self.topology
    }

    fn point(&self, at: RootPoint) -> DVec3 {
        self.exact(canonical(&self.topology, at)).position
    }

    fn frame(&self, at: RootPoint) -> SurfaceFrame {
        let ExactPoint {
            position,
            du,
            dv,
            normal,
        } = self.exact(at);
        let owner = canonical(&self.topology, at);
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
        SurfaceFrame {
            position: self.approximate(canonical(&self.topology, at)).position,
            ..self.approximate(at)
        }
    }

    fn bound(&self, leaf: &Place) -> SurfaceBound {
        let root = &self.bounds[self.topology.half_edge_index(leaf.face, leaf.root) as usize];
        root.of_leaf(leaf, self.point(diamond::centre(leaf)), 2.0 * self.terminal_error)
    }

    fn bounding_box(&self) -> (DVec3, DVec3) {
        let (low, high) = self.box_of_patches;
        (low - self.terminal_error, high + self.terminal_error)
    }

    fn shader(&self) -> &'static str {
        match (self.settings.scheme, self.settings.solver) {
            (SubdivisionScheme::CatmullClark, Solver::Ldlt) => "surfaces/gaussian_catmull_clark.wgsl",
            (SubdivisionScheme::CatmullClark, Solver::Adjugate) => "surfaces/gaussian_catmull_clark_adjugate.wgsl",
            (SubdivisionScheme::Loop(_), Solver::Ldlt) => "surfaces/gaussian_loop.wgsl",
            (SubdivisionScheme::Loop(_), Solver::Adjugate) => "surfaces/gaussian_loop_adjugate.wgsl",
        }
    }

    fn tables(&self, origin: DVec3) -> SurfaceTables {
        tables::tables(self, origin)
    }

    fn pose_shader(&self) -> Option<PoseShader> {
        Some(PoseShader::GAUSSIAN)
    }

    fn pose_tables(&self) -> Option<PoseTables> {
        Some(pose::tables(self))
    }

    /// Faces have the numbers of the control mesh.
    fn face_coord(&self, face: u32, u: f64, v: f64) -> Result<RootPoint, ParameterError> {
        face_coord(&self.cage, &self.topology, face, u, v)
    }
}
