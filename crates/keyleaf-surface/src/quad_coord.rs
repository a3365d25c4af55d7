//! The exact parameters of a point of a four-cornered face. Twin of `shaders/shared/quad_coord.wgsl`.

use keyleaf_key::RootPoint;

/// 2³².
pub const UNIT: u64 = 1 << 32;

/// (u, v) in units of 2⁻³², 0..=[`UNIT`]. The corners 0..3 are (0, 0), (1, 0), (1, 1), (0, 1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct QuadCoord {
    pub u: u64,
    pub v: u64,
}

impl QuadCoord {
    /// Of a point of a root of a quad, whose centre has the parameters (1/2, 1/2).
    pub fn of(at: RootPoint) -> Self {
        let sum = |corner_of: fn(u32) -> u32| {
            u64::from(at.z())
                + 2 * u64::from(at.x) * u64::from(corner_of(at.root) & 1)
                + 2 * u64::from(at.y) * u64::from(corner_of(at.root + 1) & 1)
        };
        Self {
            u: sum(|corner| (corner + 1) >> 1),
            v: sum(|corner| corner >> 1),
        }
    }

    /// As numbers in 0..=1, exact.
    pub fn to_f64(self) -> [f64; 2] {
        [self.u, self.v].map(|value| value as f64 / UNIT as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use keyleaf_key::ONE;

    #[test]
    fn corners_edges_and_centre_have_their_parameters() {
        let of = |root, x, y| QuadCoord::of(RootPoint { face: 0, root, x, y }).to_f64();
        for (root, corner) in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].into_iter().enumerate() {
            assert_eq!(of(root as u32, ONE, 0), corner);
            assert_eq!(of((root as u32 + 3) % 4, 0, ONE), corner);
            assert_eq!(of(root as u32, 0, 0), [0.5, 0.5]);
        }
        assert_eq!(of(0, ONE / 4, ONE / 4 * 3), [0.75, 0.0]);
        assert_eq!(of(2, ONE / 2, ONE / 4), [0.625, 0.875]);
    }
}
