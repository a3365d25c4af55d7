//! The peak signal-to-noise ratio.

use serde_json::{Value, json};

/// How far a picture is from another, in decibels: 10 log10(255² / mean squared difference) over red, green and blue. Infinite for equal
/// pictures. Four bytes a pixel, the last one ignored.
pub fn psnr(picture: &[u8], reference: &[u8]) -> f64 {
    let squares = picture.as_chunks::<4>().0.iter().zip(reference.as_chunks::<4>().0);
    let sum: u64 = squares
        .flat_map(|(a, b)| (0..3).map(move |c| u64::from(a[c].abs_diff(b[c])).pow(2)))
        .sum();
    let count = (picture.len() / 4 * 3).max(1) as f64;
    10.0 * (255.0 * 255.0 * count / sum as f64).log10()
}

/// As a cell of a table.
pub fn cell(decibels: f64) -> String {
    if decibels.is_finite() {
        format!("{decibels:.1}")
    } else {
        "equal".to_owned()
    }
}

/// As JSON, which has no infinity: null for equal pictures.
pub fn value(decibels: f64) -> Value {
    if decibels.is_finite() {
        json!(decibels)
    } else {
        Value::Null
    }
}

#[cfg(test)]
mod tests {
    use super::psnr;

    #[test]
    fn one_level_everywhere_is_48_decibels_and_equal_pictures_are_infinite() {
        let grey = [100u8, 100, 100, 255].repeat(10);
        let lighter = [101u8, 101, 101, 0].repeat(10);
        assert!((psnr(&grey, &lighter) - 20.0 * 255f64.log10()).abs() < 1e-12);
        assert_eq!(psnr(&grey, &grey), f64::INFINITY);
    }
}
