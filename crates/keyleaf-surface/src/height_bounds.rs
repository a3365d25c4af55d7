//! Bounds of interpolated heights over blocks of cells, as a pyramid. Twin of `shaders/shared/height_bounds.wgsl`.
//!
//! A bicubic cell lies in the hull of its 16 Bézier coefficients, and its derivatives in those of their differences (Farin, *Curves
//! and Surfaces for CAGD*): bounds that include overshoot and are tight where the surface is smooth. Level 0 holds blocks of 4 × 4
//! cells, which costs a texel of 16 bytes for 16 samples; within a block, the slope bounds what the range cannot.

use crate::direction::round_up;
use crate::{Interpolation, TextureData};
use std::sync::Arc;

/// log2 of the cells along a block.
const BLOCK_SHIFT: u32 = 2;

/// Heights and slopes, rounded outwards to f32.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    pub low: f32,
    pub high: f32,
    pub slope: f32,
}

impl Bounds {
    const NOTHING: Self = Self {
        low: f32::INFINITY,
        high: f32::NEG_INFINITY,
        slope: 0.0,
    };

    fn union(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            slope: self.slope.max(other.slope),
        }
    }
}

/// How samples become heights.
#[derive(Clone, Copy, Debug)]
pub struct HeightScale {
    pub interpolation: Interpolation,
    /// height = sample · scale + offset.
    pub scale: f64,
    pub offset: f64,
    /// Height a cell to slope, along the columns and the rows.
    pub slope: [f64; 2],
}

/// The pyramid.
#[derive(Clone, Debug)]
pub struct HeightBounds {
    texture: Arc<TextureData>,
}

impl HeightBounds {
    /// Over `cells` columns and rows of cells, counted from `first`; cell (i, j) lies between samples i, i + 1 and j, j + 1.
    pub fn new(first: i64, cells: [u32; 2], sample: impl Fn(i64, i64) -> f64, scale: HeightScale) -> Self {
        let [width, height] = cells.map(|n| n.div_ceil(1 << BLOCK_SHIFT));
        let mut base = vec![Range::NOTHING; (width * height) as usize];
        let samples_of = |j: i64| -> Vec<f64> {
            (first - 1..first + i64::from(cells[0]) + 2)
                .map(|i| sample(i, first + j))
                .collect()
        };
        let mut rows = [-1, -1, 0, 1].map(samples_of);
        for j in 0..cells[1] {
            rows.rotate_left(1);
            rows[3] = samples_of(i64::from(j) + 2);
            let blocks = &mut base[((j >> BLOCK_SHIFT) * width) as usize..];
            for (i, hull) in cell_row(&rows, scale).into_iter().enumerate() {
                let block = &mut blocks[i >> BLOCK_SHIFT];
                *block = block.union(hull.range(scale));
            }
        }
        let base = base.into_iter().map(|range: Range| range.bounds(scale)).collect();
        Self {
            texture: Arc::new(pyramid(base, width, height)),
        }
    }

    pub fn texture(&self) -> Arc<TextureData> {
        self.texture.clone()
    }

    /// Over all cells from `low` to `high`, from at most 2 × 2 blocks of one level.
    pub fn over_cells(&self, low: [u32; 2], high: [u32; 2]) -> Bounds {
        let (first, last) = (low.map(|c| c >> BLOCK_SHIFT), high.map(|c| c >> BLOCK_SHIFT));
        let count = (last[0] - first[0]).max(last[1] - first[1]);
        let needed = if count <= 1 {
            0
        } else {
            32 - (count - 1).leading_zeros()
        };
        let level = needed.min(self.texture.mips.len() as u32 - 1);
        let ends = [self.texture.width, self.texture.height].map(|n| (n >> level).max(1) - 1);
        let block = |at: [u32; 2]| [0, 1].map(|k| (at[k] >> level).min(ends[k]));
        let (a, b) = (block(first), block(last));
        let texel = |x: u32, y: u32| {
            let start = 4 * (y * (ends[0] + 1) + x) as usize;
            let texels = &self.texture.mips[level as usize];
            Bounds {
                low: texels[start],
                high: texels[start + 1],
                slope: texels[start + 2],
            }
        };
        texel(a[0], a[1])
            .union(texel(b[0], a[1]))
            .union(texel(a[0], b[1]))
            .union(texel(b[0], b[1]))
    }

