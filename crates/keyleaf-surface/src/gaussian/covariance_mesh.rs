//! Control meshes whose vertices are Gaussians.

use super::covariance::{Covariance, CovarianceDefect};
use super::symmetric::Symmetric3;
use crate::{ControlMesh, MeshError, SettingError};
use glam::DVec3;

/// A control mesh with a covariance a vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct CovarianceMesh {
    control: ControlMesh,
    covariances: Vec<Covariance>,
}

/// What is done about matrices that are not quite covariances.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Conditioning {
    /// Variances below the greatest over [`CONDITION_LIMIT`](super::CONDITION_LIMIT), also negative ones, are raised to that, and reported.
    #[default]
    Floor,
    /// They are refused.
    Strict,
}

/// Why a mesh and matrices are no covariance mesh. Vertices are counted from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CovarianceError {
    /// The mesh is no surface.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// There is not one matrix a vertex.
    #[error("the mesh has {vertices} vertices, but {found} covariances; expected one a vertex")]
    Count {
        /// Vertices of the mesh.
        vertices: usize,
        /// Matrices that were given.
        found: usize,
    },
    /// A matrix is no covariance.
    #[error("the covariance of vertex {vertex} is none: {defect}")]
    Defect {
        /// The vertex.
        vertex: usize,
        /// Why.
        defect: CovarianceDefect,
    },
    /// The edges have no length, from which covariances could be made.
    #[error("all edges of the mesh have the length 0; covariances cannot be derived from it")]
    NoExtent,
    /// A setting is out of range.
    #[error(transparent)]
    Setting(#[from] SettingError),
}

impl CovarianceMesh {
    /// A control mesh with these covariances, in squared object units, one a vertex; and the vertices whose covariance was changed.
    ///
    /// # Errors
    /// [`CovarianceError`] if the mesh is no surface, a matrix is not finite or has no positive variance, or is ill-conditioned and
    /// `conditioning` is strict.
    pub fn new(
        control: ControlMesh,
        covariances: &[Symmetric3],
        conditioning: Conditioning,
    ) -> Result<(Self, Vec<u32>), CovarianceError> {
        control.mesh.topology()?;
        let (vertices, found) = (control.mesh.positions.len(), covariances.len());
        if vertices != found {
            return Err(CovarianceError::Count { vertices, found });
        }
        let mut changed = Vec::new();
        let mut checked = Vec::with_capacity(found);
        for (vertex, &matrix) in covariances.iter().enumerate() {
            let covariance = match conditioning {
                Conditioning::Floor => Covariance::regularised(matrix),
                Conditioning::Strict => Covariance::new(matrix).map(|covariance| (covariance, false)),
            };
            let (covariance, is_changed) = covariance.map_err(|defect| CovarianceError::Defect { vertex, defect })?;
            checked.push(covariance);
            if is_changed {
                changed.push(vertex as u32);
            }
        }
        let mesh = Self {
            control,
            covariances: checked,
        };
        Ok((mesh, changed))
    }

    /// With the same round covariance at every vertex, whose standard deviation is `factor` times the mean edge length. Its surface is
    /// that of the control mesh.
    ///
    /// # Errors
    /// [`CovarianceError`] if the mesh is no surface or without extent, or the factor is not between 1e-6 and 1e6.
    pub fn isotropic(control: ControlMesh, factor: f64) -> Result<Self, CovarianceError> {
        let deviation = deviation(&control, factor)?;
        let matrix = Symmetric3::IDENTITY * (deviation * deviation);
        let matrices = vec![matrix; control.mesh.positions.len()];
        Ok(Self::new(control, &matrices, Conditioning::Strict)?.0)
    }

