//! A procedural terrain. Twin of `shaders/surfaces/terrain.wgsl`.

use crate::direction::round_up;
use crate::map::{Map, MapPosition};
use crate::noise::{NOISE2_LARGEST, NOISE2_SLOPE, noise2, octave_seed};
use crate::quad_coord::{QuadCoord, UNIT};
use crate::surface::{HALF_LEVEL, uniform};
use crate::{OwnCoord, ParameterError, SettingError, Surface, SurfaceBound, SurfaceFrame, SurfaceTables, diamond};
use encase::ShaderType;
use glam::{DVec2, DVec3};
use keyleaf_key::{Place, RootPoint, Topology};

/// As in the WGSL: ridges are rounded where the noise is smaller than this.
const RIDGE_ROUNDING: f64 = 0.05;
/// 2 / (√(1 + [`RIDGE_ROUNDING`]²) − [`RIDGE_ROUNDING`]), in the WGSL's digits.
const RIDGE_SCALE: f64 = 2.102_498_4;
/// Lattices beyond 2²⁸ cells along an edge have too few bits of fraction left.
const MAX_BITS: u32 = 28;

/// What a terrain looks like. Numbers that the GPU computes with are rounded to f32.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TerrainSettings {
    /// Length of the sides of the square, object units (metres).
    pub extent: f64,
    /// All heights lie within ± this; most within a third of it.
    pub height: f64,
    /// The first octave has 2 to the power of this cells along a side; 1 or more.
    pub first_level: u32,
    /// Octaves, each with half the cells' length of the one before; `first_level + octaves` is at most 29.
    pub octaves: u32,
    /// The amplitude of an octave over that of the one before, 0 to 1.
    pub gain: f64,
    /// 0: rolling noise (fBm); 1: sharp ridges.
    pub ridged: f64,
    /// 0: as rough everywhere; 1: smooth valleys, rough heights.
    pub contrast: f64,
    /// Another seed, another terrain.
    pub seed: u32,
}

impl Default for TerrainSettings {
    /// 10,000 km of land with mountain ranges 78 km apart, down to features of about a metre.
    fn default() -> Self {
        Self {
            extent: 1e7,
            height: 6000.0,
            first_level: 7,
            octaves: 17,
            gain: 0.5,
            ridged: 0.7,
            contrast: 0.8,
            seed: 1,
        }
    }
}

/// Gradient noise over a square, repeating at its borders: one quad face with x = u · extent, z = −v · extent.
///
/// The lattice cell of every octave, and the fraction within it, are bits of the exact 32-bit parameter, so that the ground is as
/// smooth 10,000 km from the corner as beside it. [`SurfaceBound::size`] counts a typical steep slope (about three standard
/// deviations), the radius for culling the steepest possible one.
///
/// GPU memory: none.
#[derive(Clone, Debug)]
pub struct Terrain {
    map: Map,
    settings: TerrainSettings,
    /// Of the first octave, such that all octaves together stay within the height.
    amplitude: f64,
}

#[derive(ShaderType)]
struct TerrainParams {
    map: MapPosition,
    shift: f32,
    first_bits: u32,
    octaves: u32,
    seed: u32,
    amplitude: f32,
    gain: f32,
    ridged: f32,
    contrast: f32,
    largest: f32,
    steepest_slope: f32,
    typical_slope: f32,
}

impl Terrain {
    /// The terrain with these settings.
    ///
    /// # Errors
    /// [`SettingError`] naming the first that is out of range.
    pub fn new(settings: TerrainSettings) -> Result<Self, SettingError> {
        let map = Map::new(DVec2::splat(settings.extent))?;
        let unit =
            |name, value: f64| SettingError::check(name, value, (0.0..=1.0).contains(&value), "a number from 0 to 1");
        SettingError::check(
            "height",
            settings.height,
            settings.height.abs() <= 1e15,
            "a height of at most 1e15",
        )?;
        let levels = settings.first_level;
        SettingError::check(
            "first_level",
            f64::from(levels),
            (1..=MAX_BITS).contains(&levels),
            "1 to 28",
        )?;
        let octaves = settings.octaves;
        let possible = (1..=MAX_BITS + 1 - levels).contains(&octaves);
        SettingError::check(
            "octaves",
            f64::from(octaves),
            possible,
            "at least 1 and at most 29 - first_level",
        )?;
        unit("gain", settings.gain)?;
        unit("ridged", settings.ridged)?;
        unit("contrast", settings.contrast)?;
        let round = |value: f64| f64::from(value as f32);
        let settings = TerrainSettings {
            gain: round(settings.gain),
            ridged: round(settings.ridged),
            contrast: round(settings.contrast),
            ..settings
        };
        let sum: f64 = (0..octaves).map(|octave| settings.gain.powi(octave as i32)).sum();
        Ok(Self {
            map,
            amplitude: round(settings.height / sum),
            settings,
        })
    }

    fn amplitudes(&self) -> impl Iterator<Item = f64> {
        std::iter::successors(Some(self.amplitude), |amplitude| Some(amplitude * self.settings.gain))
            .take(self.settings.octaves as usize)
    }

