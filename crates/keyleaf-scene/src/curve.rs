//! Keyed values: cubic Hermite curves through keys at uneven times.

use crate::scene::Ease;

/// `N` numbers over time. The tangents are those of Catmull-Rom for uneven times: differences over both neighbours, over one at an end.
#[derive(Debug, Clone)]
pub(crate) struct Curve<const N: usize> {
    keys: Vec<Key<N>>,
    looped: bool,
}

/// A key of a [`Curve`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Key<const N: usize> {
    /// Seconds.
    pub time: f64,
    pub value: [f64; N],
    /// How the time runs to the next key.
    pub ease: Ease,
}

impl<const N: usize> Curve<N> {
    /// The times of the keys increase. A looped curve goes on after its last key as after its first one, but for the difference of the
    /// two, which should be nothing, or a whole turn of an angle.
    pub fn new(keys: Vec<Key<N>>, looped: bool) -> Self {
        Self { keys, looped }
    }

    /// Time of the last key; 0 without keys.
    pub fn end(&self) -> f64 {
        self.keys.last().map_or(0.0, |key| key.time)
    }

    /// The value at a time; `None` without keys. Before the first key it is that of the first, after the last that of the last one, or
    /// of the time modulo the duration.
    pub fn at(&self, time: f64) -> Option<[f64; N]> {
        let (first, last) = (self.keys.first()?, self.keys.last()?);
        let duration = last.time - first.time;
        let time = if self.looped && duration > 0.0 {
            first.time + (time - first.time).rem_euclid(duration)
        } else {
            time
        };
        let at = self.keys.partition_point(|key| key.time <= time).saturating_sub(1);
        let key = self.keys[at];
        let Some(next) = self.keys.get(at + 1).filter(|_| time > key.time) else {
            return Some(key.value);
        };
        let length = next.time - key.time;
        let even = ((time - key.time) / length).clamp(0.0, 1.0);
        let s = match key.ease {
            Ease::Linear => even,
            Ease::Smooth => even * even * (3.0 - 2.0 * even),
        };
        let (from, to) = (self.tangent(at), self.tangent(at + 1));
        let (s2, s3) = (s * s, s * s * s);
        Some(std::array::from_fn(|i| {
            let ends = key.value[i] + (next.value[i] - key.value[i]) * (3.0 * s2 - 2.0 * s3);
            ends + length * (from[i] * (s3 - 2.0 * s2 + s) + to[i] * (s3 - s2))
        }))
    }

    /// Change a second at a key.
    fn tangent(&self, at: usize) -> [f64; N] {
        let last = self.keys.len() - 1;
        let neighbour = |index: usize, laps: f64| {
            let (key, duration) = (self.keys[index], self.keys[last].time - self.keys[0].time);
            let lap = |i: usize| self.keys[last].value[i] - self.keys[0].value[i];
            let value: [f64; N] = std::array::from_fn(|i| key.value[i] + laps * lap(i));
            (key.time + laps * duration, value)
        };
        let goes_round = self.looped && last > 1;
        let before = match at {
            0 if goes_round => neighbour(last - 1, -1.0),
            _ => neighbour(at.saturating_sub(1), 0.0),
        };
        let after = match at {
            _ if at < last => neighbour(at + 1, 0.0),
            _ if goes_round => neighbour(1, 1.0),
            _ => neighbour(at, 0.0),
        };
        let length = after.0 - before.0;
        std::array::from_fn(|i| {
            if length > 0.0 {
                (after.1[i] - before.1[i]) / length
            } else {
                0.0
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(keys: &[(f64, f64)], looped: bool) -> Curve<1> {
        let key = |&(time, value): &(f64, f64)| Key {
            time,
            value: [value],
            ease: Ease::Linear,
        };
        Curve::new(keys.iter().map(key).collect(), looped)
    }

    fn at(curve: &Curve<1>, time: f64) -> f64 {
        curve.at(time).unwrap()[0]
    }

    #[test]
    fn curves_pass_through_their_keys_and_rest_outside() {
        let keys = [(1.0, 3.0), (1.5, -2.0), (4.0, 0.5), (5.0, 0.5)];
        let curve = curve(&keys, false);
        for (time, value) in keys {
            assert!((at(&curve, time) - value).abs() < 1e-12);
        }
        assert_eq!((at(&curve, -9.0), at(&curve, 9.0)), (3.0, 0.5));
        assert!(Curve::<1>::new(Vec::new(), true).at(1.0).is_none());
    }

    #[test]
    fn straight_lines_stay_straight() {
        let line = curve(&[(0.0, 0.0), (0.3, 0.6), (2.0, 4.0), (2.5, 5.0)], false);
        for k in 0..=100 {
            let time = f64::from(k) * 0.025;
            assert!((at(&line, time) - 2.0 * time).abs() < 1e-12);
        }
    }

    #[test]
    fn looped_curves_have_no_kink_at_the_seam_also_when_they_turn_on() {
        for lap in [0.0, 360.0] {
            let turning = curve(&[(0.0, 10.0), (0.5, 130.0), (1.2, 200.0), (2.0, 10.0 + lap)], true);
            let h = 1e-6;
            let before = (at(&turning, 2.0 - h) - at(&turning, 2.0 - 2.0 * h)) / h;
            let after = (at(&turning, 2.0 + 2.0 * h) - at(&turning, 2.0 + h)) / h;
            assert!((before - after).abs() < 0.01, "{before} {after}");
            assert!((at(&turning, 0.7) - at(&turning, 4.7)).abs() < 1e-9);
            assert!((at(&turning, 0.7) - at(&turning, -1.3)).abs() < 1e-9);
        }
    }
}
