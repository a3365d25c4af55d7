//! Camera paths: recorded while the camera moves, played, scrubbed.

use super::Camera;
use keyleaf_scene::scene::{CameraPath, Ease, PathKey};

/// What happens on the time line.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Motion {
    /// The camera is in the hands of the person.
    #[default]
    Free,
    /// The path runs.
    Playing,
    /// The camera stands on the path.
    Paused,
    /// What the camera does becomes a path.
    Recording,
}

/// The time line: a path, and where on it the camera is.
#[derive(Debug, Clone, Default)]
pub struct TimeLine {
    /// What happens.
    pub motion: Motion,
    /// Seconds since the first key.
    pub time: f64,
    /// The path that is chosen, by its number in the scene.
    pub chosen: usize,
    recorded: Vec<PathKey>,
}

/// Seconds between recorded keys: the smooth curve between them follows a hand well.
const KEY_STEP: f64 = 0.25;

impl TimeLine {
    /// Begins to record.
    pub fn record(&mut self) {
        self.motion = Motion::Recording;
        self.time = 0.0;
        self.recorded.clear();
    }

    /// Ends the recording; the path, unless it has only one key. Its name is not yet in `names`.
    pub fn finish<'a>(&mut self, camera: &Camera, names: impl Iterator<Item = &'a str> + Clone) -> Option<CameraPath> {
        if self.motion != Motion::Recording {
            return None;
        }
        self.motion = Motion::Free;
        if self.recorded.last().is_some_and(|key| self.time > key.time + 1e-3) {
            self.recorded.push(key(camera, self.time));
        }
        let name = (1..)
            .map(|n| format!("recorded {n}"))
            .find(|name| names.clone().all(|other| other != name))?;
        let keys = std::mem::take(&mut self.recorded);
        (keys.len() > 1).then_some(CameraPath {
            name,
            keys,
            looped: false,
            near: camera.near,
        })
    }

    /// Goes on by a time; whether the camera was moved.
    pub fn advance(&mut self, camera: &mut Camera, path: Option<&CameraPath>, seconds: f64) -> bool {
        match self.motion {
            Motion::Recording => {
                if self.recorded.last().is_none_or(|key| self.time >= key.time + KEY_STEP) {
                    self.recorded.push(key(camera, self.time));
                }
                self.time += seconds;
                false
            }
            Motion::Playing => {
                let Some(path) = path else {
                    self.motion = Motion::Free;
                    return false;
                };
                self.time += seconds;
                if self.time >= path.duration() {
                    if path.looped && path.duration() > 0.0 {
                        self.time = self.time.rem_euclid(path.duration());
                    } else {
                        self.time = path.duration();
                        self.motion = Motion::Paused;
                    }
                }
                self.place(camera, path)
            }
            Motion::Free | Motion::Paused => false,
        }
    }

    /// Plays, from the start if the end was reached.
    pub fn play(&mut self, path: &CameraPath) {
        if self.time >= path.duration() {
            self.time = 0.0;
        }
        self.motion = Motion::Playing;
    }

    /// Puts the camera where the path is at the present time; whether that moved it.
    pub fn place(&self, camera: &mut Camera, path: &CameraPath) -> bool {
        let before = *camera;
        // The last key of a looped path is a view of its own.
        let time = path.start() + self.time.min(path.duration() * (1.0 - 1e-12));
        if let Some(view) = path.view_at(time) {
            camera.go_to_view(&view);
            camera.near = path.near;
        }
        *camera != before
    }
}

fn key(camera: &Camera, time: f64) -> PathKey {
    PathKey {
        time,
        eye: camera.eye.into(),
        look_at: camera.pivot.into(),
        fov: camera.fov,
        ease: Ease::Linear,
        cut: false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;

    #[test]
    fn what_was_recorded_is_replayed() {
        let mut camera = Camera::default();
        let mut line = TimeLine::default();
        line.record();
        let mut seen = Vec::new();
        for _ in 0..60 {
            line.advance(&mut camera, None, 1.0 / 30.0);
            camera.turn(DVec2::new(0.01, 0.0));
            seen.push((line.time, camera.eye));
        }
        let path = line.finish(&camera, ["recorded 1"].into_iter()).unwrap();
        assert_eq!(path.name, "recorded 2");
        for (time, eye) in seen {
            let mut replayed = Camera::default();
            line.time = time;
            line.place(&mut replayed, &path);
            assert!(replayed.eye.distance(eye) < 0.15, "{time}: {} {eye}", replayed.eye);
        }
    }

    #[test]
    fn a_path_that_ends_stays_at_its_last_key() {
        let mut line = TimeLine::default();
        let mut camera = Camera::default();
        line.record();
        line.advance(&mut camera, None, 1.0);
        camera.eye.x += 2.0;
        let path = line.finish(&camera, [].into_iter()).unwrap();
        line.play(&path);
        line.time = 0.0;
        for _ in 0..40 {
            line.advance(&mut camera, Some(&path), 0.1);
        }
        assert_eq!((line.motion, line.time), (Motion::Paused, path.duration()));
    }
}
