//! Wishes as numbers: how they are rounded, and which of them fit the buffer (ARCHITECTURE section 4).

/// Mantissa bits of a wish that are cleared. The GPU keeps flags there, and both twins compare the same rounded value.
const CLEARED_BITS: u32 = 7;

/// How many buckets of priority there are: wishes from 2^31 on share the last.
pub const BUCKETS: usize = 32;

/// The wish rounded down by at most 2^-16 of itself, to 16 bits of mantissa, as leaves publish it. Negative numbers and NaN become 0.
///
/// It is monotone, so a nested metric stays nested, and no wish of 1 + 2^-16 or more becomes 1.
pub fn quantise(wish: f32) -> f32 {
    if wish > 0.0 {
        f32::from_bits(wish.to_bits() >> CLEARED_BITS << CLEARED_BITS)
    } else {
        0.0
    }
}

/// The wish that a metric (metric over threshold) stands for. Splits and merges must both go by it: where one would read the
/// metric unrounded, a leaf just above the threshold would stay if it is there and stay away if it is not.
pub fn wish(metric: f64) -> f32 {
    quantise(metric as f32)
}

/// The bucket of priority of a wish, floor(log2(wish)) clamped to `0..BUCKETS`.
pub fn bucket(wish: f32) -> usize {
    const EXPONENT_BITS: u32 = 0xff;
    const BIAS: u32 = 127;
    let exponent = wish.to_bits() >> (f32::MANTISSA_DIGITS - 1) & EXPONENT_BITS;
    (exponent.saturating_sub(BIAS) as usize).min(BUCKETS - 1)
}

/// How many leaves wish to split, by bucket of priority.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Buckets(pub [usize; BUCKETS]);

impl Buckets {
    /// Counts the wishes above 1.
    pub fn of(wishes: impl IntoIterator<Item = f32>) -> Self {
        let mut buckets = Self::default();
        for wish in wishes.into_iter().filter(|wish| *wish > 1.0) {
            buckets.0[bucket(wish)] += 1;
        }
        buckets
    }

    /// The bucket from which on upwards all wishes are admitted when there is room for `free` more leaves; one above the highest
    /// that has a wish when none is.
    ///
    /// Buckets are admitted whole, from the highest, three leaves a split, so that both halves of a diamond, whose wishes are
    /// equal, get the same answer.
    pub fn lowest_admitted(&self, mut free: usize) -> usize {
        for (bucket, count) in self.0.iter().enumerate().rev() {
            match free.checked_sub(3 * count) {
                Some(rest) => free = rest,
                None => return bucket + 1,
            }
        }
        0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantising_is_monotone_and_rounds_down_by_less_than_two_to_the_minus_sixteen() {
        let mut last = 0.0;
        for i in 0..100_000_u32 {
            let wish = f32::from_bits(0x3f00_0000 + 137 * i);
            let rounded = quantise(wish);
            assert!(rounded <= wish && wish - rounded < wish * 2.0_f32.powi(-16));
            assert!(rounded >= last && quantise(rounded) == rounded);
            last = rounded;
        }
    }

    #[test]
    fn wishes_that_are_no_numbers_are_tame() {
        assert_eq!(wish(f64::NAN).to_bits(), 0);
        assert_eq!(wish(-3.0).to_bits(), 0);
        assert_eq!(wish(-0.0).to_bits(), 0);
        assert_eq!(bucket(wish(f64::INFINITY)), BUCKETS - 1);
        assert_eq!(bucket(f32::MIN_POSITIVE / 2.0), 0);
    }

    #[test]
    fn buckets_are_whole_powers_of_two() {
        for power in 0..40 {
            let wish = 2.0_f32.powi(power);
            assert_eq!(bucket(wish), (power as usize).min(31));
            assert_eq!(bucket(wish * 1.999), (power as usize).min(31));
        }
    }

    #[test]
    fn admission_takes_whole_buckets_from_the_top_and_stops_at_the_first_that_does_not_fit() {
        let buckets = Buckets::of([9.0, 9.5, 5.0, 2.5, 1.5, 1.0, 0.0]);
        assert_eq!(buckets.0[..4], [1, 1, 1, 2]);
        let lowest = [5, 6, 8, 9, 11, 12, 15].map(|free| buckets.lowest_admitted(free));
        assert_eq!(lowest, [4, 3, 3, 2, 2, 1, 0]);
        assert_eq!(Buckets::of([2.0_f32.powi(40)]).lowest_admitted(2), BUCKETS);
    }
}
