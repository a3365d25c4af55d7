//! Surfaces over a rectangle on the ground: one quad face. Twin of `shaders/shared/map_position.wgsl`.

use crate::direction::scaled;
use crate::quad_coord::{QuadCoord, UNIT};
use crate::{SettingError, SurfaceFrame};
use encase::ShaderType;
use glam::{DVec2, DVec3, UVec2, Vec2};
use keyleaf_key::Topology;

/// The rounding error of a height or of a distance from the origin, relative: as in the WGSL bounds.
pub const MAP_ERROR: f64 = 1e-6;

/// A rectangle: x = u · extent.x (east), z = −v · extent.y (north is −z).
#[derive(Clone, Debug)]
pub struct Map {
    pub extent: DVec2,
    pub topology: Topology,
}

/// The WGSL struct of the same name.
#[derive(ShaderType)]
pub struct MapPosition {
    origin: UVec2,
    step: Vec2,
    rest: Vec2,
    extent: Vec2,
}

impl Map {
    pub fn new(extent: DVec2) -> Result<Self, SettingError> {
        let is_length = |length: f64| (1e-12..=1e15).contains(&length);
        SettingError::check("extent", extent.x, is_length(extent.x), "a length from 1e-12 to 1e15")?;
        SettingError::check("extent", extent.y, is_length(extent.y), "a length from 1e-12 to 1e15")?;
        let topology = Topology::new(4, [[0, 1, 2, 3]]).expect("one quad is a surface");
        Ok(Self { extent, topology })
    }

    pub fn position(&self, at: QuadCoord, height: f64) -> DVec3 {
        let [u, v] = at.to_f64();
        DVec3::new(u * self.extent.x, height, -v * self.extent.y)
    }

    /// The frame where the height has these derivatives in u and v.
    pub fn frame(&self, position: DVec3, [slope_u, slope_v]: [f64; 2]) -> SurfaceFrame {
        let normal = DVec3::new(-slope_u / self.extent.x, 1.0, slope_v / self.extent.y);
        SurfaceFrame {
            position,
            du: DVec3::new(self.extent.x, slope_u, 0.0),
            dv: DVec3::new(0.0, slope_v, -self.extent.y),
            normal: scaled(normal).normalize(),
        }
    }

    /// Bounds half the hypotenuse, the median and half the diagonals of a diamond of level 0 on the ground.
    pub fn reach(&self) -> f64 {
        0.5 * self.extent.max_element()
    }

    pub fn bounding_box(&self, low: f64, high: f64) -> (DVec3, DVec3) {
        (
            DVec3::new(0.0, low, -self.extent.y),
            DVec3::new(self.extent.x, high, 0.0),
        )
    }

    /// What the shaders need to be exact near an origin: it is a multiple of 2⁻³² of the map and a small rest.
    pub fn gpu_position(&self, origin: DVec3) -> MapPosition {
        let split = |ground: f64, extent: f64| {
            let fixed = (ground / extent * UNIT as f64).round().clamp(0.0, f64::from(u32::MAX));
            (fixed as u32, fixed / UNIT as f64 * extent - ground)
        };
        let (u, rest_x) = split(origin.x, self.extent.x);
        let (v, rest_z) = split(-origin.z, self.extent.y);
        MapPosition {
            origin: UVec2::new(u, v),
            step: (self.extent / UNIT as f64).as_vec2(),
            rest: DVec2::new(rest_x, -rest_z).as_vec2(),
            extent: self.extent.as_vec2(),
        }
    }
}
