//! Random Gaussians and meshes.

use glam::{DMat3, DQuat, DVec3};
use keyleaf_surface::gaussian::{Covariance, Dual, DualFrame, DualSquare, DualTriangle, Symmetric3};
use keyleaf_surface::{CornerAttributes, PolygonMesh};

/// A generator of the same numbers everywhere (xorshift64*).
pub struct Random(pub u64);

impl Random {
    /// In 0..1.
    pub fn unit(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn vector(&mut self) -> DVec3 {
        DVec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0
    }

    /// A rotation by about this angle, any for a great one.
    pub fn rotation(&mut self, angle: f64) -> DMat3 {
        let axis = self.vector();
        DMat3::from_quat(DQuat::from_scaled_axis(axis * angle))
    }

    /// Weights that sum to one, uniformly distributed.
    pub fn weights(&mut self, count: usize) -> Vec<f64> {
        let raw: Vec<f64> = (0..count).map(|_| -self.unit().max(1e-300).ln()).collect();
        let sum: f64 = raw.iter().sum();
        raw.iter().map(|w| w / sum).collect()
    }
}

/// A disk of thickness² 1 / condition, its axis turned.
pub fn disk(condition: f64, turn: DMat3) -> Covariance {
    let matrix = Symmetric3::diagonal([1.0, 1.0, 1.0 / condition]).congruent(turn.transpose());
    Covariance::new(matrix).expect("a covariance")
}

/// Gaussians over a gently bent sheet, n × n, all turned away from a common orientation by about `turn`.
pub fn sheet(n: usize, condition: f64, turn: f64, random: &mut Random) -> Vec<(DVec3, Covariance)> {
    let common = random.rotation(3.0);
    let gaussian = |(i, j): (usize, usize)| {
        let [x, y] = [i, j].map(|k| k as f64 / (n - 1) as f64 - 0.5);
        let mean = common * DVec3::new(x, y, 0.2 * (x * x - y) + 0.05 * random.unit());
        (mean, disk(condition, common * random.rotation(turn)))
    };
    (0..n * n).map(|k| (k % n, k / n)).map(gaussian).collect()
}

/// The Bézier form of the bicubic B-spline patch with these 16 control points.
pub fn square(gaussians: &[(DVec3, Covariance)], frame: &DualFrame) -> DualSquare {
    let duals: Vec<Dual> = gaussians
        .iter()
        .map(|(mean, covariance)| Dual::of(*mean, covariance, frame))
        .collect();
    let rows = [
        [1.0, 4.0, 1.0, 0.0],
        [0.0, 4.0, 2.0, 0.0],
        [0.0, 2.0, 4.0, 0.0],
        [0.0, 1.0, 4.0, 1.0],
    ];
    combined(&duals, rows.map(|row| row.map(|w| w / 6.0)))
}

/// The patch with control points Σ rows[b][j] rows[a][i] of 16.
pub fn combined(duals: &[Dual], rows: [[f64; 4]; 4]) -> DualSquare {
    let control = |(a, b): (usize, usize)| {
        let terms = (0..16).map(|k| duals[k] * (rows[a][k % 4] * rows[b][k / 4]));
        terms.fold(Dual::default(), |sum, term| sum + term)
    };
    let controls = (0..16).map(|k| control((k % 4, k / 4))).collect();
    DualSquare::new([3, 3], controls).expect("16 control points")
}

/// A quartic triangle with control points near a plane. As for a point of a subdivision surface, several Gaussians count at each: it is
/// half one and half the mean of all.
pub fn triangle(condition: f64, turn: f64, random: &mut Random) -> (DualTriangle, DualFrame) {
    let places = (0..=4u32).flat_map(|j| (0..=4 - j).map(move |i| (i, j)));
    let gaussians: Vec<(DVec3, Covariance)> = places
        .map(|(i, j)| {
            let [x, y] = [i, j].map(|k| f64::from(k) / 4.0);
            (
                DVec3::new(x, y, 0.2 * random.unit()),
                disk(condition, random.rotation(turn)),
            )
        })
        .collect();
    let frame = DualFrame::whitened(&gaussians);
    let duals: Vec<Dual> = gaussians
        .iter()
        .map(|(mean, covariance)| Dual::of(*mean, covariance, &frame))
        .collect();
    let sum = duals.iter().fold(Dual::default(), |sum, &dual| sum + dual);
    let controls = duals.iter().map(|&dual| dual * 0.5 + sum * (0.5 / 15.0)).collect();
    (DualTriangle::new(4, controls).expect("15 control points"), frame)
}

pub fn mesh(positions: Vec<DVec3>, faces: &[Vec<u32>]) -> PolygonMesh {
    PolygonMesh {
        positions,
        faces: faces.iter().collect(),
        corners: CornerAttributes::default(),
    }
}

/// The cube −1..1.
pub fn cube() -> PolygonMesh {
    let faces = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let position = |k: u32| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)) * 2.0 - 1.0;
    mesh((0..8).map(position).collect(), &faces.map(|face| face.to_vec()))
}
