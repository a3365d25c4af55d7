//! Structural similarity (Wang, Bovik, Sheikh, Simoncelli 2004: *Image quality assessment: from error visibility to structural
//! similarity*), with the constants and the Gaussian window of that paper.

use super::{Mask, Picture, PictureFault, check};

/// Standard deviation of the window in pixels.
const SIGMA: f64 = 1.5;
/// Taps on each side of its middle: 11 in all.
const RADIUS: usize = 5;
/// (K1 L)² and (K2 L)², for values in 0..=1.
const C1: f64 = 0.01 * 0.01;
const C2: f64 = 0.03 * 0.03;

/// The mean SSIM of luma (Rec. 709 weights) over the pixels that count, from −1 to 1; 1 for equal pictures.
///
/// At the border of the picture the window is cut off and its weights are scaled, so that every pixel has a value. At the border of the
/// mask the window reaches over it: a silhouette that is off counts.
///
/// # Errors
/// [`PictureFault`] if sizes differ or nothing counts.
pub fn structural_similarity(picture: &Picture<'_>, reference: &Picture<'_>, mask: &Mask) -> Result<f64, PictureFault> {
    check(picture, reference, mask)?;
    let size = [picture.width, picture.height()];
    let (a, b) = (luma(picture), luma(reference));
    let products = |x: &[f64], y: &[f64]| -> Vec<f64> { x.iter().zip(y).map(|(x, y)| x * y).collect() };
    let blurred = [
        a.clone(),
        b.clone(),
        products(&a, &a),
        products(&b, &b),
        products(&a, &b),
    ]
    .map(|v| blur(v, size));
    let [mean_a, mean_b, aa, bb, ab] = blurred;
    let at = |i: usize| {
        let (x, y) = (mean_a[i], mean_b[i]);
        let (variance_x, variance_y) = ((aa[i] - x * x).max(0.0), (bb[i] - y * y).max(0.0));
        let covariance = ab[i] - x * y;
        (2.0 * x * y + C1) * (2.0 * covariance + C2) / ((x * x + y * y + C1) * (variance_x + variance_y + C2))
    };
    let counting: Vec<usize> = (0..a.len()).filter(|i| mask.0[*i]).collect();
    Ok(counting.iter().map(|i| at(*i)).sum::<f64>() / counting.len() as f64)
}

fn luma(picture: &Picture<'_>) -> Vec<f64> {
    let value = |p: &[u8; 4]| 0.2126 * f64::from(p[0]) + 0.7152 * f64::from(p[1]) + 0.0722 * f64::from(p[2]);
    picture.pixels.iter().map(|p| value(p) / 255.0).collect()
}

/// Weighted means under the window, along rows and then along columns.
fn blur(values: Vec<f64>, [width, height]: [usize; 2]) -> Vec<f64> {
    let along_rows = convolve(&values, width, 1, height, width);
    convolve(&along_rows, height, width, width, 1)
}

/// Convolves `lines` lines of `length` values that are `step` apart; lines begin `stride` apart.
fn convolve(values: &[f64], length: usize, step: usize, lines: usize, stride: usize) -> Vec<f64> {
    let weights: [f64; RADIUS + 1] = std::array::from_fn(|i| (-0.5 * (i as f64 / SIGMA).powi(2)).exp());
    let mut result = vec![0.0; values.len()];
    for line in 0..lines {
        for i in 0..length {
            let (mut sum, mut total) = (0.0, 0.0);
            for j in i.saturating_sub(RADIUS)..(i + RADIUS + 1).min(length) {
                let weight = weights[i.abs_diff(j)];
                sum += weight * values[line * stride + j * step];
                total += weight;
            }
            result[line * stride + i * step] = sum / total;
        }
    }
    result
}
