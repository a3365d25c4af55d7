//! Makes the surfaces whose polygons are control meshes: reads the control mesh of a scene's entry, with sharpness, covariances and
//! motion, and hands it to `keyleaf-surface`.

use std::path::Path;
use std::sync::Arc;

use glam::DVec3;
use keyleaf_surface::gaussian::{
    Conditioning, Covariance, CovarianceMesh, GaussianProduct, GaussianSettings, Solver, Symmetric3,
};
use keyleaf_surface::{
    ControlMesh, Corner, CornerAttributes, CornerNormals, Crease, LimitSamples, LoopWeights, Subdivision,
    SubdivisionScheme, SubdivisionSettings, Surface, TrianglePatches,
};

use crate::error::{FilePlace, ImportError};
use crate::model::sharpness::{Placed, add_corners, add_creases};
use crate::model::{ControlMeshOptions, CovarianceSource, read_control_mesh};
use crate::motion::CageMotion;
use crate::note::Note;
use crate::scene::{
    Covariances, GaussianScheme, GaussianShape, Motion, NormalCovariances, QasShape, QasVariant, Shape, Sharpness,
    SurfaceEntry, Track,
};
use crate::surfaces::{Failure, Made};

/// A control mesh at rest, what belongs to its vertices, and how it moves.
#[derive(Debug, Clone)]
pub struct ControlCage {
    /// The control mesh.
    pub control: ControlMesh,
    /// The covariance of each vertex (xx, xy, xz, yy, yz, zz) of a Gaussian-product surface.
    pub covariances: Option<Vec<[f64; 6]>>,
    /// How it moves, if it does.
    pub motion: Option<CageMotion>,
    /// What its surface is.
    shape: Shape,
    /// The surface at rest, if all poses can be made of it.
    at_rest: Option<AtRest>,
}

/// A surface that follows from the vertices of its control mesh alone: what it is made of besides is found once.
#[derive(Debug, Clone)]
enum AtRest {
    Subdivision(Arc<Subdivision>),
    Triangles(Arc<TrianglePatches>),
    Gaussian(Arc<GaussianProduct>),
}

impl AtRest {
    fn surface(&self) -> Arc<dyn Surface> {
        match self {
            Self::Subdivision(surface) => Arc::clone(surface) as Arc<dyn Surface>,
            Self::Triangles(surface) => Arc::clone(surface) as Arc<dyn Surface>,
            Self::Gaussian(surface) => Arc::clone(surface) as Arc<dyn Surface>,
        }
    }

    /// None where a pose has no surface.
    fn posed(&self, positions: &[DVec3], covariances: Option<&[[f64; 6]]>) -> Option<Self> {
        Some(match self {
            Self::Subdivision(surface) => Self::Subdivision(Arc::new(surface.posed(positions)?)),
            Self::Triangles(surface) => Self::Triangles(Arc::new(surface.posed(positions)?)),
            Self::Gaussian(surface) => {
                let covariance = |&numbers| Some(Covariance::regularised(Symmetric3::from_array(numbers)).ok()?.0);
                let covariances: Option<Vec<_>> = covariances?.iter().map(covariance).collect();
                Self::Gaussian(Arc::new(surface.posed(positions, &covariances?)?))
            }
        })
    }

    /// Lets what does not change with the pose be that of a pose as well.
    fn allow_for(&mut self, posed: &Self) {
        match (self, posed) {
            (Self::Subdivision(rest), Self::Subdivision(posed)) => {
                Arc::make_mut(rest).allow_for(std::slice::from_ref(posed.as_ref()));
            }
            (Self::Triangles(rest), Self::Triangles(posed)) => {
                Arc::make_mut(rest).allow_for(std::slice::from_ref(posed.as_ref()));
            }
            (Self::Gaussian(rest), Self::Gaussian(posed)) => {
                Arc::make_mut(rest).allow_for(std::slice::from_ref(posed.as_ref()));
            }
            _ => {}
        }
    }
}

/// How many poses of a motion the bounds of what does not change with the pose are taken from.
const POSES: u32 = 32;

/// A pose that has no surface.
#[derive(Debug, thiserror::Error)]
#[error("the control mesh has no surface at {time} s: {reason}")]
pub struct PoseError {
    /// Seconds.
    pub time: f64,
    /// Why not.
    pub reason: String,
}

impl ControlCage {
    /// The positions of its vertices at a time in seconds, object space.
    pub fn pose(&self, time: f64) -> Vec<DVec3> {
        match &self.motion {
            Some(motion) => motion.pose(time),
            None => self.control.mesh.positions.clone(),
        }
    }