    /// (height, d/du, d/dv).
    fn height(&self, at: QuadCoord) -> [f64; 3] {
        let TerrainSettings {
            first_level,
            seed,
            contrast,
            ..
        } = self.settings;
        let (mut ground, mut detail, mut strength) = ([0.0; 3], [0.0; 3], [0.0; 3]);
        for (octave, amplitude) in (0..).zip(self.amplitudes()) {
            let bits = first_level + octave;
            let cells = 1u64 << bits;
            let [x, y] = [at.u, at.v].map(|value| value * cells % (UNIT * cells));
            let cell = [x, y].map(|value| (value / UNIT) as u32);
            let f = [x, y].map(|value| (value % UNIT) as f64 / UNIT as f64);
            let n = noise2(cell, (cells - 1) as u32, f, octave_seed(seed, octave));
            let [value, du, dv] = self.octave_shape(n);
            let shape = [value, du * cells as f64, dv * cells as f64];
            let share = 2.0 / (3.0 * f64::from(octave + 1));
            for k in 0..3 {
                if octave < 2 {
                    ground[k] += amplitude * shape[k];
                    strength[k] += share * shape[k];
                } else {
                    detail[k] += amplitude * shape[k];
                }
            }
        }
        let weight = 1.0 + 0.5 * contrast * (strength[0] - 1.0);
        let slope = |k: usize| ground[k] + weight * detail[k] + 0.5 * contrast * detail[0] * strength[k];
        [ground[0] + weight * detail[0], slope(1), slope(2)]
    }

    fn octave_shape(&self, [n, du, dv]: [f64; 3]) -> [f64; 3] {
        let ridged = self.settings.ridged;
        let rounded = n.hypot(RIDGE_ROUNDING);
        let ridge = 1.0 - RIDGE_SCALE * (rounded - RIDGE_ROUNDING);
        let slope = 1.0 - ridged - ridged * RIDGE_SCALE * n / rounded;
        [(1.0 - ridged) * n + ridged * ridge, slope * du, slope * dv]
    }

    /// The greatest slope of an octave of amplitude 1, relative to the first.
    fn first_slope(&self) -> f64 {
        let shape = 1.0 + self.settings.ridged * (RIDGE_SCALE - 1.0);
        NOISE2_SLOPE * shape * f64::from(1u32 << self.settings.first_level) / self.settings.extent
    }

    /// The greatest slopes of the octaves, and of the detail by its changing strength.
    fn slopes(&self) -> impl Iterator<Item = f64> {
        let slopes = (0..)
            .zip(self.amplitudes())
            .map(|(octave, a)| self.first_slope() * f64::from(1u32 << octave) * a.abs());
        slopes.chain([self.detail() * self.settings.contrast * self.first_slope() * 2.0 / 3.0])
    }

    /// All amplitudes from the third octave on.
    fn detail(&self) -> f64 {
        self.amplitudes().skip(2).sum::<f64>().abs()
    }

    fn largest(&self) -> f64 {
        NOISE2_LARGEST * self.amplitudes().sum::<f64>().abs()
    }

    fn steepest_slope(&self) -> f64 {
        self.slopes().sum()
    }

    /// Independent octaves add as squares: about three standard deviations of the slope.
    fn typical_slope(&self) -> f64 {
        self.slopes().map(|slope| slope * slope).sum::<f64>().sqrt()
    }

    fn variation(&self, reach: f64) -> f64 {
        let first = self.first_slope() * reach;
        let octaves = (0..)
            .zip(self.amplitudes())
            .map(|(octave, a)| a.abs() * (first * f64::from(1u32 << octave)).min(2.0));
        octaves.sum::<f64>() + self.detail() * self.settings.contrast * (first * 2.0 / 3.0).min(1.0)
    }
}

impl Surface for Terrain {
    fn topology(&self) -> &Topology {
        &self.map.topology
    }

    fn point(&self, at: RootPoint) -> DVec3 {
        let at = QuadCoord::of(at);
        self.map.position(at, self.height(at)[0])
    }

    fn frame(&self, at: RootPoint) -> SurfaceFrame {
        let [_, u, v] = self.height(QuadCoord::of(at));
        self.map.frame(self.point(at), [u, v])
    }

    fn bound(&self, leaf: &Place) -> SurfaceBound {
        let reach = self.map.reach() * diamond::ball_scale(leaf.level);
        let size = self.map.reach() * diamond::level_scale(leaf.level) * 1f64.hypot(self.typical_slope());
        SurfaceBound {
            centre: self.point(diamond::centre(leaf)),
            radius: reach.hypot(self.variation(reach)),
            size,
            guard: 2.0 * reach * 1f64.hypot(self.steepest_slope()),
            deviation: size,
            pair_deviation: HALF_LEVEL * size,
        }
    }

    fn own_coord(&self, surface: u32, s: f64, t: f64) -> Result<OwnCoord, ParameterError> {
        OwnCoord::of_square(self.topology(), surface, s, t)
    }

    fn bounding_box(&self) -> (DVec3, DVec3) {
        self.map.bounding_box(-self.largest(), self.largest())
    }

    fn shader(&self) -> &'static str {
        "surfaces/terrain.wgsl"
    }

    fn tables(&self, origin: DVec3) -> SurfaceTables {
        let params = TerrainParams {
            map: self.map.gpu_position(origin),
            shift: -origin.y as f32,
            first_bits: self.settings.first_level,
            octaves: self.settings.octaves,
            seed: self.settings.seed,
            amplitude: self.amplitude as f32,
            gain: self.settings.gain as f32,
            ridged: self.settings.ridged as f32,
            contrast: self.settings.contrast as f32,
            largest: round_up(self.largest()),
            steepest_slope: round_up(self.steepest_slope()),
            typical_slope: round_up(self.typical_slope()),
        };
        SurfaceTables {
            params: uniform(&params),
            a: Vec::new(),
            b: Vec::new(),
            heights: None,
            height_bounds: None,
        }
    }
}
