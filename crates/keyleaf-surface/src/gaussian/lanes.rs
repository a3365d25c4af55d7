//! Nets of control points in dual space, number by number: loops over all control points are short, straight, and done two or more at a
//! time by any processor.

use super::dual::{Dual, DualFrame};
use glam::{DMat3, DVec3};

/// The numbers (q̂ xx, xy, xz, yy, yz, zz, q̄ x, y, z), each of N control points. Where a net has fewer, the last ones repeat the first.
#[derive(Clone, Copy, Debug)]
pub struct Lanes<const N: usize>(pub [[f64; N]; 9]);

/// As many as patches have.
pub const CONTROLS: usize = 16;

/// As many as their first derivatives have.
pub const FIRST: usize = 12;

/// As many as their second derivatives have.
pub const SECOND: usize = 10;

/// By coefficient of lower degree, what it counts in each of the degree of the patches.
pub type Raising<const N: usize> = [[f64; CONTROLS]; N];

/// How patches of one shape are differentiated and cut.
pub trait Net {
    /// What the control points count in the middle.
    const MIDDLE: [f64; CONTROLS];
    /// The same of derivatives along both directions.
    const MIDDLE_OF_FIRST: [[f64; FIRST]; 2];
    /// The same of derivatives along the first direction twice, both, and the second twice.
    const MIDDLE_OF_SECOND: [[f64; SECOND]; 3];

    /// Coefficients of derivatives along both directions as those of a patch.
    const RAISE_FIRST: [Raising<FIRST>; 2];
    /// The same of second derivatives.
    const RAISE_SECOND: [Raising<SECOND>; 3];

    /// The derivatives along both directions.
    fn first(&self, net: &Lanes<CONTROLS>) -> [Lanes<FIRST>; 2];
    /// From these, the derivatives along the first direction twice, both, and the second twice.
    fn second(&self, first: &[Lanes<FIRST>; 2]) -> [Lanes<SECOND>; 3];
    /// Four parts, in parameters half as long; these may run backwards.
    fn quarters(&self, net: &Lanes<CONTROLS>) -> [Lanes<CONTROLS>; 4];

    /// Into how many parts a net is [`cut`](Self::cut).
    const PIECES: usize;
    /// The parts of a net that changes most along one direction, and by how much longer their parameters are.
    fn cut(&self, net: &Lanes<CONTROLS>, is_along_v: bool) -> impl Iterator<Item = (Lanes<CONTROLS>, [f64; 2])>;
}

impl Lanes<CONTROLS> {
    /// Of these control points.
    pub fn of(controls: &[Dual]) -> Self {
        let first = controls.first().copied().unwrap_or_default().to_array();
        let mut lanes = Self(first.map(|number| [number; CONTROLS]));
        for (k, control) in controls.iter().take(CONTROLS).enumerate() {
            for (lane, number) in lanes.0.iter_mut().zip(control.to_array()) {
                lane[k] = number;
            }
        }
        lanes
    }
}

impl Lanes<CONTROLS> {
    /// Of a first control point, and the differences of the others to it.
    pub fn of_differences(points: &[[f64; 9]]) -> Self {
        let first = points.first().copied().unwrap_or_default();
        let mut lanes = Self(first.map(|number| [number; CONTROLS]));
        for (k, difference) in points.iter().enumerate().take(CONTROLS).skip(1) {
            for (lane, number) in lanes.0.iter_mut().zip(difference) {
                lane[k] += number;
            }
        }
        lanes
    }
}

impl<const N: usize> Lanes<N> {
    /// A control point.
    pub fn control(&self, k: usize) -> Dual {
        Dual::from_array(self.0.map(|lane| lane[k]))
    }

    /// With every lane mapped: the second argument is what the first becomes.
    pub fn map<const M: usize>(&self, f: impl Fn(&[f64; N], &mut [f64; M])) -> Lanes<M> {
        let mut mapped = Lanes([[0.0; M]; 9]);
        for (lane, mapped) in self.0.iter().zip(&mut mapped.0) {
            f(lane, mapped);
        }
        mapped
    }

