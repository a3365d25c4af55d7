//! Flying a camera path: the view at any time, and the frames of a fixed step.
//!
//! Between keys that no cut parts, the eye and the point looked at run along cubic Hermite curves with the tangents
//! of Catmull-Rom for uneven times (finite differences over the neighbouring keys), so that the camera passes through
//! every key without a kink. A segment that ends in a cut stands still at its first key. In a segment in which the
//! camera turns by more than a right angle nearly in place, the direction turns evenly instead, since the point
//! looked at would run through the eye.

use glam::{DQuat, DVec3};

use crate::scene::{CameraPath, Ease, PathKey};
use crate::view::View;

/// One frame of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// From 0.
    pub index: usize,
    /// Seconds, of the path's own clock.
    pub time: f64,
    /// What is seen.
    pub view: View,
    /// Whether the camera jumped since the frame before.
    pub cut: bool,
}

impl CameraPath {
    /// Time of the first key in seconds; 0 without keys.
    pub fn start(&self) -> f64 {
        self.keys.first().map_or(0.0, |key| key.time)
    }

    /// Seconds from the first key to the last.
    pub fn duration(&self) -> f64 {
        self.keys.last().map_or(0.0, |key| key.time) - self.start()
    }

    /// The view at a time; `None` if the path has no keys. Before the first key it is the first key's view, after the
    /// last one the last key's, or, if the path is looped, that of the time modulo the duration.
    pub fn view_at(&self, time: f64) -> Option<View> {
        let first = self.keys.first()?;
        let duration = self.duration();
        let time = if self.looped && duration > 0.0 {
            first.time + (time - first.time).rem_euclid(duration)
        } else {
            time
        };
        let at = self.keys.partition_point(|key| key.time <= time).saturating_sub(1);
        let (key, next) = match (self.keys.get(at), self.keys.get(at + 1)) {
            (Some(key), Some(next)) if !next.cut && time > key.time => (key, next),
            (Some(key), _) => return Some(self.view(eye(key), look_at(key), key.fov)),
            (None, _) => return None,
        };
        let length = next.time - key.time;
        let even = ((time - key.time) / length).clamp(0.0, 1.0);
        let s = match key.ease {
            Ease::Linear => even,
            Ease::Smooth => even * even * (3.0 - 2.0 * even),
        };
        let curve = |of: fn(&PathKey) -> DVec3| {
            let (from, to) = (self.tangent(at, of), self.tangent(at + 1, of));
            hermite(of(key), from * length, of(next), to * length, s)
        };
        let eye_now = curve(eye);
        let look_at_now = turn_in_place(key, next, s).map_or_else(|| curve(look_at), |d| eye_now + d);
        let fov = key.fov + (next.fov - key.fov) * s;
        Some(self.view(eye_now, look_at_now, fov))
    }

    fn view(&self, eye: DVec3, look_at: DVec3, fov: f64) -> View {
        View::new(eye, look_at, fov, self.near)
    }

    /// Velocity at a key: over both neighbours, over one at an end or beside a cut.
    fn tangent(&self, at: usize, of: fn(&PathKey) -> DVec3) -> DVec3 {
        let key = &self.keys[at];
        // What turns in place has a direction of its own: the point looked at has no velocity there.
        let before = if key.cut || at == 0 {
            None
        } else {
            self.keys.get(at - 1)
        };
        let before = before.filter(|k| turn_in_place(k, key, 0.0).is_none());
        let after = self.keys.get(at + 1).filter(|next| !next.cut);
        let after = after.filter(|k| turn_in_place(key, k, 0.0).is_none());
        let seam = self.seam();
        let (first, last) = (0, self.keys.len() - 1);
        // Across the seam of a loop, times go on.
        let before = before.map(|k| (of(k), k.time)).or_else(|| {
            let k = seam.filter(|_| at == first).map(|_| &self.keys[last - 1])?;
            Some((of(k), k.time - self.duration()))
        });
        let after = after.map(|k| (of(k), k.time)).or_else(|| {
            let k = seam.filter(|_| at == last).map(|_| &self.keys[first + 1])?;
            Some((of(k), k.time + self.duration()))
        });
        let own = (of(key), key.time);
        let (from, to) = (before.unwrap_or(own), after.unwrap_or(own));
        let length = to.1 - from.1;
        if length > 0.0 {
            (to.0 - from.0) / length
        } else {
            DVec3::ZERO
        }
    }