    /// The surface at a time in seconds. Keeps faces, patches and shader.
    ///
    /// # Errors
    /// [`PoseError`] if vertices or covariances of the pose make up none.
    pub fn surface_at(&self, time: f64) -> Result<Arc<dyn Surface>, PoseError> {
        if let Some(posed) = self.at_rest.as_ref().and_then(|rest| self.posed(rest, time)) {
            return Ok(posed.surface());
        }
        surface(self, &self.shape, time).map_err(|failure| PoseError {
            time,
            reason: failure.source.to_string(),
        })
    }

    fn posed(&self, rest: &AtRest, time: f64) -> Option<AtRest> {
        rest.posed(&self.pose(time), self.pose_covariances(time).as_deref())
    }

    /// What its surface is.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// Another surface of the same control mesh, at time 0.
    ///
    /// # Errors
    /// [`PoseError`] if the control mesh has none of that shape.
    pub fn surface_as(&self, shape: &Shape) -> Result<Arc<dyn Surface>, PoseError> {
        surface(self, shape, 0.0).map_err(|failure| PoseError {
            time: 0.0,
            reason: failure.source.to_string(),
        })
    }

    /// Lets the surface at rest allow for all poses, and returns it as it is at time 0; `None` if it does not follow from the vertices alone.
    fn keep_at_rest(&mut self) -> Result<Option<Arc<dyn Surface>>, Failure> {
        let mut control = self.control.clone();
        control.mesh.positions = self.pose(0.0);
        let covariances = self.pose_covariances(0.0);
        let Some(mut rest) = at_rest(&control, covariances.as_deref(), &self.shape)? else {
            return Ok(None);
        };
        if let Some(motion) = &self.motion {
            let step = motion.duration() / f64::from(POSES);
            for pose in 0..POSES {
                if let Some(posed) = self.posed(&rest, f64::from(pose) * step) {
                    rest.allow_for(&posed);
                }
            }
        }
        let surface = rest.surface();
        self.at_rest = Some(rest);
        Ok(Some(surface))
    }

    /// The covariances of its vertices at a time, if they have any.
    pub fn pose_covariances(&self, time: f64) -> Option<Vec<[f64; 6]>> {
        let covariances = self.covariances.as_ref()?;
        Some(match &self.motion {
            Some(motion) => motion.pose_covariances(time, covariances),
            None => covariances.clone(),
        })
    }
}

/// The surface of the control mesh in `file`; a moving one is made as it is at time 0.
pub(crate) fn make(folder: &Path, file: &Path, entry: &SurfaceEntry, notes: &mut Vec<Note>) -> Result<Made, Failure> {
    let options = options(folder, entry);
    let read = read_control_mesh(file, &options).map_err(Failure::of(match options.covariances {
        CovarianceSource::File(_) => "surface.covariances",
        _ => "source",
    }))?;
    notes.extend(read.notes);
    let mut files = vec![file.to_path_buf()];
    files.extend(read.covariance_file);
    let mut control = read.control;
    if let Some(sharpness) = sharpness(&entry.surface) {
        sharpen(file, &mut control, sharpness).map_err(Failure::of("surface.sharpness"))?;
    }
    let motion = motion(folder, &control, &entry.motion)?;
    files.extend(motion.iter().flat_map(|motion| motion.files.iter().cloned()));
    let covariances = match &entry.surface {
        Shape::GaussianProduct(shape) => Some(covariances(file, &control, read.covariances, shape, notes)?),
        _ => None,
    };
    let mut cage = ControlCage {
        control,
        covariances,
        motion,
        shape: entry.surface.clone(),
        at_rest: None,
    };
    let surface = match cage.keep_at_rest()? {
        Some(surface) => surface,
        None => surface(&cage, &cage.shape, 0.0)?,
    };
    notes.extend(faces_left_out(file, &cage.control, surface.as_ref()));
    let corners = corner_attributes(&cage.control, surface.as_ref());
    Ok(Made {
        corners,
        material: read.material,
        files,
        cage: Some(Arc::new(cage)),
        ..Made::new(surface)
    })
}

fn options(folder: &Path, entry: &SurfaceEntry) -> ControlMeshOptions {
    let sharpness = sharpness(&entry.surface);
    ControlMeshOptions {
        keep_uvs: entry.material.texture.is_some(),
        covariances: match &entry.surface {
            Shape::GaussianProduct(shape) => match &shape.covariances {
                Covariances::FromFile => CovarianceSource::Model,
                Covariances::File(path) => CovarianceSource::File(folder.join(path)),
                Covariances::Isotropic(_) | Covariances::FromNormals(_) => CovarianceSource::IfAny,
            },
            _ => CovarianceSource::IfAny,
        },
        boundary: sharpness.and_then(|s| s.boundary).map(Into::into),
        creasing: sharpness.and_then(|s| s.creasing).map(Into::into),
    }
}

