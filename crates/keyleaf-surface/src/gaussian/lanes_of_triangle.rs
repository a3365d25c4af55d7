//! Quartic triangles among [nets](super::lanes).

use super::lanes::{CONTROLS, FIRST, Lanes, Net, Raising, SECOND};
use std::sync::LazyLock;

/// Quartic triangles, along two directions given by changes of barycentric coordinates that sum to 0.
pub struct Triangle {
    pub directions: [[f64; 3]; 2],
}

/// Along the second and the third barycentric coordinate.
pub const BARYCENTRIC: Triangle = Triangle {
    directions: [[-1.0, 1.0, 0.0], [-1.0, 0.0, 1.0]],
};

/// Control points of degrees 4, 3 and 2.
const COUNTS: [usize; 3] = [15, 10, 6];

impl Net for Triangle {
    const MIDDLE: [f64; CONTROLS] = middle(4);
    const MIDDLE_OF_FIRST: [[f64; FIRST]; 2] = [middle(3); 2];
    const MIDDLE_OF_SECOND: [[f64; SECOND]; 3] = [middle(2); 3];
    const RAISE_FIRST: [Raising<FIRST>; 2] = [raising(3); 2];
    const RAISE_SECOND: [Raising<SECOND>; 3] = [raising(2); 3];

    fn first(&self, net: &Lanes<CONTROLS>) -> [Lanes<FIRST>; 2] {
        let slopes =
            |along: [f64; 3]| net.map(|lane, slopes| step::<4, CONTROLS, FIRST>(along.map(|x| 4.0 * x), lane, slopes));
        let [a, b] = self.directions;
        [slopes(a), slopes(b)]
    }

    fn second(&self, [u, v]: &[Lanes<FIRST>; 2]) -> [Lanes<SECOND>; 3] {
        let bends = |net: &Lanes<FIRST>, along: [f64; 3]| {
            net.map(|lane, bends| step::<3, FIRST, SECOND>(along.map(|x| 3.0 * x), lane, bends))
        };
        let [a, b] = self.directions;
        [bends(u, a), bends(u, b), bends(v, b)]
    }

    fn quarters(&self, net: &Lanes<CONTROLS>) -> [Lanes<CONTROLS>; 4] {
        let quarter = |weights: &[[f64; CONTROLS]; CONTROLS]| {
            net.map(|lane, part: &mut [f64; CONTROLS]| {
                for (weights, control) in weights.iter().zip(lane) {
                    for k in 0..CONTROLS {
                        part[k] += weights[k] * control;
                    }
                }
            })
        };
        let [a, b, c, d] = &*QUARTERS;
        [quarter(a), quarter(b), quarter(c), quarter(d)]
    }

    const PIECES: usize = 4;

    /// Quarters.
    fn cut(&self, net: &Lanes<CONTROLS>, _is_along_v: bool) -> impl Iterator<Item = (Lanes<CONTROLS>, [f64; 2])> {
        self.quarters(net).map(|quarter| (quarter, [2.0; 2])).into_iter()
    }
}

/// The exponent pairs (i, j) of u and v of a control point.
const fn exponents(degree: usize, place: usize) -> [usize; 2] {
    let (mut j, mut first) = (0, 0);
    while place >= first + degree + 1 - j {
        first += degree + 1 - j;
        j += 1;
    }
    [place - first, j]
}

/// Rows 0..j have degree + 1, degree, … control points.
const fn place(degree: usize, [i, j]: [usize; 2]) -> usize {
    j * (2 * degree + 3 - j) / 2 + i
}

/// How often a product of n factors has them in this order of barycentric coordinates.
const fn ways(degree: usize, [i, j]: [usize; 2]) -> f64 {
    let factorials = [1.0, 1.0, 2.0, 6.0, 24.0];
    factorials[degree] / (factorials[i] * factorials[j] * factorials[degree - i - j])
}