    /// Whether the path is looped and closed, so that it runs smoothly from its end to its start.
    fn seam(&self) -> Option<()> {
        let [first, second, .., before, last] = self.keys.as_slice() else {
            return None;
        };
        let same = first.eye == last.eye && first.look_at == last.look_at;
        (self.looped && same && !second.cut && !last.cut && before.time < last.time).then_some(())
    }

    /// The frames of a fixed step in seconds, from the first key to the last; only the first one if the step is not
    /// a positive number.
    pub fn frames(&self, step: f64) -> impl Iterator<Item = Frame> + '_ {
        let whole = if step > 0.0 && step.is_finite() {
            // A hair more, so that 3 s in steps of 0.1 s have 31 frames.
            (self.duration() / step + 1e-6).floor() as usize + 1
        } else {
            1
        };
        let time = move |index: usize| {
            let time = self.start() + if index == 0 { 0.0 } else { index as f64 * step };
            time.min(self.start() + self.duration())
        };
        (0..whole).filter_map(move |index| {
            let now = time(index);
            let jumped = |key: &&PathKey| key.cut && key.time <= now && key.time > time(index.max(1) - 1);
            let cut = index > 0 && self.keys.iter().find(jumped).is_some();
            let view = self.own_view(now)?;
            Some(Frame {
                index,
                time: now,
                view,
                cut,
            })
        })
    }

    /// The view at a time within the path, without looping: a looped path's last frame is its last key.
    fn own_view(&self, time: f64) -> Option<View> {
        match self.keys.last() {
            Some(last) if time >= last.time => Some(self.view(eye(last), look_at(last), last.fov)),
            _ => self.view_at(time),
        }
    }
}

fn eye(key: &PathKey) -> DVec3 {
    key.eye.into()
}

fn look_at(key: &PathKey) -> DVec3 {
    key.look_at.into()
}

/// Cubic Hermite interpolation; `m` are derivatives in s.
fn hermite(p0: DVec3, m0: DVec3, p1: DVec3, m1: DVec3, s: f64) -> DVec3 {
    let (s2, s3) = (s * s, s * s * s);
    p0 * (2.0 * s3 - 3.0 * s2 + 1.0) + m0 * (s3 - 2.0 * s2 + s) + p1 * (3.0 * s2 - 2.0 * s3) + m1 * (s3 - s2)
}