    /// Over the whole map.
    pub fn of_map(&self) -> Bounds {
        self.over_cells([0, 0], [u32::MAX, u32::MAX])
    }
}

/// The mip levels over `base`: a block takes in those of the level below, the last one of a row also an odd one.
fn pyramid(base: Vec<Bounds>, width: u32, height: u32) -> TextureData {
    let mut levels = vec![base];
    let (mut w, mut h) = (width, height);
    while w > 1 || h > 1 {
        let (next_w, next_h) = ((w / 2).max(1), (h / 2).max(1));
        let mut next = vec![Bounds::NOTHING; (next_w * next_h) as usize];
        for (index, bounds) in (0..).zip(&levels[levels.len() - 1]) {
            let (x, y) = ((index % w / 2).min(next_w - 1), (index / w / 2).min(next_h - 1));
            let block: &mut Bounds = &mut next[(y * next_w + x) as usize];
            *block = block.union(*bounds);
        }
        levels.push(next);
        (w, h) = (next_w, next_h);
    }
    let texels = |level: Vec<Bounds>| level.iter().flat_map(|b| [b.low, b.high, b.slope, 0.0]).collect();
    TextureData {
        width,
        height,
        channels: 4,
        mips: levels.into_iter().map(texels).collect(),
    }
}

/// The hulls of a row of cells from the samples of the rows at -1, 0, 1 and 2, each from one before the first cell.
///
/// In passes over whole rows, which compilers turn into vector instructions.
fn cell_row(rows: &[Vec<f64>; 4], scale: HeightScale) -> Vec<Hull> {
    let count = rows[0].len();
    let mut vertical = [const { Vec::new() }; 4];
    vertical
        .iter_mut()
        .for_each(|coefficients| coefficients.resize(count, 0.0));
    for i in 0..count {
        let coefficients = bezier([rows[0][i], rows[1][i], rows[2][i], rows[3][i]], scale.interpolation);
        (0..4).for_each(|k| vertical[k][i] = coefficients[k]);
    }
    let mut hulls = vec![Hull::NOTHING; count - 3];
    let mut below = vec![[0.0; 4]; count - 3];
    for (k, row) in vertical.iter().enumerate() {
        for (i, (hull, below)) in hulls.iter_mut().zip(&mut below).enumerate() {
            let row = bezier([row[i], row[i + 1], row[i + 2], row[i + 3]], scale.interpolation);
            hull.add_row(row, if k == 0 { row } else { *below });
            *below = row;
        }
    }
    hulls
}

/// The cubic Bézier coefficients between the middle two of four samples.
fn bezier([a, b, c, d]: [f64; 4], interpolation: Interpolation) -> [f64; 4] {
    match interpolation {
        Interpolation::Bicubic => [b, b + (c - a) * (1.0 / 6.0), c - (d - b) * (1.0 / 6.0), c],
        Interpolation::Bilinear => [b, b + (c - b) * (1.0 / 3.0), c - (c - b) * (1.0 / 3.0), c],
    }
}

/// The hull of the Bézier coefficients of samples, and their greatest differences along rows and columns.
#[derive(Clone, Copy)]
struct Hull {
    low: f64,
    high: f64,
    steps: [f64; 2],
}

impl Hull {
    const NOTHING: Self = Self {
        low: f64::INFINITY,
        high: f64::NEG_INFINITY,
        steps: [0.0; 2],
    };