const fn middle<const N: usize>(degree: usize) -> [f64; N] {
    let powers = [1.0, 3.0, 9.0, 27.0, 81.0];
    let mut weights = [0.0; N];
    let mut k = 0;
    while k < COUNTS[4 - degree] {
        weights[k] = ways(degree, exponents(degree, k)) / powers[degree];
        k += 1;
    }
    weights
}

/// From this degree to quartic ones. The last place repeats the first.
const fn raising<const N: usize>(degree: usize) -> Raising<N> {
    let mut weights = [[0.0; CONTROLS]; N];
    let mut n = 0;
    while n < COUNTS[4 - degree] {
        let [i, j] = exponents(degree, n);
        let mut m = 0;
        while m < CONTROLS {
            let [k, l] = exponents(4, if m < COUNTS[0] { m } else { 0 });
            if k >= i && l >= j && k + l - i - j <= 4 - degree {
                let rest = ways(4 - degree, [k - i, l - j]);
                weights[n][m] = ways(degree, [i, j]) * rest / ways(4, [k, l]);
            }
            m += 1;
        }
        n += 1;
    }
    weights
}

/// The polar form with one argument set: a step of de Casteljau's algorithm, or, along a direction, a derivative.
fn step<const DEGREE: usize, const N: usize, const M: usize>(at: [f64; 3], lane: &[f64; N], stepped: &mut [f64; M]) {
    let operands = const { operands::<DEGREE, M>() };
    for k in 0..M {
        let [a, b, c] = operands[k];
        stepped[k] = lane[a] * at[0] + lane[b] * at[1] + lane[c] * at[2];
    }
}

/// What a step takes together. Where there are fewer, the last ones repeat the first.
const fn operands<const DEGREE: usize, const M: usize>() -> [[usize; 3]; M] {
    let mut operands = [[0; 3]; M];
    let mut k = 0;
    while k < M {
        let [i, j] = exponents(DEGREE - 1, if k < COUNTS[5 - DEGREE] { k } else { 0 });
        operands[k] = [
            place(DEGREE, [i, j]),
            place(DEGREE, [i + 1, j]),
            place(DEGREE, [i, j + 1]),
        ];
        k += 1;
    }
    operands
}

/// What every control point of a net counts in those of its quarters.
static QUARTERS: LazyLock<[[[f64; CONTROLS]; CONTROLS]; 4]> = LazyLock::new(|| {
    let corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let middles = [[0.5, 0.5, 0.0], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5]];
    let parts = [
        [corners[0], middles[0], middles[2]],
        [middles[0], corners[1], middles[1]],
        [middles[2], middles[1], corners[2]],
        [middles[1], middles[2], middles[0]],
    ];
    parts.map(|part| {
        std::array::from_fn(|control| {
            let unit: [f64; CONTROLS] = std::array::from_fn(|k| if k == control { 1.0 } else { 0.0 });
            std::array::from_fn(|k| {
                let [i, j] = exponents(4, if k < COUNTS[0] { k } else { 0 });
                polar(
                    &unit,
                    std::array::from_fn(|n| {
                        part[if n < i {
                            1
                        } else if n < i + j {
                            2
                        } else {
                            0
                        }]
                    }),
                )
            })
        })
    })
});

/// The polar form at four points.
fn polar(net: &[f64; CONTROLS], at: [[f64; 3]; 4]) -> f64 {
    let (mut cubic, mut quadratic) = ([0.0; 10], [0.0; 6]);
    step::<4, CONTROLS, 10>(at[0], net, &mut cubic);
    step::<3, 10, 6>(at[1], &cubic, &mut quadratic);
    let [a, b, c, d, e, f] = quadratic;
    // Degree 1 and 0 by hand: rows (a b c), (d e), (f).
    let [x, y, z] = at[2];
    let linear = [a * x + b * y + d * z, b * x + c * y + e * z, d * x + e * y + f * z];
    linear[0] * at[3][0] + linear[1] * at[3][1] + linear[2] * at[3][2]
}