    /// A weighted sum of the control points.
    pub fn weighted(&self, weights: &[f64; N]) -> Dual {
        let mut sums = [0.0; 9];
        for (lane, sum) in self.0.iter().zip(&mut sums) {
            let mut halves = [0.0; 2];
            for (pair, weights) in lane.chunks_exact(2).zip(weights.chunks_exact(2)) {
                halves[0] += pair[0] * weights[0];
                halves[1] += pair[1] * weights[1];
            }
            *sum = halves[0] + halves[1];
        }
        Dual::from_array(sums)
    }

    /// The same net in the coordinates of another frame, as [`Dual::in_frame`].
    pub fn in_frame(&self, frame: &DualFrame) -> Self {
        let [a, b, c] = [frame.axes.x_axis, frame.axes.y_axis, frame.axes.z_axis];
        let centre = frame.centre;
        let [xx, xy, xz, yy, yz, zz, x, y, z] = &self.0;
        let mut inside = [[0.0; N]; 9];
        for k in 0..N {
            let times = |v: DVec3| {
                [
                    xx[k] * v.x + xy[k] * v.y + xz[k] * v.z,
                    xy[k] * v.x + yy[k] * v.y + yz[k] * v.z,
                    xz[k] * v.x + yz[k] * v.y + zz[k] * v.z,
                ]
            };
            let dot = |v: DVec3, w: [f64; 3]| v.x * w[0] + v.y * w[1] + v.z * w[2];
            let (ta, tb, tc, moved) = (times(a), times(b), times(c), times(centre));
            let information = [x[k] - moved[0], y[k] - moved[1], z[k] - moved[2]];
            inside[0][k] = dot(a, ta);
            inside[1][k] = dot(a, tb);
            inside[2][k] = dot(a, tc);
            inside[3][k] = dot(b, tb);
            inside[4][k] = dot(b, tc);
            inside[5][k] = dot(c, tc);
            inside[6][k] = dot(a, information);
            inside[7][k] = dot(b, information);
            inside[8][k] = dot(c, information);
        }
        Self(inside)
    }

    /// The largest norm of q̂ − `from.precision`, and the longest q̄ − `from.information`.
    pub fn farthest(&self, from: Dual) -> [f64; 2] {
        let [xx, xy, xz, yy, yz, zz, x, y, z] = &self.0;
        let Dual { precision, information } = from;
        let mut squares = [[0.0; N]; 2];
        for k in 0..N {
            let [a, b, c] = [xx[k] - precision.xx, yy[k] - precision.yy, zz[k] - precision.zz];
            let [d, e, f] = [xy[k] - precision.xy, xz[k] - precision.xz, yz[k] - precision.yz];
            squares[0][k] = a * a + b * b + c * c + 2.0 * (d * d + e * e + f * f);
            let [a, b, c] = [x[k] - information.x, y[k] - information.y, z[k] - information.z];
            squares[1][k] = a * a + b * b + c * c;
        }
        squares.map(|squares| greatest(&squares).sqrt())
    }

    /// The largest norm of q̂, the longest q̄ − `from`, and the longest of these mapped by `map`.
    pub fn largest(&self, from: DVec3, map: DMat3) -> [f64; 3] {
        let [xx, xy, xz, yy, yz, zz, x, y, z] = &self.0;
        let [a, b, c] = [map.x_axis, map.y_axis, map.z_axis];
        let mut squares = [[0.0; N]; 3];
        for k in 0..N {
            let beside = xy[k] * xy[k] + xz[k] * xz[k] + yz[k] * yz[k];
            squares[0][k] = xx[k] * xx[k] + yy[k] * yy[k] + zz[k] * zz[k] + 2.0 * beside;
            let [x, y, z] = [x[k] - from.x, y[k] - from.y, z[k] - from.z];
            squares[1][k] = x * x + y * y + z * z;
            let mapped = [
                a.x * x + b.x * y + c.x * z,
                a.y * x + b.y * y + c.y * z,
                a.z * x + b.z * y + c.z * z,
            ];
            squares[2][k] = mapped[0] * mapped[0] + mapped[1] * mapped[1] + mapped[2] * mapped[2];
        }
        squares.map(|squares| greatest(&squares).sqrt())
    }

