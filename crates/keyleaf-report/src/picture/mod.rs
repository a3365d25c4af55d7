//! How alike two pictures are, over all pixels or those that something was drawn to.
//!
//! | measure | is |
//! |---|---|
//! | [`psnr`] | the peak signal-to-noise ratio, in decibels: what the theses print |
//! | [`structural_similarity`] | SSIM: luminance, contrast and structure in a window, as the eye compares them |
//!
//! A background that both pictures share flatters both measures; a [`Mask`] leaves it out.

mod psnr;
mod similarity;

pub use psnr::psnr;
pub use similarity::structural_similarity;

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// A picture: four bytes a pixel, red, green, blue and something that is ignored, row by row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Picture<'a> {
    width: usize,
    pixels: &'a [[u8; 4]],
}

/// The pixels that count.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mask(Vec<bool>);

/// Both measures.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PictureError {
    /// Decibels; `None` for equal pictures, whose ratio is infinite.
    pub psnr: Option<f64>,
    /// From −1 to 1; 1 for equal pictures.
    pub ssim: f64,
    /// The part of the pixels that counted.
    pub covered: f64,
}

/// Why pictures cannot be compared.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum PictureFault {
    /// Bytes and size do not fit.
    #[error("{bytes} bytes are no picture of {width} x {height} pixels: expected four bytes a pixel")]
    Size {
        /// Bytes that were given.
        bytes: usize,
        /// Pixels a row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// They, or the mask, have other sizes.
    #[error("pictures or mask have different sizes, {0} and {1} pixels: expected one size")]
    Different(usize, usize),
    /// The mask is empty.
    #[error("no pixel counts: does the view see the surface?")]
    Nothing,
}

impl<'a> Picture<'a> {
    /// A picture in bytes.
    ///
    /// # Errors
    /// [`PictureFault::Size`] if there are not four bytes a pixel, or no pixels.
    pub fn new(bytes: &'a [u8], [width, height]: [u32; 2]) -> Result<Self, PictureFault> {
        let (pixels, rest) = bytes.as_chunks::<4>();
        let expected = u64::from(width) * u64::from(height);
        if !rest.is_empty() || pixels.len() as u64 != expected || expected == 0 {
            let bytes = bytes.len();
            return Err(PictureFault::Size { bytes, width, height });
        }
        Ok(Self {
            width: width as usize,
            pixels,
        })
    }

    fn height(&self) -> usize {
        self.pixels.len() / self.width
    }

    /// Its pixels that are not of this red, green and blue.
    pub fn differing_from(&self, background: [u8; 3]) -> Mask {
        Mask(self.pixels.iter().map(|p| p[..3] != background).collect())
    }
}

impl Mask {
    /// From a flag a pixel, row by row.
    pub fn new(pixels: Vec<bool>) -> Self {
        Self(pixels)
    }

    /// All pixels of a picture.
    pub fn everything(picture: &Picture<'_>) -> Self {
        Self(vec![true; picture.pixels.len()])
    }

    /// The pixels of either: what one picture lacks counts as well.
    ///
    /// # Errors
    /// [`PictureFault::Different`] if the sizes differ.
    pub fn or(&self, other: &Self) -> Result<Self, PictureFault> {
        if self.0.len() != other.0.len() {
            return Err(PictureFault::Different(self.0.len(), other.0.len()));
        }
        Ok(Self(self.0.iter().zip(&other.0).map(|(a, b)| *a || *b).collect()))
    }

    /// The part of the pixels that count.
    pub fn covered(&self) -> f64 {
        self.0.iter().filter(|counts| **counts).count() as f64 / self.0.len().max(1) as f64
    }
}

/// Compares a picture with a reference by both measures.
///
/// # Errors
/// [`PictureFault`] if sizes differ or nothing counts.
///
/// ```
/// use keyleaf_report::picture::{Mask, Picture, picture_error};
/// let grey = [100u8, 100, 100, 255].repeat(16 * 16);
/// let lighter = [101u8, 101, 101, 255].repeat(16 * 16);
/// let [picture, reference] = [Picture::new(&grey, [16, 16])?, Picture::new(&lighter, [16, 16])?];
/// let error = picture_error(&picture, &reference, &Mask::everything(&picture))?;
/// assert!((error.psnr.unwrap() - 48.13).abs() < 0.01 && error.ssim > 0.99);
/// # Ok::<(), keyleaf_report::picture::PictureFault>(())
/// ```
pub fn picture_error(
    picture: &Picture<'_>,
    reference: &Picture<'_>,
    mask: &Mask,
) -> Result<PictureError, PictureFault> {
    let decibels = psnr(picture, reference, mask)?;
    Ok(PictureError {
        psnr: decibels.is_finite().then_some(decibels),
        ssim: structural_similarity(picture, reference, mask)?,
        covered: mask.covered(),
    })
}

fn check(picture: &Picture<'_>, reference: &Picture<'_>, mask: &Mask) -> Result<(), PictureFault> {
    let size = picture.pixels.len();
    for other in [reference.pixels.len(), mask.0.len()] {
        if other != size || reference.width != picture.width {
            return Err(PictureFault::Different(size, other));
        }
    }
    if mask.0.contains(&true) {
        Ok(())
    } else {
        Err(PictureFault::Nothing)
    }
}

#[cfg(test)]
mod tests;
