//! Models: OBJ, glTF, PLY, STL and OFF files as one welded polygon mesh with one material, or as a control mesh.
//!
//! Right-handed, Y up, metres, as the file has them: nothing is turned or scaled. Faces run anticlockwise seen from
//! outside. Texture coordinates have v = 0 at the bottom of the picture. Colours are linear RGBA.

mod control;
#[cfg(test)]
mod control_tests;
mod covariances;
mod gltf;
mod gltf_data;
#[cfg(test)]
mod gltf_tests;
mod join;
mod mtl;
mod obj;
mod obj_tags;
mod off;
mod ply;
mod ply_values;
pub(crate) mod sharpness;
mod stl;
#[cfg(test)]
mod tests;

use std::path::Path;

use keyleaf_surface::PolygonMesh;

use crate::error::{ImportError, extension, read_file};
use crate::material::SurfaceMaterial;
use crate::note::Note;
use crate::soup::Soup;
use crate::weld::weld;

pub use control::{ControlMeshOptions, ControlModel, CovarianceSource, read_control_mesh};
pub use covariances::read_covariances;

/// The file types of models, as an error lists them.
pub const MODEL_EXTENSIONS: &str = ".obj, .gltf, .glb, .ply, .stl, .off";

/// A model file, read.
#[derive(Debug, Clone)]
pub struct Model {
    /// Welded and checked: `Topology::new` accepts it.
    pub mesh: PolygonMesh,
    /// The one material; where the file has several, base colours are in the corner colours and pictures are joined.
    pub material: SurfaceMaterial,
    /// What was done to the file.
    pub notes: Vec<Note>,
}

/// How a model is read.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct ModelOptions {
    /// Texture coordinates stay as the file has them: of a model with several pictures none is drawn.
    pub keep_uvs: bool,
}

/// Whether a file name ends in one of [`MODEL_EXTENSIONS`].
pub fn is_model(file: &Path) -> bool {
    matches!(extension(file).as_str(), "obj" | "gltf" | "glb" | "ply" | "stl" | "off")
}

/// Reads a model; the ending of its name tells the format.
///
/// # Errors
/// [`ImportError`] names the file, the place and the reason. Nothing panics, whatever the bytes are.
///
/// ```
/// use keyleaf_scene::{ModelOptions, read_model};
/// let error = read_model("no/such/cow.obj".as_ref(), &ModelOptions::default()).unwrap_err();
/// assert!(error.to_string().starts_with("no/such/cow.obj: cannot be read"));
/// ```
pub fn read_model(file: &Path, options: &ModelOptions) -> Result<Model, ImportError> {
    decode(file, &read_bytes(file)?, options)
}

/// The bytes of a file whose name ends as those of models do.
fn read_bytes(file: &Path) -> Result<Vec<u8>, ImportError> {
    if !is_model(file) {
        return Err(ImportError::UnknownExtension {
            file: file.to_path_buf(),
            extension: extension(file),
            expected: MODEL_EXTENSIONS,
        });
    }
    read_file(file)
}

/// Reads a model from the bytes of `file`; what it refers to is looked for beside `file`.
fn decode(file: &Path, bytes: &[u8], options: &ModelOptions) -> Result<Model, ImportError> {
    let mut notes = Vec::new();
    let ModelFile { soup, materials, .. } = decode_polygons(file, bytes, &mut notes)?;
    let welded = weld(file, &soup, &mut notes)?;
    let mut mesh = welded.mesh;
    let material = join::join(
        file,
        &mut mesh,
        &welded.materials,
        &materials,
        options.keep_uvs,
        &mut notes,
    );
    Ok(Model { mesh, material, notes })
}

/// What a file states, before anything is welded.
struct ModelFile {
    soup: Soup,
    materials: Vec<SurfaceMaterial>,
    /// Subdivision tags: lines with their numbers.
    tags: Vec<(usize, String)>,
}

fn decode_polygons(file: &Path, bytes: &[u8], notes: &mut Vec<Note>) -> Result<ModelFile, ImportError> {
    let plain = |soup: Soup| ModelFile {
        soup,
        materials: vec![SurfaceMaterial::default()],
        tags: Vec::new(),
    };
    Ok(match extension(file).as_str() {
        "obj" => {
            let obj::Obj { soup, materials, tags } = obj::read(file, bytes, notes)?;
            ModelFile { soup, materials, tags }
        }
        "ply" => plain(ply::read(file, bytes, notes)?),
        "stl" => plain(stl::read(file, bytes, notes)?),
        "off" => plain(off::read(file, bytes, notes)?),
        _ => {
            let read = gltf::read(file, bytes, notes)?;
            ModelFile {
                materials: read.materials,
                ..plain(read.soup)
            }
        }
    })
}
