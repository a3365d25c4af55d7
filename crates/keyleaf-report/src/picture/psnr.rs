//! The peak signal-to-noise ratio.

use super::{Mask, Picture, PictureFault, check};

/// How far a picture is from another, in decibels: 10 log10(255² / mean squared difference) over red, green and blue of the pixels that
/// count. Infinite for equal pictures.
///
/// # Errors
/// [`PictureFault`] if sizes differ or nothing counts.
pub fn psnr(picture: &Picture<'_>, reference: &Picture<'_>, mask: &Mask) -> Result<f64, PictureFault> {
    check(picture, reference, mask)?;
    let pairs = picture.pixels.iter().zip(reference.pixels).zip(&mask.0);
    let (mut sum, mut count) = (0u64, 0u64);
    for ((a, b), _) in pairs.filter(|(_, counts)| **counts) {
        sum += (0..3).map(|c| u64::from(a[c].abs_diff(b[c])).pow(2)).sum::<u64>();
        count += 3;
    }
    Ok(10.0 * (255.0 * 255.0 * count as f64 / sum as f64).log10())
}