/// From the eye to the point looked at, if the camera turns by more than a right angle and hardly moves meanwhile.
fn turn_in_place(key: &PathKey, next: &PathKey, s: f64) -> Option<DVec3> {
    let (from, to) = (look_at(key) - eye(key), look_at(next) - eye(next));
    let moved = eye(key).distance(eye(next));
    if from.dot(to) >= 0.0 || moved > 0.5 * from.length().min(to.length()) {
        return None;
    }
    let (from_direction, to_direction) = (from.try_normalize()?, to.try_normalize()?);
    let cosine = from_direction.dot(to_direction).clamp(-1.0, 1.0);
    // Straight back: turn about the vertical, or about any axis if that is the direction.
    let axis = from_direction.cross(to_direction);
    let axis = if axis.length() > 1e-9 {
        axis.normalize()
    } else {
        let upright = DVec3::Y - from_direction * from_direction.y;
        upright.try_normalize().unwrap_or(DVec3::Z)
    };
    let turned = DQuat::from_axis_angle(axis, s * cosine.acos()) * from_direction;
    Some(turned * (from.length() + (to.length() - from.length()) * s))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(time: f64, eye: [f64; 3], look_at: [f64; 3]) -> PathKey {
        PathKey {
            time,
            eye,
            look_at,
            fov: 50.0,
            ease: Ease::Linear,
            cut: false,
        }
    }

    fn path(keys: Vec<PathKey>) -> CameraPath {
        CameraPath {
            name: "p".into(),
            keys,
            looped: false,
            near: None,
        }
    }

    fn square() -> CameraPath {
        let corner = |i: usize| [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, 0.0, -1.0]][i % 4];
        path(
            (0..5)
                .map(|i| key(i as f64 * 0.5, corner(i), [0.0, -1.0, 0.0]))
                .collect(),
        )
    }

    #[test]
    fn path_passes_through_its_keys_without_kinks() {
        let path = square();
        for k in &path.keys {
            assert!(path.view_at(k.time).unwrap().eye.distance(k.eye.into()) < 1e-12);
        }
        let speed = |t: f64| {
            let h = 1e-6;
            let at = |t| path.view_at(t).unwrap().eye;
            ((at(t) - at(t - h)) / h, (at(t + h) - at(t)) / h)
        };
        for t in [0.5, 1.0, 1.5] {
            let (before, after) = speed(t);
            assert!((before - after).length() < 1e-3, "{t}");
        }
    }

    #[test]
    fn cut_jumps_and_stands_still_before() {
        let mut path = square();
        path.keys[2].cut = true;
        let at = |t: f64| path.view_at(t).unwrap().eye;
        assert_eq!(at(0.75), path.keys[1].eye.into());
        assert_eq!(at(0.999_999), path.keys[1].eye.into());
        assert_eq!(at(1.0), path.keys[2].eye.into());
        let cuts: Vec<usize> = path.frames(0.3).filter(|f| f.cut).map(|f| f.index).collect();
        assert_eq!(cuts, [4]);
        // The curve before the cut does not know what comes after it.
        let mut other = path.clone();
        other.keys[2].eye = [99.0; 3];
        assert_eq!(other.view_at(0.3), path.view_at(0.3));
    }

    #[test]
    fn frames_reach_the_end_and_stay_in_step() {
        let path = square();
        let frames: Vec<Frame> = path.frames(0.1).collect();
        assert_eq!(frames.len(), 21);
        assert_eq!(frames[20].view, path.view_at(9.0).unwrap());
        assert!((frames[7].time - 0.7).abs() < 1e-12);
        for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(path.frames(step).count(), 1);
        }
        assert_eq!(path.frames(100.0).count(), 1);
    }

    #[test]
    fn smooth_ease_comes_to_rest() {
        let mut path = path(vec![
            key(0.0, [0.0; 3], [0.0, 0.0, -9.0]),
            key(2.0, [4.0, 0.0, 0.0], [4.0, 0.0, -9.0]),
        ]);
        let at = |path: &CameraPath, t: f64| path.view_at(t).unwrap().eye.x;
        assert!((at(&path, 0.5) - 1.0).abs() < 1e-12);
        path.keys[0].ease = Ease::Smooth;
        assert!(at(&path, 0.01) < 1e-3 && at(&path, 1.99) > 4.0 - 1e-3);
        assert!((at(&path, 1.0) - 2.0).abs() < 1e-12);
    }

    #[test]
    fn loops_repeat_and_closed_ones_have_no_kink() {
        let mut path = square();
        path.looped = true;
        let at = |t: f64| path.view_at(t).unwrap().eye;
        assert!(at(0.3).distance(at(4.3)) < 1e-12 && at(-0.2).distance(at(1.8)) < 1e-12);
        let h = 1e-6;
        let (before, after) = ((at(0.0) - at(-h)) / h, (at(h) - at(0.0)) / h);
        assert!((before - after).length() < 1e-3);
        assert_eq!(path.frames(0.5).last().unwrap().view.eye, DVec3::X);
    }

    #[test]
    fn fast_turns_never_look_through_the_eye() {
        let turn = path(vec![
            key(0.0, [0.0; 3], [0.0, 0.0, -5.0]),
            key(0.4, [0.0; 3], [0.0, 0.0, 7.0]),
        ]);
        for frame in turn.frames(0.01) {
            let distance = frame.view.eye.distance(frame.view.look_at);
            assert!((4.99..7.01).contains(&distance));
            assert!(frame.view.direction().y.abs() < 1e-12, "the turn is level");
        }
    }

    #[test]
    fn paths_with_one_key_or_none_do_not_panic() {
        assert_eq!(path(Vec::new()).view_at(1.0), None);
        assert_eq!(path(Vec::new()).frames(0.1).count(), 0);
        let mut one = path(vec![key(3.0, [1.0; 3], [2.0; 3])]);
        one.looped = true;
        assert_eq!(one.view_at(0.0).unwrap().eye, DVec3::ONE);
        assert_eq!((one.frames(0.1).count(), one.duration()), (1, 0.0));
    }
}
