//! Samples of heights on a grid.

use crate::{HeightMapError, TextureData};
use std::sync::Arc;

/// The longest side of a height map: what a texture has at least on every device.
pub const MAX_MAP_SIDE: u32 = 8192;

/// Heights on a grid of at least 2 × 2 samples, row 0 on top. Cheap to clone.
///
/// ```
/// use keyleaf_surface::HeightMap;
/// let map = HeightMap::new(3, 2, vec![0.0, 1.0, 2.0, 10.0, 11.0, 12.0])?;
/// assert_eq!(map.sample(2, 0), 12.0); // counted from below
/// # Ok::<(), keyleaf_surface::HeightMapError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct HeightMap {
    texels: Arc<TextureData>,
}

impl HeightMap {
    /// A map of `width` columns and `height` rows, row by row from the top.
    ///
    /// # Errors
    /// [`HeightMapError`] if it is too small or too large, the number of samples is wrong, or one is not finite (voids are filled
    /// before).
    pub fn new(width: u32, height: u32, samples: Vec<f32>) -> Result<Self, HeightMapError> {
        if width < 2 || height < 2 {
            return Err(HeightMapError::TooSmall { width, height });
        }
        if width > MAX_MAP_SIDE || height > MAX_MAP_SIDE {
            return Err(HeightMapError::TooLarge {
                width,
                height,
                limit: MAX_MAP_SIDE,
            });
        }
        if samples.len() != width as usize * height as usize {
            return Err(HeightMapError::SampleCount {
                width,
                height,
                found: samples.len(),
            });
        }
        let is_small = |sample: &f32| sample.abs() <= 1e15;
        if let Some(index) = samples.iter().position(|sample| !is_small(sample)) {
            let (column, row) = (index as u32 % width, index as u32 / width);
            return Err(HeightMapError::Sample {
                column,
                row,
                value: samples[index],
            });
        }
        Ok(Self {
            texels: Arc::new(TextureData {
                width,
                height,
                channels: 1,
                mips: vec![samples],
            }),
        })
    }

    /// Columns.
    pub fn width(&self) -> u32 {
        self.texels.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.texels.height
    }

    /// The sample in column `i` and row `j` counted from below; both must exist.
    pub fn sample(&self, i: u32, j: u32) -> f32 {
        self.texels.mips[0][((self.height() - 1 - j) * self.width() + i) as usize]
    }

    /// The samples as a texture.
    pub(crate) fn texture(&self) -> Arc<TextureData> {
        self.texels.clone()
    }

    /// A sample anywhere: beyond the rim, the linear continuation of the two samples next to it.
    pub(crate) fn continued(&self, i: i64, j: i64) -> f64 {
        let [last_i, last_j] = [self.width(), self.height()].map(|n| i64::from(n) - 1);
        let steps = |at: i64, last: i64| {
            if at < 0 {
                (0, 1, -at)
            } else {
                (last, last - 1, (at - last).max(0))
            }
        };
        let (rim, inner, beyond) = steps(j, last_j);
        if beyond > 0 {
            let (rim, inner) = (self.continued(i, rim), self.continued(i, inner));
            return rim + (rim - inner) * beyond as f64;
        }
        let (rim, inner, beyond) = steps(i, last_i);
        if beyond > 0 {
            let (rim, inner) = (self.continued(rim, j), self.continued(inner, j));
            return rim + (rim - inner) * beyond as f64;
        }
        f64::from(self.sample(i as u32, j as u32))
    }

    /// A sample anywhere: beyond the rim, the map again.
    pub(crate) fn repeated(&self, i: i64, j: i64) -> f64 {
        let wrap = |at: i64, count: u32| at.rem_euclid(i64::from(count)) as u32;
        f64::from(self.sample(wrap(i, self.width()), wrap(j, self.height())))
    }

    /// A sample anywhere: beyond the rim, the sample on the rim.
    pub(crate) fn clamped(&self, i: i64, j: i64) -> f64 {
        let clamp = |at: i64, count: u32| at.clamp(0, i64::from(count) - 1) as u32;
        f64::from(self.sample(clamp(i, self.width()), clamp(j, self.height())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rim_is_continued_repeated_or_clamped() {
        let map = HeightMap::new(3, 2, vec![0.0, 1.0, 3.0, 10.0, 11.0, 13.0]).unwrap();
        assert_eq!(map.continued(3, 0), 15.0);
        assert_eq!(map.continued(-2, 1), -2.0);
        assert_eq!(map.continued(-1, 2), -11.0);
        assert_eq!(map.repeated(-1, 2), 13.0);
        assert_eq!(map.clamped(7, -3), 13.0);
    }

    #[test]
    fn maps_that_fit_no_texture_or_have_voids_are_refused() {
        assert!(matches!(
            HeightMap::new(1, 5, vec![0.0; 5]),
            Err(HeightMapError::TooSmall { .. })
        ));
        assert!(matches!(
            HeightMap::new(8193, 2, vec![]),
            Err(HeightMapError::TooLarge { limit: 8192, .. })
        ));
        assert!(matches!(
            HeightMap::new(2, 2, vec![0.0; 3]),
            Err(HeightMapError::SampleCount { found: 3, .. })
        ));
        let error = HeightMap::new(2, 2, vec![0.0, 0.0, f32::NAN, 0.0]);
        assert!(matches!(error, Err(HeightMapError::Sample { column: 0, row: 1, .. })));
    }
}
