//! Gradient noise on integer lattices. Twin of `shaders/shared/{hash,noise2,noise3}.wgsl`: the same hashes and gradients, so that
//! only the arithmetic between them rounds differently.

/// Bounds the absolute value of [`noise2`]: the sum of the absolute weights of its gradients is greatest in the middle of a cell.
pub const NOISE2_LARGEST: f64 = 1.0;
/// Bounds the slope of [`noise2`] in any direction, a cell; greatest likewise.
pub const NOISE2_SLOPE: f64 = 2.75;
/// Bounds the absolute value of [`noise3`].
pub const NOISE3_LARGEST: f64 = 1.5;
/// Bounds the slope of [`noise3`] in any direction, a cell.
pub const NOISE3_SLOPE: f64 = 4.625;

/// The seed of an octave.
pub fn octave_seed(seed: u32, octave: u32) -> u32 {
    seed.wrapping_add(octave.wrapping_mul(0x9e37_79b9))
}

/// pcg2d of Jarzynski and Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020.
fn hash2([x, y]: [u32; 2], seed: u32) -> [u32; 2] {
    let first = |v: u32, seed: u32| v.wrapping_add(seed).wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
    let mix = |[x, y]: [u32; 2]| {
        let x = x.wrapping_add(y.wrapping_mul(1_664_525));
        let y = y.wrapping_add(x.wrapping_mul(1_664_525));
        [x ^ (x >> 16), y ^ (y >> 16)]
    };
    mix(mix([first(x, seed), first(y, seed ^ 0x85eb_ca6b)]))
}

/// pcg3d of the same paper.
fn hash3([x, y, z]: [u32; 3], seed: u32) -> [u32; 3] {
    let first = |v: u32, seed: u32| v.wrapping_add(seed).wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
    let mix = |[x, y, z]: [u32; 3]| {
        let x = x.wrapping_add(y.wrapping_mul(z));
        let y = y.wrapping_add(z.wrapping_mul(x));
        [x, y, z.wrapping_add(x.wrapping_mul(y))]
    };
    let v = mix([
        first(x, seed),
        first(y, seed ^ 0x85eb_ca6b),
        first(z, seed ^ 0xc2b2_ae35),
    ]);
    mix(v.map(|c| c ^ (c >> 16)))
}

/// Uniform in [-1, 1), in 16 bits.
fn component(hash: u32) -> f64 {
    (f64::from(hash >> 16) - 32_768.0) / 32_768.0
}

/// The quintic fade and its derivative (Perlin, "Improving Noise", SIGGRAPH 2002).
fn fade(f: f64) -> [f64; 2] {
    [
        f * f * f * (f * (f * 6.0 - 15.0) + 10.0),
        30.0 * f * f * (f - 1.0) * (f - 1.0),
    ]
}

/// (value, gradient a cell) at `cell` + f. The lattice repeats after `mask` + 1 cells.
pub fn noise2(cell: [u32; 2], mask: u32, f: [f64; 2], seed: u32) -> [f64; 3] {
    let fades = f.map(fade);
    let mut sum = [0.0; 3];
    for corner in 0..4 {
        let far = [corner & 1, corner >> 1];
        let lattice = [0, 1].map(|i| cell[i].wrapping_add(far[i]) & mask);
        let g = hash2(lattice, seed).map(component);
        let d: f64 = (0..2).map(|i| g[i] * (f[i] - f64::from(far[i]))).sum();
        let [[x, dx], [y, dy]] = [0, 1].map(|i| weight(fades[i], far[i]));
        sum[0] += x * y * d;
        sum[1] += x * y * g[0] + dx * y * d;
        sum[2] += x * y * g[1] + x * dy * d;
    }
    sum
}

