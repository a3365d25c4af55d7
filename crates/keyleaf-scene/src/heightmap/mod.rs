//! Height maps: PNG (8 and 16 bits), TIFF (integers and floats), OpenEXR, raw 16 bits.
//!
//! Samples are kept as the file has them, in f32, which is exact for all 8- and 16-bit integers: the vertical unit is
//! one quantum of the file. Voids (samples that the sensor did not see) are found by the rules of [`voids`] and filled
//! smoothly from the samples around them, so that nothing drawn is a spike.

mod decode;
mod fill;
mod sidecar;
#[cfg(test)]
mod tests;
mod voids;

use std::path::Path;

use glam::DVec2;

use crate::error::{ImportError, extension};
use crate::note::Note;

pub use sidecar::Sidecar;

/// The file types of height maps, as an error lists them.
pub const HEIGHT_MAP_EXTENSIONS: &str = ".png, .tif, .tiff, .exr, .r16, .raw";

/// The largest side that default limits of a GPU allow, in samples; a larger map gets a warning.
pub const USUAL_MAX_SIDE: usize = 8192;

/// What a height map file cannot tell itself.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct HeightMapOptions {
    /// Width and height in samples of a raw file; `None`: a square one.
    pub raw_size: Option<[u32; 2]>,
    /// A sample value that means "not known", besides those that are recognised.
    pub void_value: Option<f32>,
}

/// A height map, read, its voids filled.
#[derive(Debug, Clone)]
pub struct HeightMap {
    /// Samples a row (west to east), at least 2.
    pub width: usize,
    /// Rows (north to south), at least 2.
    pub height: usize,
    /// Sample values, row by row, row 0 at the top of the picture (north). Finite.
    pub samples: Vec<f32>,
    /// How many samples were voids and are filled.
    pub voids: usize,
    /// Distance of samples in metres, east and north, if the file's sidecar tells.
    pub spacing: Option<DVec2>,
    /// What was found and done.
    pub notes: Vec<Note>,
}

impl HeightMap {
    /// Smallest and largest sample.
    pub fn range(&self) -> (f32, f32) {
        self.samples
            .iter()
            .fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), &s| (low.min(s), high.max(s)))
    }

    /// The spacing that the file tells, else one for which the relief is a sixth of the larger side (1 for a flat
    /// map); `scale` is the height of one unit of the samples in metres.
    pub fn spacing_or_default(&self, scale: f64) -> DVec2 {
        self.spacing.unwrap_or_else(|| {
            let (low, high) = self.range();
            let relief = f64::from(high - low) * scale.abs();
            let steps = self.width.max(self.height) - 1;
            DVec2::splat(if relief > 0.0 { RELIEF_TO_SIDE * relief / steps as f64 } else { 1.0 })
        })
    }
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
pub fn read_height_map(file: &Path, options: &HeightMapOptions) -> Result<HeightMap, ImportError> {
    let mut notes = Vec::new();
    let mut raster = decode::decode(file, options, &mut notes)?;
    let (width, height) = (raster.width, raster.height);
    if width < 2 || height < 2 {
        let reason = format!("a height map needs at least 2x2 samples, this one has {width}x{height}");
        return Err(ImportError::empty(file, reason));
    }
    if width.max(height) > USUAL_MAX_SIDE {
        let text = format!(
            "{width}x{height} samples: many devices take at most {USUAL_MAX_SIDE} a side; scale or cut the map"
        );
        notes.push(Note::warning(file, text));
    }
    let sidecar = sidecar::Sidecar::read_beside(file)?;
    let listed = sidecar.as_ref().and_then(|s| s.voids.as_deref());
    let mask = voids::find(file, &raster, options.void_value, listed, &mut notes)?;
    let count = mask.iter().filter(|&&v| v).count();
    if count == mask.len() {
        return Err(ImportError::empty(file, "all samples of the height map are voids"));
    }
    if count > 0 {
        fill::fill(&mut raster.samples, &mask, width);
        let percent = 100.0 * count as f64 / mask.len() as f64;
        notes.push(Note::note(file, format!("{count} voids ({percent:.2} %) are filled")));
    }
    let spacing = sidecar.and_then(|s| s.spacing(file, &mut notes));
    Ok(HeightMap { width, height, samples: raster.samples, voids: count, spacing, notes })
}