    /// Takes in a row of coefficients, given the one below it.
    fn add_row(&mut self, row: [f64; 4], below: [f64; 4]) {
        let [a, b, c, d] = row;
        let [e, f, g, h] = below;
        let largest = |a, b, c, d| larger(larger(a, b), larger(c, d));
        self.low = smaller(self.low, smaller(smaller(a, b), smaller(c, d)));
        self.high = larger(self.high, largest(a, b, c, d));
        self.steps[0] = largest(self.steps[0], (b - a).abs(), (c - b).abs(), (d - c).abs());
        self.steps[1] = larger(
            self.steps[1],
            largest((a - e).abs(), (b - f).abs(), (c - g).abs(), (d - h).abs()),
        );
    }

    fn range(self, scale: HeightScale) -> Range {
        let [along, across] = [0, 1].map(|k| 3.0 * self.steps[k] * scale.slope[k]);
        Range {
            low: self.low,
            high: self.high,
            squared_slope: along * along + across * across,
        }
    }
}

/// The samples' range over cells and the square of the greatest slope.
#[derive(Clone, Copy)]
struct Range {
    low: f64,
    high: f64,
    squared_slope: f64,
}

impl Range {
    const NOTHING: Self = Self {
        low: f64::INFINITY,
        high: f64::NEG_INFINITY,
        squared_slope: 0.0,
    };

    fn union(self, other: Self) -> Self {
        Self {
            low: smaller(self.low, other.low),
            high: larger(self.high, other.high),
            squared_slope: larger(self.squared_slope, other.squared_slope),
        }
    }

    fn bounds(self, scale: HeightScale) -> Bounds {
        let (a, b) = (
            self.low * scale.scale + scale.offset,
            self.high * scale.scale + scale.offset,
        );
        Bounds {
            low: -round_up(-a.min(b)),
            high: round_up(a.max(b)),
            slope: round_up(self.squared_slope.sqrt()),
        }
    }
}

/// The smaller of two numbers, one instruction where `f64::min` asks for NaN.
fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::HeightMap;
    use crate::interpolation::interpolate;

    fn rough(width: u32, height: u32) -> HeightMap {
        let sample = |k: u32| (k.wrapping_mul(2_654_435_761) >> 16) as f32 / 65_536.0 * 10.0;
        HeightMap::new(width, height, (0..width * height).map(sample).collect()).unwrap()
    }

    #[test]
    fn bounds_hold_for_overshoot_and_slopes_and_are_nested() {
        let (map, cells) = (rough(38, 23), [37, 22]);
        for interpolation in [Interpolation::Bicubic, Interpolation::Bilinear] {
            let scale = HeightScale {
                interpolation,
                scale: -2.0,
                offset: 3.0,
                slope: [2.0, 4.0],
            };
            let bounds = HeightBounds::new(0, cells, |i, j| map.continued(i, j), scale);
            for (i, j) in (0..37u32).flat_map(|i| (0..22u32).map(move |j| (i, j))) {
                let own = bounds.over_cells([i, j], [i, j]);
                for (f, g) in [(0.0, 0.0), (0.5, 0.5), (0.3, 0.8), (1.0, 0.2)] {
                    let at = [i64::from(i), i64::from(j)];
                    let [h, di, dj] = interpolate(interpolation, |i, j| map.continued(i, j), at, [f, g]);
                    let height = (h * -2.0 + 3.0) as f32;
                    assert!(own.low - 1e-5 <= height && height <= own.high + 1e-5);
                    assert!((2.0 * di).hypot(4.0 * dj) <= f64::from(own.slope) + 1e-9);
                }
                for wider in 1..20 {
                    let high = [(i + wider).min(36), (j + wider / 2).min(21)];
                    let low = [i.saturating_sub(wider / 3), j.saturating_sub(wider)];
                    let more = bounds.over_cells(low, high);
                    assert_eq!(more.union(own), more);
                    assert_eq!(bounds.of_map().union(more), bounds.of_map());
                }
            }
        }
    }
}