/// (value, gradient a cell) at `cell` + f.
pub fn noise3(cell: [u32; 3], f: [f64; 3], seed: u32) -> [f64; 4] {
    let fades = f.map(fade);
    let mut sum = [0.0; 4];
    for corner in 0..8 {
        let far = [corner & 1, (corner >> 1) & 1, corner >> 2];
        let lattice = [0, 1, 2].map(|i| cell[i].wrapping_add(far[i]));
        let g = hash3(lattice, seed).map(component);
        let d: f64 = (0..3).map(|i| g[i] * (f[i] - f64::from(far[i]))).sum();
        let [[x, dx], [y, dy], [z, dz]] = [0, 1, 2].map(|i| weight(fades[i], far[i]));
        sum[0] += x * y * z * d;
        sum[1] += x * y * z * g[0] + dx * y * z * d;
        sum[2] += x * y * z * g[1] + x * dy * z * d;
        sum[3] += x * y * z * g[2] + x * y * dz * d;
    }
    sum
}

/// The weight of the near or far corner along an axis, and its derivative.
fn weight([fade, slope]: [f64; 2], far: u32) -> [f64; 2] {
    if far == 1 { [fade, slope] } else { [1.0 - fade, -slope] }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers in [0, 1) from a counter.
    fn sample(i: u32) -> f64 {
        f64::from(hash2([i, i ^ 0x5555], 7)[0]) / f64::from(u32::MAX)
    }

    #[test]
    fn gradients_are_the_derivatives_and_bounds_hold() {
        let step = 1e-5;
        for i in 0..2000 {
            let f = [sample(3 * i), sample(3 * i + 1), sample(3 * i + 2)];
            let cell = [i, 77 * i, 3];
            let n = noise3(cell, f, 5);
            assert!(n[0].abs() <= NOISE3_LARGEST && n[1].hypot(n[2]).hypot(n[3]) <= NOISE3_SLOPE);
            for axis in 0..3 {
                let moved = |by: f64| {
                    noise3(
                        cell,
                        std::array::from_fn(|k| f[k] + if k == axis { by } else { 0.0 }),
                        5,
                    )[0]
                };
                assert!(((moved(step) - moved(-step)) / (2.0 * step) - n[axis + 1]).abs() < 1e-6);
            }
            let (cell, f) = ([i & 255, (77 * i) & 255], [f[0], f[1]]);
            let n = noise2(cell, 255, f, 5);
            assert!(n[0].abs() <= NOISE2_LARGEST && n[1].hypot(n[2]) <= NOISE2_SLOPE);
            for axis in 0..2 {
                let moved = |by: f64| {
                    noise2(
                        cell,
                        255,
                        std::array::from_fn(|k| f[k] + if k == axis { by } else { 0.0 }),
                        5,
                    )[0]
                };
                assert!(((moved(step) - moved(-step)) / (2.0 * step) - n[axis + 1]).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn noise_is_continuous_from_cell_to_cell_and_around_the_border() {
        let (a, b) = (noise2([255, 3], 255, [1.0, 0.3], 9), noise2([0, 3], 255, [0.0, 0.3], 9));
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12));
        let (a, b) = (
            noise3([u32::MAX, 3, 4], [1.0, 0.3, 0.2], 9),
            noise3([0, 3, 4], [0.0, 0.3, 0.2], 9),
        );
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12));
    }

    /// The sums of absolute weights of all gradient components, maximised over directions and a grid of the cell.
    #[test]
    fn slope_bound_in_two_dimensions_is_the_supremum() {
        let mut greatest = 0.0f64;
        for (i, j) in (0..=50).flat_map(|i| (0..=50).map(move |j| (i, j))) {
            let f = [f64::from(i) / 50.0, f64::from(j) / 50.0];
            let fades = f.map(fade);
            for turn in 0..90 {
                let (sin, cos) = (f64::from(turn) * std::f64::consts::PI / 90.0).sin_cos();
                let mut sum = 0.0;
                for far in [[0, 0], [1, 0], [0, 1], [1, 1]] {
                    let [[x, dx], [y, dy]] = [0, 1].map(|k| weight(fades[k], far[k]));
                    let along = dx * y * cos + x * dy * sin;
                    sum += (x * y * cos + along * (f[0] - f64::from(far[0]))).abs();
                    sum += (x * y * sin + along * (f[1] - f64::from(far[1]))).abs();
                }
                greatest = greatest.max(sum);
            }
        }
        assert!(
            (NOISE2_SLOPE - 1e-9..=NOISE2_SLOPE + 1e-9).contains(&greatest),
            "{greatest}"
        );
    }
}
