//! The camera: where it stands, and how a person moves it.

mod fly;
mod orbit;
pub mod path;

use glam::{DVec2, DVec3, UVec2};
use keyleaf::View;
use keyleaf_scene::scene::NamedCamera;
use keyleaf_stage::view_of;

pub use fly::Keys;

/// How the pointer moves the camera.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub enum Mode {
    /// Around a pivot on the surface.
    #[default]
    Orbit,
    /// Freely, by keys and pointer.
    Fly,
}

/// A camera that can be moved. World space, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Position.
    pub eye: DVec3,
    /// The point in the middle of the picture; the pivot of the orbit.
    pub pivot: DVec3,
    /// Vertical angle of view in degrees.
    pub fov: f64,
    /// Distance of the near plane; `None`: chosen by the distance to the pivot.
    pub near: Option<f64>,
    /// How the pointer moves it.
    pub mode: Mode,
    /// Factor on the speed of the flight.
    pub speed: f64,
}

impl Default for Camera {
    fn default() -> Self {
        Self {
            eye: DVec3::new(0.0, 1.0, 3.0),
            pivot: DVec3::ZERO,
            fov: keyleaf_scene::scene::DEFAULT_FOV,
            near: None,
            mode: Mode::Orbit,
            speed: 1.0,
        }
    }
}

impl Camera {
    /// The most that the camera looks up or down, in radians: straight up there is no way to turn.
    const STEEPEST: f64 = 1.553;

    /// What the camera sees on a picture of `size` pixels.
    pub fn view(&self, size: UVec2) -> View {
        view_of(&self.scene_view(), size)
    }

    /// The camera as scenes have it.
    pub fn scene_view(&self) -> keyleaf_scene::View {
        keyleaf_scene::View::new(self.eye, self.pivot, self.fov, self.near)
    }

    /// Goes to a camera of a scene.
    pub fn go_to(&mut self, camera: &NamedCamera) {
        self.eye = camera.eye.into();
        self.pivot = camera.look_at.into();
        self.fov = camera.fov;
        self.near = camera.near;
    }

    /// Goes to a view of a path.
    pub fn go_to_view(&mut self, view: &keyleaf_scene::View) {
        self.eye = view.eye;
        self.pivot = view.look_at;
        self.fov = view.fov;
    }

    /// Sees all of a box, from where it looks now.
    pub fn frame(&mut self, (low, high): (DVec3, DVec3)) {
        let centre = (low + high) / 2.0;
        let radius = ((high - low).length() / 2.0).max(f64::MIN_POSITIVE.sqrt());
        let mut direction = self.scene_view().direction();
        // Ground is looked down on: from below or edge on it shows nothing.
        let flatness = (high.y - low.y) / radius;
        if flatness < 0.5 && direction.y > -0.35 {
            direction = DVec3::new(direction.x, -0.6, direction.z).normalize();
        }
        let distance = radius / (self.fov.to_radians() / 2.0).sin();
        self.pivot = centre;
        self.eye = centre - direction * distance;
        self.near = None;
    }

    /// From the eye to the pivot.
    pub fn distance(&self) -> f64 {
        self.eye.distance(self.pivot)
    }

    /// Turns by a drag of the pointer, in parts of the picture's height.
    pub fn turn(&mut self, drag: DVec2) {
        match self.mode {
            Mode::Orbit => orbit::turn(self, drag),
            Mode::Fly => fly::turn(self, drag),
        }
    }

    /// Moves sideways by a drag of the pointer, in parts of the picture's height: what is at the pivot stays under the pointer.
    pub fn pan(&mut self, drag: DVec2) {
        let axes = self.scene_view().axes();
        let height = 2.0 * self.distance() * (self.fov.to_radians() / 2.0).tan();
        let move_by = (axes.y_axis * drag.y - axes.x_axis * drag.x) * height;
        self.eye += move_by;
        self.pivot += move_by;
    }

    /// Turns of the wheel, or of a pinch: nearer to the pivot, or, in flight, faster.
    pub fn wheel(&mut self, notches: f64) {
        match self.mode {
            Mode::Orbit => orbit::approach(self, notches),
            Mode::Fly => self.speed = (self.speed * 1.25f64.powf(notches)).clamp(1e-3, 1e3),
        }
    }

    /// Flies for a time. `height` is how far the ground is, which sets the pace. Whether it moved.
    pub fn fly(&mut self, keys: Keys, height: f64, seconds: f64) -> bool {
        fly::advance(self, keys, height, seconds)
    }
}

/// Pitch and yaw of a direction, in radians.
fn angles(direction: DVec3) -> (f64, f64) {
    (direction.y.clamp(-1.0, 1.0).asin(), direction.x.atan2(-direction.z))
}

/// The direction of pitch and yaw.
fn direction(pitch: f64, yaw: f64) -> DVec3 {
    DVec3::new(yaw.sin() * pitch.cos(), pitch.sin(), -yaw.cos() * pitch.cos())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_orbit_keeps_pivot_and_distance() {
        let mut camera = Camera::default();
        let distance = camera.distance();
        for step in 0..50 {
            camera.turn(DVec2::new(0.03, if step < 25 { 0.05 } else { -0.08 }));
            assert!((camera.distance() - distance).abs() < 1e-9);
            assert!(camera.scene_view().axes().is_finite());
        }
        assert_eq!(camera.pivot, DVec3::ZERO);
    }

    #[test]
    fn a_drag_in_flight_turns_in_place() {
        let mut camera = Camera {
            mode: Mode::Fly,
            ..Camera::default()
        };
        let eye = camera.eye;
        camera.turn(DVec2::new(0.2, 0.1));
        assert_eq!(camera.eye, eye);
    }

    #[test]
    fn framing_sees_every_corner_of_the_box() {
        let bounds = (DVec3::new(-3.0, 1.0, 2.0), DVec3::new(5.0, 9.0, 4.0));
        let mut camera = Camera::default();
        camera.frame(bounds);
        let view = camera.view(UVec2::splat(100));
        for corner in 0..8 {
            let pick = |bit: u32, i: usize| if corner & bit == 0 { bounds.0[i] } else { bounds.1[i] };
            let p = DVec3::new(pick(1, 0), pick(2, 1), pick(4, 2));
            let seen = view.orientation.inverse() * (p - view.eye);
            let tangent = (camera.fov.to_radians() / 2.0).tan();
            assert!(
                seen.z < 0.0 && seen.x.abs().max(seen.y.abs()) <= -seen.z * tangent * 1.0001,
                "{p}"
            );
        }
    }

    #[test]
    fn pinching_in_never_passes_the_pivot() {
        let mut camera = Camera::default();
        camera.wheel(500.0);
        assert!(camera.distance() > 0.0 && camera.eye.is_finite());
    }
}
