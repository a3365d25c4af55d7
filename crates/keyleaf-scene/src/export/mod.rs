//! Writes triangles to OBJ, PLY and STL files, so that the bits of every f32 survive, and never a part of a file.
//!
//! OBJ and PLY are text with the shortest digits that read back as the same f32; STL is binary. The file is written
//! under another name in the same folder and renamed when it is whole.

mod atomic;
mod obj;
mod ply;
mod stl;
#[cfg(test)]
mod tests;

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::error::extension;

pub use atomic::write_whole;

/// The file types of exports, as an error lists them.
pub const EXPORT_EXTENSIONS: &str = ".obj, .ply, .stl";

/// Triangles to be written.
#[derive(Debug, Clone, Copy, Default)]
pub struct ExportMesh<'a> {
    /// Positions of the vertices, finite.
    pub positions: &'a [[f32; 3]],
    /// Unit normals of the vertices: as many as positions, or none. STL has no room for them.
    pub normals: Option<&'a [[f32; 3]]>,
    /// Vertices of the triangles, anticlockwise seen from outside.
    pub triangles: &'a [[u32; 3]],
}

/// Why nothing was written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The name ends in something that no exporter knows.
    #[error("{}: unknown file type '{extension}'; expected one of {EXPORT_EXTENSIONS}", file.display())]
    UnknownExtension {
        /// The file.
        file: PathBuf,
        /// What the name ends in.
        extension: String,
    },
    /// A position or normal is NaN or infinite.
    #[error("{}: {what} {index} is not finite; nothing is written", file.display())]
    NotFinite {
        /// The file.
        file: PathBuf,
        /// `position` or `normal`.
        what: &'static str,
        /// Which one.
        index: usize,
    },
    /// A triangle names a vertex that is not there, or there are more or fewer normals than positions.
    #[error("{}: {problem}; nothing is written", file.display())]
    Inconsistent {
        /// The file.
        file: PathBuf,
        /// What does not fit.
        problem: String,
    },
    /// The system refused.
    #[error("{}: cannot be written: {source}", file.display())]
    Write {
        /// The file.
        file: PathBuf,
        /// What it said.
        source: io::Error,
    },
}

/// Writes triangles; the ending of the name tells the format.
///
/// # Errors
/// [`ExportError`]; the file is then as it was before.
///
/// ```
/// use keyleaf_scene::{ExportMesh, write_mesh};
/// let triangle = ExportMesh {
///     positions: &[[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.0, 1e-20, 0.0]],
///     normals: None,
///     triangles: &[[0, 1, 2]],
/// };
/// let file = std::env::temp_dir().join("keyleaf-scene-doc.obj");
/// write_mesh(&file, &triangle)?;
/// assert!(std::fs::read_to_string(&file)?.contains("v 0.1 0 0\n"));
/// # std::fs::remove_file(&file)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_mesh(file: &Path, mesh: &ExportMesh<'_>) -> Result<(), ExportError> {
    let write = match extension(file).as_str() {
        "obj" => obj::write,
        "ply" => ply::write,
        "stl" => stl::write,
        other => {
            let extension = other.to_owned();
            return Err(ExportError::UnknownExtension {
                file: file.to_path_buf(),
                extension,
            });
        }
    };
    check(file, mesh)?;
    write_whole(file, |out| write(out, mesh)).map_err(|source| ExportError::Write {
        file: file.to_path_buf(),
        source,
    })
}

fn check(file: &Path, mesh: &ExportMesh<'_>) -> Result<(), ExportError> {
    let normals = mesh.normals.unwrap_or_default();
    for (what, list) in [("position", mesh.positions), ("normal", normals)] {
        if let Some(index) = list.iter().position(|v| !v.iter().all(|c| c.is_finite())) {
            return Err(ExportError::NotFinite {
                file: file.to_path_buf(),
                what,
                index,
            });
        }
    }
    let inconsistent = |problem| {
        Err(ExportError::Inconsistent {
            file: file.to_path_buf(),
            problem,
        })
    };
    let count = mesh.positions.len();
    if mesh.normals.is_some() && normals.len() != count {
        return inconsistent(format!("{} normals for {count} positions", normals.len()));
    }
    match mesh
        .triangles
        .iter()
        .position(|t| t.iter().any(|&v| v as usize >= count))
    {
        None => Ok(()),
        Some(index) => inconsistent(format!(
            "triangle {index} refers to a vertex beyond the {count} there are"
        )),
    }
}