    /// The norms of q̂, and the lengths of q̄.
    pub fn norms(&self) -> [[f64; N]; 2] {
        let [xx, xy, xz, yy, yz, zz, x, y, z] = &self.0;
        let mut norms = [[0.0; N]; 2];
        for k in 0..N {
            let beside = xy[k] * xy[k] + xz[k] * xz[k] + yz[k] * yz[k];
            norms[0][k] = (xx[k] * xx[k] + yy[k] * yy[k] + zz[k] * zz[k] + 2.0 * beside).sqrt();
            norms[1][k] = (x[k] * x[k] + y[k] * y[k] + z[k] * z[k]).sqrt();
        }
        norms
    }

    /// The least eigenvalue of q̂ at a control point, at most `least`.
    pub fn least_eigenvalue(&self, mut least: f64) -> f64 {
        let mut is_known = [false; N];
        loop {
            // Where the determinant of q̂ − `least` or a minor is not positive, an eigenvalue is less; it is likely the least of all where
            // the determinant is.
            let determinants = self.definite_determinants(least);
            let below = (0..N).filter(|&k| !is_known[k] && (determinants[k] <= 0.0 || determinants[k].is_nan()));
            let Some(next) = below.min_by(|&j, &k| determinants[j].total_cmp(&determinants[k])) else {
                return least;
            };
            is_known[next] = true;
            least = f64::min(least, self.control(next).precision.eigen().values[2]);
        }
    }

    /// The determinants of q̂ − `shift` where that is positive definite, elsewhere numbers that are not positive.
    fn definite_determinants(&self, shift: f64) -> [f64; N] {
        let [xx, xy, xz, yy, yz, zz, ..] = &self.0;
        let mut determinants = [0.0; N];
        for k in 0..N {
            let [dx, dy, dz] = [xx[k] - shift, yy[k] - shift, zz[k] - shift];
            let minor = dx * dy - xy[k] * xy[k];
            let [x, y] = [yz[k] * xy[k] - xz[k] * dy, yz[k] * dx - xz[k] * xy[k]];
            let determinant = dz * minor + xz[k] * x - yz[k] * y;
            let least = if dx < minor { dx } else { minor };
            determinants[k] = if determinant < least || least > 0.0 {
                determinant
            } else {
                least
            };
        }
        determinants
    }

    /// The traces of q̂.
    pub fn traces(&self) -> [f64; N] {
        let [xx, _, _, yy, _, zz, ..] = &self.0;
        std::array::from_fn(|k| xx[k] + yy[k] + zz[k])
    }

    /// The lengths of q̄ − q̂ `mean`.
    pub fn residuals(&self, mean: DVec3) -> [f64; N] {
        let [xx, xy, xz, yy, yz, zz, x, y, z] = &self.0;
        std::array::from_fn(|k| {
            let dx = x[k] - (xx[k] * mean.x + xy[k] * mean.y + xz[k] * mean.z);
            let dy = y[k] - (xy[k] * mean.x + yy[k] * mean.y + yz[k] * mean.z);
            let dz = z[k] - (xz[k] * mean.x + yz[k] * mean.y + zz[k] * mean.z);
            (dx * dx + dy * dy + dz * dz).sqrt()
        })
    }

    /// The least eigenvalues of q̂ from below, at most by a quarter, by Samuelson's inequality for their reciprocals; 0 where q̂ is not
    /// positive definite.
    pub fn least_eigenvalues(&self) -> [f64; N] {
        let [xx, xy, xz, yy, yz, zz, ..] = &self.0;
        std::array::from_fn(|k| {
            let trace = xx[k] + yy[k] + zz[k];
            let [z, y, x] = [
                xx[k] * yy[k] - xy[k] * xy[k],
                xx[k] * zz[k] - xz[k] * xz[k],
                yy[k] * zz[k] - yz[k] * yz[k],
            ];
            let minors = x + y + z;
            let beside = xz[k] * (xy[k] * yz[k] - xz[k] * yy[k]) - yz[k] * (xx[k] * yz[k] - xy[k] * xz[k]);
            let determinant = zz[k] * z + beside;
            let root = (4.0 * minors * minors - 12.0 * determinant * trace).max(0.0).sqrt();
            let is_definite = determinant > 0.0 && minors > 0.0 && trace > 0.0;
            if is_definite {
                3.0 * determinant / (minors + root)
            } else {
                0.0
            }
        })
    }

