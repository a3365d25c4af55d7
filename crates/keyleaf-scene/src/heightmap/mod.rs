//! Height maps: PNG (8 and 16 bits), TIFF (integers and floats), OpenEXR, raw 16 bits.
//!
//! Samples are kept as the file has them, in f32, which is exact for all 8- and 16-bit integers: the vertical unit is
//! one quantum of the file. Voids (samples that the sensor did not see) are found by rules (`voids.rs`) and filled
//! smoothly from the samples around them, so that nothing drawn is a spike.

mod decode;
mod fill;
mod sidecar;
#[cfg(test)]
mod tests;
mod voids;

use std::path::Path;

use glam::DVec2;
use keyleaf_surface::{HeightMap, HeightMapError};

use crate::error::{FilePlace, ImportError, extension};
use crate::note::Note;

pub use sidecar::Sidecar;

/// The file types of height maps, as an error lists them.
pub const HEIGHT_MAP_EXTENSIONS: &str = ".png, .tif, .tiff, .exr, .r16, .raw";

/// What a height map file cannot tell itself.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct HeightMapOptions {
    /// Width and height in samples of a raw file; `None`: a square one.
    pub raw_size: Option<[u32; 2]>,
    /// A sample value that means "not known", besides those that are recognised.
    pub void_value: Option<f32>,
}

/// A height map file, read, its voids filled.
#[derive(Debug, Clone)]
pub struct HeightMapFile {
    /// The samples, row 0 at the top of the picture (north).
    pub map: HeightMap,
    /// Smallest and largest sample.
    pub range: (f32, f32),
    /// How many samples were voids and are filled.
    pub voids: usize,
    /// Distance of samples in metres, east and north, if the file's sidecar tells.
    pub spacing: Option<DVec2>,
    /// What was found and done.
    pub notes: Vec<Note>,
}

impl HeightMapFile {
    /// The spacing that the file tells, else one for which the relief is a sixth of the larger side (1 for a flat
    /// map); `scale` is the height of one unit of the samples in metres.
    pub fn spacing_or_default(&self, scale: f64) -> DVec2 {
        self.spacing.unwrap_or_else(|| {
            let (low, high) = self.range;
            let relief = (f64::from(high) - f64::from(low)) * scale.abs();
            let steps = f64::from(self.map.width().max(self.map.height()) - 1);
            DVec2::splat(if relief > 0.0 {
                RELIEF_TO_SIDE * relief / steps
            } else {
                1.0
            })
        })
    }
}

/// A picture of displacements, read.
#[derive(Debug, Clone)]
pub struct DisplacementFile {
    /// The samples as the file has them.
    pub map: HeightMap,
    /// The sample that means 1: 255, 65535, or 1 for floats.
    pub full_scale: f64,
    /// What was found.
    pub notes: Vec<Note>,
}

/// How many times its relief the larger side of a map of unknown spacing is.
const RELIEF_TO_SIDE: f64 = 6.0;

/// Whether a file name ends in one of [`HEIGHT_MAP_EXTENSIONS`].
pub fn is_height_map(file: &Path) -> bool {
    matches!(extension(file).as_str(), "png" | "tif" | "tiff" | "exr" | "r16" | "raw")
}

/// Reads a height map with its sidecar, and fills its voids.
///
/// # Errors
/// [`ImportError`] names the file and the reason: unreadable, truncated, an unknown type, smaller than 2×2, no sample
/// that is not a void, a sidecar that does not fit.
pub fn read_height_map(file: &Path, options: &HeightMapOptions) -> Result<HeightMapFile, ImportError> {
    let mut notes = Vec::new();
    let mut raster = decode::decode(file, options, &mut notes)?;
    let sidecar = sidecar::Sidecar::read_beside(file)?;
    let mask = voids::find(file, &raster, options.void_value, sidecar.as_ref(), &mut notes)?;
    let voids = mask.iter().filter(|&&v| v).count();
    if voids == mask.len() {
        return Err(ImportError::empty(file, "all samples of the height map are voids"));
    }
    if voids > 0 {
        fill::fill(&mut raster.samples, &mask, raster.width);
        let percent = 100.0 * voids as f64 / mask.len() as f64;
        notes.push(Note::remark(file, format!("{voids} voids ({percent:.2} %) are filled")));
    }
    let range = raster
        .samples
        .iter()
        .fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), &s| {
            (low.min(s), high.max(s))
        });
    let spacing = sidecar.and_then(|s| s.spacing(file, &mut notes));
    let map = height_map(file, raster)?;
    Ok(HeightMapFile {
        map,
        range,
        voids,
        spacing,
        notes,
    })
}

/// Reads a picture of displacements: like a height map, but no sample is taken for a void.
///
/// # Errors
/// [`ImportError`] as for [`read_height_map`]; samples that are not finite are refused.
pub fn read_displacement(file: &Path) -> Result<DisplacementFile, ImportError> {
    let mut notes = Vec::new();
    let raster = decode::decode(file, &HeightMapOptions::default(), &mut notes)?;
    let full_scale = raster.full_scale;
    Ok(DisplacementFile {
        map: height_map(file, raster)?,
        full_scale,
        notes,
    })
}

fn height_map(file: &Path, raster: decode::Raster) -> Result<HeightMap, ImportError> {
    HeightMap::new(raster.width as u32, raster.height as u32, raster.samples).map_err(|error| {
        let place = match error {
            HeightMapError::Sample { column, row, .. } => FilePlace::Sample {
                row: row as usize,
                column: column as usize,
            },
            _ => FilePlace::Whole,
        };
        ImportError::malformed(file, place, error.to_string())
    })
}
