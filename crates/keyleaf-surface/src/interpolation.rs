//! Between the samples of a map. Twin of `shaders/shared/{catmull_rom,heights_bicubic,heights_bilinear}.wgsl`.

/// How heights between samples are found. Both go exactly through the samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// Catmull-Rom splines along both axes: smooth (C1), may overshoot. The default.
    #[default]
    Bicubic,
    /// Linear along both axes: creases between cells, no overshoot.
    Bilinear,
}

/// (value, d/di, d/dj) at (i + f, j + g) for samples at integers.
pub fn interpolate(
    mode: Interpolation,
    sample: impl Fn(i64, i64) -> f64,
    [i, j]: [i64; 2],
    [f, g]: [f64; 2],
) -> [f64; 3] {
    let basis = match mode {
        Interpolation::Bicubic => catmull_rom,
        Interpolation::Bilinear => linear,
    };
    let ([x, dx], [y, dy]) = (basis(f), basis(g));
    let reference = sample(i, j);
    let mut sum = [reference, 0.0, 0.0];
    for (row, (y, dy)) in y.into_iter().zip(dy).enumerate() {
        for (column, (x, dx)) in x.into_iter().zip(dx).enumerate() {
            if (x, dx) != (0.0, 0.0) && (y, dy) != (0.0, 0.0) {
                let difference = sample(i + column as i64 - 1, j + row as i64 - 1) - reference;
                sum[0] += x * y * difference;
                sum[1] += dx * y * difference;
                sum[2] += x * dy * difference;
            }
        }
    }
    sum
}

/// Weights of the samples at -1, 0, 1, 2 and their derivatives (Catmull and Rom 1974).
fn catmull_rom(f: f64) -> [[f64; 4]; 2] {
    let (f2, f3) = (f * f, f * f * f);
    [
        [
            -0.5 * f + f2 - 0.5 * f3,
            1.0 - 2.5 * f2 + 1.5 * f3,
            0.5 * f + 2.0 * f2 - 1.5 * f3,
            0.5 * f3 - 0.5 * f2,
        ],
        [
            -0.5 + 2.0 * f - 1.5 * f2,
            4.5 * f2 - 5.0 * f,
            0.5 + 4.0 * f - 4.5 * f2,
            1.5 * f2 - f,
        ],
    ]
}

fn linear(f: f64) -> [[f64; 4]; 2] {
    [[0.0, 1.0 - f, f, 0.0], [0.0, -1.0, 1.0, 0.0]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_planes_and_slopes_are_reproduced() {
        let plane = |i: i64, j: i64| 3.0 + 2.0 * i as f64 - 0.5 * j as f64;
        let wave = |i: i64, j: i64| (i as f64).sin() * (0.7 * j as f64).cos();
        for mode in [Interpolation::Bicubic, Interpolation::Bilinear] {
            for (f, g) in [(0.0, 0.0), (0.25, 1.0), (0.3, 0.9)] {
                let [h, di, dj] = interpolate(mode, plane, [4, -2], [f, g]);
                assert!(
                    (h - (12.0 + 2.0 * f - 0.5 * g)).abs() < 1e-12
                        && (di - 2.0).abs() < 1e-12
                        && (dj + 0.5).abs() < 1e-12
                );
            }
            let at = |f: f64, g: f64| interpolate(mode, wave, [2, 5], [f, g]);
            assert_eq!(at(0.0, 0.0)[0], wave(2, 5));
            assert!((at(1.0, 1.0)[0] - wave(3, 6)).abs() < 1e-15);
            let step = 1e-6;
            let numeric = (at(0.4 + step, 0.3)[0] - at(0.4 - step, 0.3)[0]) / (2.0 * step);
            assert!((at(0.4, 0.3)[1] - numeric).abs() < 1e-8);
            let numeric = (at(0.4, 0.3 + step)[0] - at(0.4, 0.3 - step)[0]) / (2.0 * step);
            assert!((at(0.4, 0.3)[2] - numeric).abs() < 1e-8);
        }
    }
}