    /// q̄ mapped by `map`.
    fn information_mapped(&self, map: DMat3) -> [[f64; N]; 3] {
        let [.., x, y, z] = &self.0;
        let rows = map.transpose();
        let mut mapped = [[0.0; N]; 3];
        for (row, lane) in [rows.x_axis, rows.y_axis, rows.z_axis].into_iter().zip(&mut mapped) {
            for k in 0..N {
                lane[k] = row.x * x[k] + row.y * y[k] + row.z * z[k];
            }
        }
        mapped
    }

    /// The least and the greatest coordinates of q̄ mapped by `map`.
    pub fn extent(&self, map: DMat3) -> [DVec3; 2] {
        let mapped = self.information_mapped(map);
        let mut extent = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let [x, y, z] = &mapped;
        for ((&x, &y), &z) in x.iter().zip(y).zip(z) {
            let point = DVec3::new(x, y, z);
            extent = [extent[0].min(point), extent[1].max(point)];
        }
        extent
    }
}

/// The greatest of an even number of numbers from 0; not-a-numbers do not count.
fn greatest<const N: usize>(numbers: &[f64; N]) -> f64 {
    let mut greatest = [0.0; 2];
    for pair in numbers.chunks_exact(2) {
        greatest[0] = if pair[0] > greatest[0] { pair[0] } else { greatest[0] };
        greatest[1] = if pair[1] > greatest[1] { pair[1] } else { greatest[1] };
    }
    f64::max(greatest[0], greatest[1])
}

/// Bicubic patches, along u and v.
pub struct Square;

impl Net for Square {
    const MIDDLE: [f64; CONTROLS] = product([0.125, 0.375, 0.375, 0.125], [0.125, 0.375, 0.375, 0.125]);
    const MIDDLE_OF_FIRST: [[f64; FIRST]; 2] = [
        product([0.25, 0.5, 0.25], [0.125, 0.375, 0.375, 0.125]),
        product([0.125, 0.375, 0.375, 0.125], [0.25, 0.5, 0.25]),
    ];
    const MIDDLE_OF_SECOND: [[f64; SECOND]; 3] = [
        product([0.5, 0.5], [0.125, 0.375, 0.375, 0.125]),
        product([0.25, 0.5, 0.25], [0.25, 0.5, 0.25]),
        product([0.125, 0.375, 0.375, 0.125], [0.5, 0.5]),
    ];
    const RAISE_FIRST: [Raising<FIRST>; 2] = [raising([2, 3]), raising([3, 2])];
    const RAISE_SECOND: [Raising<SECOND>; 3] = [raising([1, 3]), raising([2, 2]), raising([3, 1])];

    fn first(&self, net: &Lanes<CONTROLS>) -> [Lanes<FIRST>; 2] {
        let along = net.map(|lane, slopes| {
            for j in 0..4 {
                for i in 0..3 {
                    slopes[3 * j + i] = 3.0 * (lane[4 * j + i + 1] - lane[4 * j + i]);
                }
            }
        });
        [
            along,
            net.map(|lane, slopes: &mut [f64; FIRST]| up::<4, 12>(3.0, lane, slopes)),
        ]
    }

    fn second(&self, [u, v]: &[Lanes<FIRST>; 2]) -> [Lanes<SECOND>; 3] {
        let along = u.map(|lane, bends: &mut [f64; SECOND]| {
            for j in 0..4 {
                for i in 0..2 {
                    bends[2 * j + i] = 2.0 * (lane[3 * j + i + 1] - lane[3 * j + i]);
                }
            }
            repeat_first::<8>(bends);
        });
        let both = u.map(|lane, bends: &mut [f64; SECOND]| {
            up::<3, 9>(3.0, lane, bends);
            repeat_first::<9>(bends);
        });
        let up = v.map(|lane, bends: &mut [f64; SECOND]| {
            up::<4, 8>(2.0, lane, bends);
            repeat_first::<8>(bends);
        });
        [along, both, up]
    }

