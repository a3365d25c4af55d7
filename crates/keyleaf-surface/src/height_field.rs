//! Height maps over a rectangle. Twin of `shaders/shared/height_field.wgsl`.

use crate::height_bounds::{HeightBounds, HeightScale};
use crate::interpolation::interpolate;
use crate::map::{MAP_ERROR, Map, MapPosition};
use crate::quad_coord::{QuadCoord, UNIT};
use crate::surface::{HALF_LEVEL, uniform};
use crate::{
    HeightMap, HeightMapError, Interpolation, OwnCoord, ParameterError, SettingError, Surface, SurfaceBound,
    SurfaceFrame, SurfaceTables, diamond,
};
use encase::ShaderType;
use glam::{DVec2, DVec3, UVec2};
use keyleaf_key::{Place, RootPoint, Topology};

/// Where a height map lies and how high it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeightFieldSettings {
    /// Length along the columns (x, east) and the rows (−z, north), object units.
    pub extent: DVec2,
    /// y = sample · scale + offset.
    pub scale: f64,
    /// See `scale`.
    pub offset: f64,
    /// Between samples.
    pub interpolation: Interpolation,
}

impl Default for HeightFieldSettings {
    fn default() -> Self {
        Self {
            extent: DVec2::ONE,
            scale: 1.0,
            offset: 0.0,
            interpolation: Interpolation::Bicubic,
        }
    }
}

/// A height map over a rectangle: one quad face with x = u · extent.x, z = −v · extent.y. Sample i, j from below is at
/// u = i / (width − 1), v = j / (height − 1), so that the first row of the file is at v = 1, in the north.
///
/// Beyond the rim samples are continued linearly, which is where the slope on the rim comes from.
///
/// ```
/// use keyleaf_surface::{HeightField, HeightFieldSettings, HeightMap, Surface};
/// let map = HeightMap::new(3, 2, vec![0.0, 1.0, 2.0, 10.0, 11.0, 12.0])?;
/// let surface = HeightField::new(map, HeightFieldSettings::default())?;
/// let corner = surface.face_coord(0, 1.0, 0.0).expect("in the square");
/// assert_eq!(surface.point(corner).y, 12.0);
/// # Ok::<(), keyleaf_surface::HeightMapError>(())
/// ```
///
/// GPU memory: 4 bytes a sample and 1.4 for the bounds.
#[derive(Clone, Debug)]
pub struct HeightField {
    samples: HeightMap,
    map: Map,
    settings: HeightFieldSettings,
    bounds: HeightBounds,
}

#[derive(ShaderType)]
struct HeightFieldParams {
    map: MapPosition,
    cells: UVec2,
    scale: f32,
    shift: f32,
}

impl HeightField {
    /// The surface of a map.
    ///
    /// # Errors
    /// [`HeightMapError::Setting`] if an extent is not a positive length or a height not finite.
    pub fn new(samples: HeightMap, settings: HeightFieldSettings) -> Result<Self, HeightMapError> {
        let is_height = |height: f64| height.abs() <= 1e15;
        SettingError::check(
            "scale",
            settings.scale,
            is_height(settings.scale),
            "a number of at most 1e15",
        )?;
        SettingError::check(
            "offset",
            settings.offset,
            is_height(settings.offset),
            "a height of at most 1e15",
        )?;
        let settings = HeightFieldSettings {
            scale: f64::from(settings.scale as f32),
            ..settings
        };
        let map = Map::new(settings.extent)?;
        let cells = UVec2::new(samples.width() - 1, samples.height() - 1);
        let slope = (cells.as_dvec2() * settings.scale.abs() / settings.extent).to_array();
        let scale = HeightScale {
            interpolation: settings.interpolation,
            scale: settings.scale,
            offset: 0.0,
            slope,
        };
        let bounds = HeightBounds::new(0, cells.to_array(), |i, j| samples.continued(i, j), scale);
        Ok(Self {
            samples,
            map,
            settings,
            bounds,
        })
    }

    /// The height map.
    pub fn samples(&self) -> &HeightMap {
        &self.samples
    }

    fn cells(&self) -> [u32; 2] {
        [self.samples.width() - 1, self.samples.height() - 1]
    }

    /// (sample, d/du, d/dv).
    fn sample(&self, at: QuadCoord) -> [f64; 3] {
        let [(i, f), (j, g)] = [(at.u, 0), (at.v, 1)].map(|(value, axis)| split_cell(value, self.cells()[axis]));
        let sample = |i, j| self.samples.continued(i, j);
        let [h, di, dj] = interpolate(
            self.settings.interpolation,
            sample,
            [i64::from(i), i64::from(j)],
            [f, g],
        );
        [h, di * f64::from(self.cells()[0]), dj * f64::from(self.cells()[1])]
    }
}

/// The cell and the fraction of value · cells: exact.
fn split_cell(value: u64, cells: u32) -> (u32, f64) {
    if value == UNIT {
        return (cells - 1, 1.0);
    }
    let product = value * u64::from(cells);
    ((product >> 32) as u32, (product & (UNIT - 1)) as f64 / UNIT as f64)
}