fn sharpness(shape: &Shape) -> Option<&Sharpness> {
    match shape {
        Shape::CatmullClark(shape) => Some(&shape.sharpness),
        Shape::Loop(shape) => Some(&shape.sharpness),
        Shape::GaussianProduct(shape) => Some(&shape.sharpness),
        Shape::Flat | Shape::Displaced(_) | Shape::Qas(_) | Shape::PnTriangles => None,
    }
}

/// Adds what the scene lists; it counts before what the file says.
fn sharpen(file: &Path, control: &mut ControlMesh, sharpness: &Sharpness) -> Result<(), ImportError> {
    let creases = sharpness
        .creases
        .iter()
        .enumerate()
        .map(|(index, &(a, b, sharpness))| Placed {
            value: Crease {
                vertices: [a, b],
                sharpness,
            },
            place: FilePlace::Part(format!("creases[{index}]")),
        });
    add_creases(file, control, creases)?;
    let corners = sharpness
        .corners
        .iter()
        .enumerate()
        .map(|(index, &(vertex, sharpness))| Placed {
            value: Corner { vertex, sharpness },
            place: FilePlace::Part(format!("corners[{index}]")),
        });
    add_corners(file, control, corners)
}

fn motion(folder: &Path, control: &ControlMesh, motion: &Motion) -> Result<Option<CageMotion>, Failure> {
    let Motion::Keys(tracks) = motion else {
        return Ok(None);
    };
    let mut cage = CageMotion::new(control.mesh.positions.clone());
    for (index, track) in tracks.iter().enumerate() {
        let Track::Blend(blend) = track else { continue };
        let file = folder.join(&blend.path);
        let field = format!("motion[{index}].path");
        let target = read_control_mesh(&file, &ControlMeshOptions::default()).map_err(Failure::of(field.clone()))?;
        cage.add_blend(blend, &target.control.mesh.positions)
            .map_err(Failure::of(field))?;
        cage.files.push(file);
    }
    cage.add_groups(tracks).map_err(Failure::of("motion"))?;
    Ok(Some(cage))
}

/// Tells how many faces the rule for boundaries leaves out.
fn faces_left_out(file: &Path, control: &ControlMesh, surface: &dyn Surface) -> Option<Note> {
    let (faces, drawn) = (control.mesh.faces.len(), surface.topology().face_count() as usize);
    let text = format!(
        "faces at a boundary that are not drawn, since the boundary rule is none: {} of {faces}",
        faces.saturating_sub(drawn)
    );
    (drawn < faces).then(|| Note::warning(file, text))
}

/// The attributes of the corners of the faces that the surface draws: none if it leaves out any.
fn corner_attributes(control: &ControlMesh, surface: &dyn Surface) -> CornerAttributes {
    if surface.topology().half_edge_count() as usize == control.mesh.faces.corner_count() {
        CornerAttributes {
            // The surface has normals of its own.
            normals: None,
            ..control.mesh.corners.clone()
        }
    } else {
        CornerAttributes::default()
    }
}

/// The covariances of a Gaussian-product surface, positive definite; `read` are those of a file.
fn covariances(
    file: &Path,
    control: &ControlMesh,
    read: Option<Vec<[f64; 6]>>,
    shape: &GaussianShape,
    notes: &mut Vec<Note>,
) -> Result<Vec<[f64; 6]>, Failure> {
    let conditioning = if shape.strict {
        Conditioning::Strict
    } else {
        Conditioning::Floor
    };
    let control = control.clone();
    let made = match shape.covariances {
        Covariances::FromFile | Covariances::File(_) => {
            let matrices: Vec<Symmetric3> = read
                .unwrap_or_default()
                .into_iter()
                .map(Symmetric3::from_array)
                .collect();
            CovarianceMesh::new(control, &matrices, conditioning).map(|(mesh, changed)| {
                if let Some(first) = changed.first() {
                    let count = changed.len();
                    let text = format!(
                        "covariances made rounder, since they are too flat or not positive definite: {count}, the first at vertex {first}"
                    );
                    notes.push(Note::warning(file, text));
                }
                mesh
            })
        }
        Covariances::Isotropic(factor) => CovarianceMesh::isotropic(control, factor),
        Covariances::FromNormals(NormalCovariances { factor, flatness }) => {
            CovarianceMesh::from_faces(control, factor, flatness)
        }
    };
    let mesh = made.map_err(Failure::of("surface.covariances"))?;
    let numbers = mesh
        .covariances()
        .iter()
        .map(|covariance| covariance.matrix().to_array());
    Ok(numbers.collect())
}

/// The surface of a control mesh as it is at a time.
fn surface(cage: &ControlCage, shape: &Shape, time: f64) -> Result<Arc<dyn Surface>, Failure> {
    let mut control = cage.control.clone();
    control.mesh.positions = cage.pose(time);
    let covariances = cage.pose_covariances(time);
    if let Some(surface) = at_rest(&control, covariances.as_deref(), shape)? {
        return Ok(surface.surface());
    }
    match shape {
        Shape::Qas(_) => qas_of_sharp(&control),
        shape => Err(not_yet(shape.name())),
    }
}

