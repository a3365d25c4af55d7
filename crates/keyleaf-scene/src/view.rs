//! A view: where the camera stands and what it looks at, and the views that things without cameras get.

use glam::{DMat3, DMat4, DQuat, DVec3};

use crate::scene::{CameraPath, DEFAULT_FOV, Ease, NamedCamera, PathKey};

/// A camera at one moment. World space: right-handed, Y up, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Position.
    pub eye: DVec3,
    /// The point in the middle of the picture.
    pub look_at: DVec3,
    /// Vertical angle of view in degrees, above 0 and below 180.
    pub fov: f64,
    /// Distance of the near plane in metres, above 0.
    pub near: f64,
}

/// Near planes that are chosen lie between these distances in metres: depth is reversed and infinite, so that a close
/// one costs no precision.
const NEAR_RANGE: (f64, f64) = (1e-4, 0.5);
/// And at this fraction of the distance to the point looked at.
const NEAR_FRACTION: f64 = 1e-3;

impl View {
    /// A view with the near plane given, or chosen by the distance to `look_at`.
    pub fn new(eye: DVec3, look_at: DVec3, fov: f64, near: Option<f64>) -> Self {
        let chosen = (NEAR_FRACTION * eye.distance(look_at)).clamp(NEAR_RANGE.0, NEAR_RANGE.1);
        Self {
            eye,
            look_at,
            fov,
            near: near.unwrap_or(chosen),
        }
    }

    /// Unit vector into the picture; north (-Z) if eye and look_at are the same point.
    pub fn direction(&self) -> DVec3 {
        (self.look_at - self.eye).try_normalize().unwrap_or(DVec3::NEG_Z)
    }

    /// The camera's axes in world space: right, up, backwards. Up is towards +Y; north if it looks straight down.
    pub fn axes(&self) -> DMat3 {
        let forward = self.direction();
        let side = forward.cross(DVec3::Y);
        // Closer to the vertical than this, the side is rounding.
        let right = if side.length() < 1e-6 {
            DVec3::X
        } else {
            side.normalize()
        };
        let right = (right - forward * right.dot(forward)).normalize();
        DMat3::from_cols(right, right.cross(forward), -forward)
    }

    /// Turns camera space (right, up, backwards) to world space.
    pub fn orientation(&self) -> DQuat {
        DQuat::from_mat3(&self.axes())
    }

    /// `view_from_world`: rigid, right-handed, looking along -Z.
    pub fn view_from_world(&self) -> DMat4 {
        let axes = self.axes().transpose();
        DMat4::from_mat3_translation(axes, -(axes * self.eye))
    }
}

impl From<&NamedCamera> for View {
    fn from(camera: &NamedCamera) -> Self {
        Self::new(camera.eye.into(), camera.look_at.into(), camera.fov, camera.near)
    }
}

/// The part of the picture that an object fills, and the narrowest picture for which that holds: width over height.
const FILLED: f64 = 0.85;
const NARROWEST: f64 = 4.0 / 3.0;

/// What a scene looks like from afar, for the views that it gets if it has none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// Least corner of the part that is looked at.
    pub low: DVec3,
    /// Greatest corner.
    pub high: DVec3,
    /// Whether it is ground: looked across, never from below.
    pub is_ground: bool,
}

impl Extent {
    fn centre(&self) -> DVec3 {
        (self.low + self.high) / 2.0
    }

    /// Radius of the ball about the centre; 1 for a point.
    fn radius(&self) -> f64 {
        let radius = (self.high - self.low).length() / 2.0;
        if radius > 0.0 { radius } else { 1.0 }
    }

    /// The longer horizontal side.
    fn side(&self) -> f64 {
        let size = self.high - self.low;
        if size.x.max(size.z) > 0.0 {
            size.x.max(size.z)
        } else {
            1.0
        }
    }

    /// A point above the ground: fractions of the sides east and north, height over the highest point in sides.
    fn above(&self, east: f64, north: f64, up: f64) -> DVec3 {
        let size = self.high - self.low;
        DVec3::new(
            self.low.x + east * size.x,
            self.high.y + up * self.side(),
            self.high.z - north * size.z,
        )
    }

    /// A point on the ground, at the middle height.
    fn ground(&self, east: f64, north: f64) -> DVec3 {
        let point = self.above(east, north, 0.0);
        DVec3::new(point.x, self.centre().y, point.z)
    }

    /// A point around the centre, in radii.
    fn around(&self, x: f64, y: f64, z: f64) -> DVec3 {
        self.centre() + self.radius() * DVec3::new(x, y, z)
    }

