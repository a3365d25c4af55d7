//! Bézier and NURBS surfaces of files: `.bpt`, Newell's tea set, and the free-form surfaces of Wavefront OBJ.
//!
//! Positions are as the file has them: nothing is turned or scaled. The first parameter, u, runs fastest in the lists of control
//! points. Surfaces are whole: trimming curves are refused or, if asked for, ignored.

mod bpt;
mod lines;
mod obj;
mod obj_surface;
#[cfg(test)]
mod obj_tests;
mod teaset;
#[cfg(test)]
mod tests;

use std::io::Read;
use std::path::Path;

use keyleaf_surface::NurbsSurface;

use crate::error::{ImportError, extension, read_file};
use crate::note::Note;

/// The file types of patches, as an error lists them.
pub const PATCH_EXTENSIONS: &str = ".bpt, .teaset, .dat, .obj, or none for a file of the tea set";

/// So much of a file without an ending is read to recognise it, bytes.
const RECOGNISED_BY: u64 = 4096;

/// A file of Bézier or NURBS surfaces, read.
#[derive(Debug, Clone, PartialEq)]
pub struct PatchModel {
    /// The surfaces, in the order of the file.
    pub surfaces: Vec<NurbsSurface>,
    /// Their names: those of the file, else `patch 1` and so on. Several may have the same.
    pub names: Vec<String>,
    /// Whether every surface is one Bézier patch.
    pub is_bezier: bool,
    /// What was done to the file.
    pub notes: Vec<Note>,
}

/// How a file of patches is read.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct PatchFileOptions {
    /// Trimmed surfaces are read whole; else they are refused.
    pub ignore_trims: bool,
}

/// Whether a file holds patches: by the ending of its name, and where that does not tell, by its content. Without an ending a file
/// is one of the tea set or none; an OBJ file holds patches if it has a `surf` statement.
pub fn is_patch_file(file: &Path) -> bool {
    match extension(file).as_str() {
        "bpt" | "teaset" | "dat" => true,
        "obj" => read_file(file).is_ok_and(|bytes| obj::has_surfaces(&bytes)),
        "" => first_bytes(file).is_some_and(|bytes| teaset::is_teaset(&bytes)),
        _ => false,
    }
}

fn first_bytes(file: &Path) -> Option<Vec<u8>> {
    let mut bytes = Vec::new();
    let opened = std::fs::File::open(file).ok()?;
    opened.take(RECOGNISED_BY).read_to_end(&mut bytes).ok()?;
    Some(bytes)
}

/// Reads the surfaces of a file; the ending of its name tells the format.
///
/// # Errors
/// [`ImportError`] names the file, the line and the reason. Nothing panics, whatever the bytes are.
///
/// ```
/// use keyleaf_scene::{PatchFileOptions, read_patches};
/// let file = std::env::temp_dir().join("keyleaf-doc.bpt");
/// std::fs::write(&file, "1\n1 1\n0 0 0\n1 0 0\n0 1 0\n1 1 0.5\n")?;
/// let model = read_patches(&file, &PatchFileOptions::default())?;
/// assert!(model.is_bezier);
/// assert_eq!(model.surfaces[0].frame(0.5, 0.5)?.position.z, 0.125);
/// # std::fs::remove_file(file)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn read_patches(file: &Path, options: &PatchFileOptions) -> Result<PatchModel, ImportError> {
    if !matches!(extension(file).as_str(), "bpt" | "teaset" | "dat" | "obj" | "") {
        return Err(ImportError::UnknownExtension {
            file: file.to_path_buf(),
            extension: extension(file),
            expected: PATCH_EXTENSIONS,
        });
    }
    decode(file, &read_file(file)?, options)
}

/// Reads surfaces from the bytes of `file`.
fn decode(file: &Path, bytes: &[u8], options: &PatchFileOptions) -> Result<PatchModel, ImportError> {
    let text = String::from_utf8_lossy(bytes);
    let mut notes = Vec::new();
    let (surfaces, names) = match extension(file).as_str() {
        "obj" => obj::read(file, &text, options, &mut notes)?,
        "bpt" => numbered(bpt::read(file, &text)?),
        _ => numbered(teaset::read(file, &text)?),
    };
    let is_bezier = surfaces.iter().all(is_bezier_patch);
    Ok(PatchModel {
        surfaces,
        names,
        is_bezier,
        notes,
    })
}

fn numbered(surfaces: Vec<NurbsSurface>) -> (Vec<NurbsSurface>, Vec<String>) {
    let names = (1..=surfaces.len()).map(patch_name).collect();
    (surfaces, names)
}

/// The name of a surface without one, counted from 1.
fn patch_name(number: usize) -> String {
    format!("patch {number}")
}

/// Whether a surface is one Bézier patch: degree + 1 equal knots at both ends, and none between.
fn is_bezier_patch(surface: &NurbsSurface) -> bool {
    (0..2).all(|axis| {
        let order = surface.degree()[axis] as usize + 1;
        let knots = surface.knots()[axis];
        let (start, end) = knots.split_at(order.min(knots.len()));
        let equal = |knots: &[f64]| knots.windows(2).all(|pair| pair[0] == pair[1]);
        end.len() == order && equal(start) && equal(end)
    })
}