impl Surface for HeightField {
    fn topology(&self) -> &Topology {
        &self.map.topology
    }

    fn point(&self, at: RootPoint) -> DVec3 {
        let at = QuadCoord::of(at);
        self.map
            .position(at, self.sample(at)[0] * self.settings.scale + self.settings.offset)
    }

    fn frame(&self, at: RootPoint) -> SurfaceFrame {
        let [_, u, v] = self.sample(QuadCoord::of(at));
        self.map
            .frame(self.point(at), [u, v].map(|slope| slope * self.settings.scale))
    }

    fn bound(&self, leaf: &Place) -> SurfaceBound {
        let middle = diamond::centre(leaf);
        let QuadCoord { u, v } = QuadCoord::of(middle);
        let half = u64::from(leaf.unit().max(2));
        let cell = |value: u64, axis: usize| split_cell(value, self.cells()[axis]).0;
        let low = [(u, 0), (v, 1)].map(|(value, axis)| cell(value.saturating_sub(half), axis));
        let high = [(u, 0), (v, 1)].map(|(value, axis)| cell((value + half).min(UNIT) - 1, axis));
        let bounds = self.bounds.over_cells(low, high);
        let (low, high, slope) = (f64::from(bounds.low), f64::from(bounds.high), f64::from(bounds.slope));

        let centre = self.point(middle);
        let reach = self.map.reach() * diamond::ball_scale(leaf.level);
        let height = centre.y - self.settings.offset;
        let vertical = (high - height).max(height - low).min(slope * reach);
        let steepness = 1f64.hypot(slope);
        let size = self.map.reach() * diamond::level_scale(leaf.level) * steepness;
        SurfaceBound {
            centre,
            radius: reach.hypot(vertical),
            size,
            guard: 2.0 * reach * steepness,
            deviation: size,
            pair_deviation: HALF_LEVEL * size,
        }
    }

    fn own_coord(&self, surface: u32, s: f64, t: f64) -> Result<OwnCoord, ParameterError> {
        OwnCoord::of_square(self.topology(), surface, s, t)
    }

    fn bounding_box(&self) -> (DVec3, DVec3) {
        let bounds = self.bounds.of_map();
        let [low, high] = [bounds.low, bounds.high].map(|height| f64::from(height) + self.settings.offset);
        let room = MAP_ERROR * low.abs().max(high.abs());
        self.map.bounding_box(low - room, high + room)
    }

    fn shader(&self) -> &'static str {
        match self.settings.interpolation {
            Interpolation::Bicubic => "surfaces/height_field.wgsl",
            Interpolation::Bilinear => "surfaces/height_field_bilinear.wgsl",
        }
    }

    fn tables(&self, origin: DVec3) -> SurfaceTables {
        let params = HeightFieldParams {
            map: self.map.gpu_position(origin),
            cells: UVec2::from_array(self.cells()),
            scale: self.settings.scale as f32,
            shift: (self.settings.offset - origin.y) as f32,
        };
        SurfaceTables {
            params: uniform(&params),
            a: Vec::new(),
            b: Vec::new(),
            heights: Some(self.samples.texture()),
            height_bounds: Some(self.bounds.texture()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_met_at_their_parameters_and_row_zero_is_north() {
        let samples: Vec<f32> = (0..7 * 5).map(|k| (k * k % 91) as f32).collect();
        let map = HeightMap::new(7, 5, samples.clone()).unwrap();
        for interpolation in [Interpolation::Bicubic, Interpolation::Bilinear] {
            let settings = HeightFieldSettings {
                extent: DVec2::new(60.0, 40.0),
                scale: 0.5,
                offset: 10.0,
                interpolation,
            };
            let surface = HeightField::new(map.clone(), settings).unwrap();
            for (k, sample) in samples.iter().enumerate() {
                let (i, j) = (k % 7, 4 - k / 7);
                let at = surface.face_coord(0, i as f64 / 6.0, j as f64 / 4.0).unwrap();
                let expected = DVec3::new(10.0 * i as f64, f64::from(*sample) * 0.5 + 10.0, -10.0 * j as f64);
                assert!(surface.point(at).distance(expected) < 1e-6);
            }
        }
    }

    #[test]
    fn a_plane_is_a_plane_to_the_rim() {
        let map = HeightMap::new(4, 3, (0..12).map(|k| (k % 4 * 2) as f32 - (k / 4) as f32).collect()).unwrap();
        let settings = HeightFieldSettings {
            extent: DVec2::new(3.0, 2.0),
            ..HeightFieldSettings::default()
        };
        let surface = HeightField::new(map, settings).unwrap();
        for (u, v) in [(0.0, 0.0), (1.0, 1.0), (0.01, 0.99), (0.5, 0.3)] {
            let frame = surface.frame(surface.face_coord(0, u, v).unwrap());
            assert!(frame.normal.distance(DVec3::new(-2.0, 1.0, 1.0).normalize()) < 1e-9);
        }
    }
}