/// The surface, if it follows from the vertices and their covariances alone.
fn at_rest(control: &ControlMesh, covariances: Option<&[[f64; 6]]>, shape: &Shape) -> Result<Option<AtRest>, Failure> {
    let (scheme, isolation) = match shape {
        Shape::CatmullClark(shape) => (SubdivisionScheme::CatmullClark, shape.isolation),
        Shape::Loop(shape) => {
            let weights = match shape.weights {
                crate::scene::LoopWeights::Loop => LoopWeights::Loop,
                crate::scene::LoopWeights::Warren => LoopWeights::Warren,
            };
            (SubdivisionScheme::Loop(weights), shape.isolation)
        }
        Shape::Qas(shape) => return qas(control, shape),
        Shape::PnTriangles => return pn_triangles(control).map(Some),
        Shape::GaussianProduct(shape) => {
            return gaussian_product(control, covariances.unwrap_or_default(), shape).map(Some);
        }
        _ => return Ok(None),
    };
    let settings = SubdivisionSettings { scheme, isolation };
    let surface = Subdivision::new(control, settings).map_err(Failure::of("surface"))?;
    Ok(Some(AtRest::Subdivision(Arc::new(surface))))
}

/// None for the approximation of a Loop surface with creases, which is made of samples.
fn qas(control: &ControlMesh, shape: &QasShape) -> Result<Option<AtRest>, Failure> {
    let patches = match shape.variant {
        QasVariant::Interpolating => TrianglePatches::butterfly(&control.mesh),
        QasVariant::Approximating if control.creases.is_empty() && control.corners.is_empty() => {
            TrianglePatches::of_loop(control, LoopWeights::Loop)
        }
        QasVariant::Approximating => return Ok(None),
    };
    Ok(Some(AtRest::Triangles(Arc::new(
        patches.map_err(Failure::of("surface"))?,
    ))))
}

/// The approximation of a Loop surface with creases, from samples of it.
fn qas_of_sharp(control: &ControlMesh) -> Result<Arc<dyn Surface>, Failure> {
    let settings = SubdivisionSettings {
        scheme: SubdivisionScheme::Loop(LoopWeights::Loop),
        ..SubdivisionSettings::default()
    };
    let limit = Subdivision::new(control, settings).map_err(Failure::of("surface"))?;
    let samples = LimitSamples::of_surface(limit.topology(), |at| limit.frame(at));
    let patches = TrianglePatches::quadratic(limit.topology(), &samples).map_err(Failure::of("surface"))?;
    Ok(Arc::new(patches))
}

fn pn_triangles(control: &ControlMesh) -> Result<AtRest, Failure> {
    let normals = match control.mesh.corners.normals {
        Some(_) => CornerNormals::OfMesh,
        None => CornerNormals::AngleWeighted,
    };
    let patches = TrianglePatches::point_normal(&control.mesh, normals);
    Ok(AtRest::Triangles(Arc::new(patches.map_err(Failure::of("surface"))?)))
}

fn gaussian_product(control: &ControlMesh, covariances: &[[f64; 6]], shape: &GaussianShape) -> Result<AtRest, Failure> {
    let matrices: Vec<Symmetric3> = covariances.iter().map(|&c| Symmetric3::from_array(c)).collect();
    // They have been checked; between keys of a motion they may be a little flatter.
    let (mesh, _) = CovarianceMesh::new(control.clone(), &matrices, Conditioning::Floor)
        .map_err(Failure::of("surface.covariances"))?;
    let settings = GaussianSettings {
        scheme: match shape.scheme {
            GaussianScheme::CatmullClark => SubdivisionScheme::CatmullClark,
            GaussianScheme::Loop => SubdivisionScheme::Loop(LoopWeights::Loop),
            GaussianScheme::LoopWarren => SubdivisionScheme::Loop(LoopWeights::Warren),
        },
        isolation: shape.isolation,
        solver: match shape.solver {
            crate::scene::Solver::Ldlt => Solver::Ldlt,
            crate::scene::Solver::Adjugate => Solver::Adjugate,
        },
    };
    let surface = GaussianProduct::new(&mesh, settings).map_err(Failure::of("surface"))?;
    Ok(AtRest::Gaussian(Arc::new(surface)))
}

/// A kind of surface that is parsed and not made.
#[derive(Debug, thiserror::Error)]
#[error("{0} are not drawn yet; expected Flat")]
pub(crate) struct NotYet(&'static str);

fn not_yet(what: &'static str) -> Failure {
    Failure::of("surface")(NotYet(what))
}

#[cfg(test)]
#[path = "control_surfaces_tests.rs"]
mod tests;