    /// The eye in this direction from the centre that is just so far away that the box fills the picture, a little smaller than it.
    fn fitting(&self, direction: DVec3) -> DVec3 {
        let towards = direction.normalize();
        let axes = View::new(self.centre() + towards, self.centre(), DEFAULT_FOV, None).axes();
        let half_height = FILLED * (DEFAULT_FOV.to_radians() / 2.0).tan();
        let corner = (self.high - self.low) / 2.0;
        let distance = (0..8u32).map(|k| {
            let sign = |axis: u32| if k >> axis & 1 == 0 { -1.0 } else { 1.0 };
            let seen = axes.transpose() * (corner * DVec3::new(sign(0), sign(1), sign(2)));
            seen.z + (seen.y.abs() / half_height).max(seen.x.abs() / (half_height * NARROWEST))
        });
        let farthest = distance.fold(0.0, f64::max);
        self.centre() + towards * if farthest > 0.0 { farthest } else { 3.0 }
    }

    /// A camera that sees all of an object, or across the ground.
    pub fn camera(&self) -> NamedCamera {
        let (eye, look_at) = if self.is_ground {
            (self.above(0.5, -0.02, 0.09), self.ground(0.5, 0.45))
        } else {
            (self.fitting(DVec3::new(1.3, 0.8, 2.2)), self.centre())
        };
        NamedCamera {
            name: "default".into(),
            eye: eye.into(),
            look_at: look_at.into(),
            fov: DEFAULT_FOV,
            near: None,
        }
    }

    /// A path of eight seconds with a fly-in, a turn of 150° in 0.4 s and back, and a teleport.
    pub fn path(&self) -> CameraPath {
        let views: [(f64, DVec3, DVec3, bool); 8] = if self.is_ground {
            let low = self.above(0.55, 0.35, 0.01);
            let ahead = self.ground(0.6, 1.0);
            let aside = low + (self.ground(0.05, -0.25) - low);
            [
                (0.0, self.above(0.5, -0.9, 0.6), self.ground(0.5, 0.5), false),
                (2.0, self.above(0.5, 0.0, 0.08), self.ground(0.5, 0.7), false),
                (3.5, low, ahead, false),
                (3.9, low, aside, false),
                (4.3, low, ahead, false),
                (5.5, self.above(0.6, 0.6, 0.015), self.ground(0.6, 1.2), false),
                (5.6, self.above(0.9, 0.9, 0.02), self.ground(0.2, 0.3), true),
                (8.0, self.above(0.7, 0.8, 0.05), self.ground(0.2, 0.3), false),
            ]
        } else {
            let near = self.around(0.5, 0.35, 1.2);
            let aside = near + self.radius() * DVec3::new(0.4, 0.1, 1.2);
            [
                (0.0, self.around(2.0, 2.5, 9.0), self.centre(), false),
                (2.0, self.around(0.9, 0.6, 2.0), self.centre(), false),
                (3.5, near, self.centre(), false),
                (3.9, near, aside, false),
                (4.3, near, self.centre(), false),
                (5.5, self.around(1.4, 0.3, -0.4), self.centre(), false),
                (5.6, self.around(-0.9, 0.7, -1.1), self.centre(), true),
                (8.0, self.around(-1.6, 0.5, 1.0), self.centre(), false),
            ]
        };
        let key = |(time, eye, look_at, cut): (f64, DVec3, DVec3, bool)| PathKey {
            time,
            eye: eye.into(),
            look_at: look_at.into(),
            fov: DEFAULT_FOV,
            ease: Ease::Linear,
            cut,
        };
        CameraPath {
            name: "default".into(),
            keys: views.map(key).to_vec(),
            looped: false,
            near: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn view_matrix_looks_along_minus_z_with_y_up() {
        let view = View::new(DVec3::new(1.0, 2.0, 3.0), DVec3::new(4.0, 1.0, -2.0), 50.0, None);
        let in_view = view.view_from_world();
        let seen = in_view.transform_point3(view.look_at);
        let distance = view.eye.distance(view.look_at);
        assert!((seen - DVec3::new(0.0, 0.0, -distance)).length() < 1e-12);
        assert!(in_view.transform_vector3(DVec3::Y).y > 0.0);
        assert!((in_view.determinant() - 1.0).abs() < 1e-12);
        let turned = view.orientation() * DVec3::NEG_Z;
        assert!((turned - view.direction()).length() < 1e-12);
    }

    #[test]
    fn looking_straight_down_has_north_up() {
        let view = View::new(DVec3::Y, DVec3::ZERO, 50.0, None);
        assert_eq!(view.axes().y_axis, DVec3::NEG_Z);
        let nowhere = View::new(DVec3::ONE, DVec3::ONE, 50.0, None);
        assert!(nowhere.view_from_world().is_finite());
    }

    #[test]
    fn default_views_see_the_centre_and_stay_above_the_ground() {
        for is_ground in [true, false] {
            let extent = Extent {
                low: DVec3::new(-3.0, 10.0, 5.0),
                high: DVec3::new(900.0, 200.0, 1005.0),
                is_ground,
            };
            let view = View::from(&extent.camera());
            let towards = (extent.centre() - view.eye).normalize();
            assert!(towards.dot(view.direction()) > 0.95);
            let path = extent.path();
            assert!(path.keys.iter().any(|k| k.cut));
            for frame in path.frames(0.05) {
                assert!(!is_ground || frame.view.eye.y > extent.high.y);
            }
        }
    }
}