    fn quarters(&self, net: &Lanes<CONTROLS>) -> [Lanes<CONTROLS>; 4] {
        let [below, above] = [half(net, true, 0), half(net, true, 1)];
        [
            half(&below, false, 0),
            half(&below, false, 1),
            half(&above, false, 0),
            half(&above, false, 1),
        ]
    }

    const PIECES: usize = 2;

    /// Halves.
    fn cut(&self, net: &Lanes<CONTROLS>, is_along_v: bool) -> impl Iterator<Item = (Lanes<CONTROLS>, [f64; 2])> {
        let scale = if is_along_v { [1.0, 2.0] } else { [2.0, 1.0] };
        [0, 1].map(|k| (half(net, is_along_v, k), scale)).into_iter()
    }
}

/// The first or the second half of a bicubic net along one direction.
fn half(net: &Lanes<CONTROLS>, is_along_v: bool, half: usize) -> Lanes<CONTROLS> {
    if is_along_v {
        net.map(|lane, part| halve(lane, part, half, |line, k| line + 4 * k))
    } else {
        net.map(|lane, part| halve(lane, part, half, |line, k| 4 * line + k))
    }
}

/// Differences of the rows of a net with rows of this width, times the degree.
fn up<const WIDTH: usize, const COUNT: usize>(degree: f64, lane: &[f64], slopes: &mut [f64]) {
    let (lane, above, slopes) = (&lane[..COUNT], &lane[WIDTH..][..COUNT], &mut slopes[..COUNT]);
    for k in 0..COUNT {
        slopes[k] = degree * (above[k] - lane[k]);
    }
}

fn repeat_first<const FROM: usize>(lane: &mut [f64; SECOND]) {
    for k in FROM..SECOND {
        lane[k] = lane[0];
    }
}

/// Products of weights along u and v, u fastest; zeros after them.
const fn product<const P: usize, const Q: usize, const N: usize>(along: [f64; P], up: [f64; Q]) -> [f64; N] {
    let mut weights = [0.0; N];
    let mut k = 0;
    while k < P * Q {
        weights[k] = along[k % P] * up[k / P];
        k += 1;
    }
    weights
}

/// From these degrees along u and v to cubic ones.
const fn raising<const N: usize>([p, q]: [usize; 2]) -> Raising<N> {
    let mut weights = [[0.0; CONTROLS]; N];
    let mut j = 0;
    while j < (p + 1) * (q + 1) {
        let mut k = 0;
        while k < CONTROLS {
            weights[j][k] = raised(p, j % (p + 1), k % 4) * raised(q, j / (p + 1), k / 4);
            k += 1;
        }
        j += 1;
    }
    weights
}

/// What the coefficient j of degree p counts in the coefficient k of degree 3.
const fn raised(p: usize, j: usize, k: usize) -> f64 {
    if k < j || k - j > 3 - p {
        return 0.0;
    }
    const CHOOSE: [[f64; 4]; 4] = [
        [1.0, 0.0, 0.0, 0.0],
        [1.0, 1.0, 0.0, 0.0],
        [1.0, 2.0, 1.0, 0.0],
        [1.0, 3.0, 3.0, 1.0],
    ];
    CHOOSE[p][j] * CHOOSE[3 - p][k - j] / CHOOSE[3][k]
}

/// The lower or the upper half of the four cubic lines of a net, by de Casteljau's algorithm.
fn halve(lane: &[f64; CONTROLS], part: &mut [f64; CONTROLS], half: usize, place: impl Fn(usize, usize) -> usize) {
    for line in 0..4 {
        let [a, b, c, d] = [
            lane[place(line, 0)],
            lane[place(line, 1)],
            lane[place(line, 2)],
            lane[place(line, 3)],
        ];
        let mean = |a: f64, b: f64| (a + b) * 0.5;
        let (ab, bc, cd) = (mean(a, b), mean(b, c), mean(c, d));
        let (abc, bcd) = (mean(ab, bc), mean(bc, cd));
        let middle = mean(abc, bcd);
        let own = if half == 0 {
            [a, ab, abc, middle]
        } else {
            [middle, bcd, cd, d]
        };
        for k in 0..4 {
            part[place(line, k)] = own[k];
        }
    }
}
