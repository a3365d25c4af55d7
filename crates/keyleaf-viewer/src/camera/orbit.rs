//! Around a pivot, Y up.

use super::{Camera, angles, direction};
use glam::DVec2;
use std::f64::consts::PI;

/// A drag over the height of the picture is half a turn.
pub(super) fn turn(camera: &mut Camera, drag: DVec2) {
    let distance = camera.distance();
    let (pitch, yaw) = angles(camera.scene_view().direction());
    let pitch = (pitch - drag.y * PI).clamp(-Camera::STEEPEST, Camera::STEEPEST);
    camera.eye = camera.pivot - direction(pitch, yaw + drag.x * PI) * distance;
}

/// Nearer by a tenth a notch.
pub(super) fn approach(camera: &mut Camera, notches: f64) {
    let factor = 0.9f64.powf(notches.clamp(-40.0, 40.0));
    let least = camera.pivot.length() * 1e-12 + 1e-9;
    let distance = (camera.distance() * factor).clamp(least, 1e12);
    camera.eye = camera.pivot - camera.scene_view().direction() * distance;
    camera.near = None;
}
