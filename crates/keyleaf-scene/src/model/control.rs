//! Control meshes of subdivision surfaces: models whose polygons are not drawn themselves.

use std::path::{Path, PathBuf};

use keyleaf_surface::{BoundaryRule, ControlMesh, Creasing, PolygonMesh};

use crate::error::ImportError;
use crate::material::SurfaceMaterial;
use crate::note::Note;
use crate::weld::weld_control;

use super::covariances::read_covariances;
use super::obj_tags::{self, Tags};
use super::sharpness::{add_corners, add_creases};
use super::{ModelFile, decode_polygons, join, read_bytes};

/// A control mesh, read.
#[derive(Debug, Clone)]
pub struct ControlModel {
    /// Polygons as the file has them, with the sharpness that its tags state. `Topology::new` accepts it.
    pub control: ControlMesh,
    /// The covariance of each vertex: xx, xy, xz, yy, yz, zz, squares of the model's unit.
    pub covariances: Option<Vec<[f64; 6]>>,
    /// The one material; see [`Model`](super::Model).
    pub material: SurfaceMaterial,
    /// What was found in the file.
    pub notes: Vec<Note>,
    /// Where the covariances are from, if not from the model's file.
    pub covariance_file: Option<PathBuf>,
}

/// How a control mesh is read.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ControlMeshOptions {
    /// Texture coordinates stay as the file has them; see [`ModelOptions`](super::ModelOptions).
    pub keep_uvs: bool,
    /// Where covariances come from.
    pub covariances: CovarianceSource,
    /// The rule for boundaries, whatever the file's tags say.
    pub boundary: Option<BoundaryRule>,
    /// The rule for creases, whatever the file's tags say.
    pub creasing: Option<Creasing>,
}

/// Where the covariances of a control mesh come from.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub enum CovarianceSource {
    /// From the model's file, if it has any (six columns of an OFF file).
    #[default]
    IfAny,
    /// From the model's file, else from the file of the same name that ends in `.cov`; without both it is refused.
    Model,
    /// From this file.
    File(PathBuf),
}

/// Reads a control mesh; the ending of its name tells the format.
///
/// Faces keep their corners, also where they are concave. The vertices of OBJ, OFF and PLY files keep their numbers, and are neither
/// welded nor dropped; those of STL and glTF files are welded where their positions are equal. OBJ files may have OpenSubdiv's tags:
/// `t crease 2/1/0 3 7 2.5`, `t corner 1/1/0 4 10` (vertices from 0), `t interpolateboundary 1/0/0 n` with n = 0 for
/// [`BoundaryRule::None`], 1 for [`BoundaryRule::EdgesAndCorners`], 2 for [`BoundaryRule::Edges`], and `t creasemethod 0/0/1 chaikin`
/// or `normal`. OFF files may have six numbers more a vertex, its covariance.
///
/// # Errors
/// [`ImportError`] names the file, the line and the reason. Nothing panics, whatever the bytes are.
///
/// ```
/// use keyleaf_scene::{ControlMeshOptions, read_control_mesh};
/// let error = read_control_mesh("no/such/cage.obj".as_ref(), &ControlMeshOptions::default()).unwrap_err();
/// assert!(error.to_string().starts_with("no/such/cage.obj: cannot be read"));
/// ```
pub fn read_control_mesh(file: &Path, options: &ControlMeshOptions) -> Result<ControlModel, ImportError> {
    decode(file, &read_bytes(file)?, options)
}

/// Reads a control mesh from the bytes of `file`; what it refers to is looked for beside `file`.
pub(super) fn decode(file: &Path, bytes: &[u8], options: &ControlMeshOptions) -> Result<ControlModel, ImportError> {
    let mut notes = Vec::new();
    let ModelFile { soup, materials, tags } = decode_polygons(file, bytes, &mut notes)?;
    let welded = weld_control(file, &soup, &mut notes)?;
    let mut mesh = welded.mesh;
    let material = join::join(
        file,
        &mut mesh,
        &welded.materials,
        &materials,
        options.keep_uvs,
        &mut notes,
    );
    let tags = obj_tags::parse(file, &tags, mesh.positions.len(), &mut notes)?;
    let control = with_tags(file, mesh, tags, options)?;
    let own = (!soup.covariances.is_empty()).then_some(soup.covariances);
    let vertices = control.mesh.positions.len();
    let (covariances, covariance_file) = covariances(file, own, vertices, &options.covariances)?;
    Ok(ControlModel {
        control,
        covariances,
        material,
        notes,
        covariance_file,
    })
}

fn with_tags(
    file: &Path,
    mesh: PolygonMesh,
    tags: Tags,
    options: &ControlMeshOptions,
) -> Result<ControlMesh, ImportError> {
    let mut control = ControlMesh {
        mesh,
        boundary: options.boundary.or(tags.boundary).unwrap_or_default(),
        creasing: options.creasing.or(tags.creasing).unwrap_or_default(),
        ..ControlMesh::default()
    };
    add_creases(file, &mut control, tags.creases)?;
    add_corners(file, &mut control, tags.corners)?;
    Ok(control)
}

type Found = (Option<Vec<[f64; 6]>>, Option<PathBuf>);

/// The covariances of a model and the file that they are from; `own` are those of its own file.
fn covariances(
    file: &Path,
    own: Option<Vec<[f64; 6]>>,
    vertices: usize,
    source: &CovarianceSource,
) -> Result<Found, ImportError> {
    let from = |path: PathBuf| Ok((Some(read_covariances(&path, vertices)?), Some(path)));
    match source {
        CovarianceSource::File(path) => from(path.clone()),
        CovarianceSource::IfAny => Ok((own, None)),
        CovarianceSource::Model if own.is_some() => Ok((own, None)),
        CovarianceSource::Model => {
            let beside = file.with_extension("cov");
            if beside.is_file() {
                return from(beside);
            }
            let reason = format!(
                "there are no covariances: expected the file {} beside it, or an .off file with six numbers more a vertex",
                beside.file_name().unwrap_or_default().to_string_lossy()
            );
            Err(ImportError::empty(file, reason))
        }
    }
}
