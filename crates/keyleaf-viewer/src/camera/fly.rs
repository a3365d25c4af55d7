//! Free flight: keys move, the pointer turns, Y stays up.

use super::{Camera, angles, direction};
use glam::{DVec2, DVec3};

/// Keys that are held.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Keys {
    /// Right, up, forwards: each -1, 0 or 1.
    pub towards: DVec3,
    /// Whether four times as fast.
    pub fast: bool,
}

/// A drag over the height of the picture turns by this, in radians.
const TURN: f64 = 1.8;
/// At speed 1 the camera flies so many times its height above the ground in a second.
const PACE: f64 = 0.8;

pub(super) fn turn(camera: &mut Camera, drag: DVec2) {
    let distance = camera.distance();
    let (pitch, yaw) = angles(camera.scene_view().direction());
    let pitch = (pitch - drag.y * TURN).clamp(-Camera::STEEPEST, Camera::STEEPEST);
    camera.pivot = camera.eye + direction(pitch, yaw + drag.x * TURN) * distance;
}

pub(super) fn advance(camera: &mut Camera, keys: Keys, height: f64, seconds: f64) -> bool {
    let Some(towards) = keys.towards.try_normalize() else {
        return false;
    };
    let axes = camera.scene_view().axes();
    let pace = height * PACE * camera.speed * if keys.fast { 4.0 } else { 1.0 };
    let step = (axes.x_axis * towards.x + DVec3::Y * towards.y - axes.z_axis * towards.z) * pace * seconds;
    camera.eye += step;
    camera.pivot += step;
    step != DVec3::ZERO
}