    /// With covariances that follow the faces: flat in their planes, long along edges, small and round at corners.
    ///
    /// With s = `factor` times the mean edge length, f = `flatness` (thickness over width, 1e-3 to 1), and M the mean of n nᵀ over the
    /// normals n of the faces about a vertex, weighted by their angles there: Σ = s² (1 − (1 − f²) M). In a plane M = n nᵀ, along an edge
    /// it has two eigenvalues of about 1/2, at a corner of a cube three of 1/3.
    ///
    /// # Errors
    /// [`CovarianceError`] if the mesh is no surface or without extent, or a setting is out of range.
    pub fn from_faces(control: ControlMesh, factor: f64, flatness: f64) -> Result<Self, CovarianceError> {
        let is_flatness = (1e-3..=1.0).contains(&flatness);
        SettingError::check("flatness", flatness, is_flatness, "a number from 0.001 to 1")?;
        let deviation = deviation(&control, factor)?;
        let spread = |tensor: Symmetric3| {
            let thinned = Symmetric3::IDENTITY - tensor * (1.0 - flatness * flatness);
            thinned * (deviation * deviation)
        };
        let matrices: Vec<Symmetric3> = normal_tensors(&control).into_iter().map(spread).collect();
        Ok(Self::new(control, &matrices, Conditioning::Floor)?.0)
    }

    /// The control mesh. Its positions are the means.
    pub fn control(&self) -> &ControlMesh {
        &self.control
    }

    /// The covariances, one a vertex.
    pub fn covariances(&self) -> &[Covariance] {
        &self.covariances
    }

    /// Mean and covariance of a vertex, none if there is no such vertex.
    pub fn gaussian(&self, vertex: u32) -> Option<(DVec3, Covariance)> {
        let index = vertex as usize;
        Some((*self.control.mesh.positions.get(index)?, *self.covariances.get(index)?))
    }

    /// The same with every covariance multiplied by one positive factor, which changes nothing but numbers; none if they leave their
    /// range.
    pub fn scaled(&self, factor: f64) -> Option<Self> {
        let scaled = |covariance: &Covariance| Covariance::new(covariance.matrix() * factor).ok();
        Some(Self {
            control: self.control.clone(),
            covariances: self.covariances.iter().map(scaled).collect::<Option<_>>()?,
        })
    }
}

/// `factor` times the mean length of the edges of the faces.
fn deviation(control: &ControlMesh, factor: f64) -> Result<f64, CovarianceError> {
    let is_factor = (1e-6..=1e6).contains(&factor);
    SettingError::check("factor", factor, is_factor, "a number from 0.000001 to 1000000")?;
    control.mesh.topology()?;
    let (mut sum, mut count) = (0.0, 0.0);
    for face in control.mesh.faces.iter() {
        for (k, &a) in face.iter().enumerate() {
            let b = face[(k + 1) % face.len()];
            sum += control.mesh.positions[a as usize].distance(control.mesh.positions[b as usize]);
            count += 1.0;
        }
    }
    if sum > 0.0 {
        Ok(factor * sum / count)
    } else {
        Err(CovarianceError::NoExtent)
    }
}

/// M of every vertex: positive semidefinite with a trace of 1, or 0 where no face has an area.
fn normal_tensors(control: &ControlMesh) -> Vec<Symmetric3> {
    let positions = &control.mesh.positions;
    let mut sums = vec![(Symmetric3::default(), 0.0); positions.len()];
    for face in control.mesh.faces.iter() {
        let n = face.len();
        for (k, &vertex) in face.iter().enumerate() {
            let own = positions[vertex as usize];
            let [a, b] = [1, n - 1].map(|step| positions[face[(k + step) % n] as usize] - own);
            let Some(normal) = crate::direction::cross_direction(a, b) else {
                continue;
            };
            let angle = a.angle_between(b);
            let (tensor, weight) = &mut sums[vertex as usize];
            *tensor = *tensor + Symmetric3::outer(normal) * angle;
            *weight += angle;
        }
    }
    let mean = |(tensor, weight): (Symmetric3, f64)| if weight > 0.0 { tensor * (1.0 / weight) } else { tensor };
    sums.into_iter().map(mean).collect()
}
