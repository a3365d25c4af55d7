//! Bézier patches whose control points are Gaussians in dual space.
//!
//! The surface is the mean of what the patch is in dual space: no linear image of its control points, and single control points may
//! be no Gaussians (rows of subdivision matrices have negative entries) as long as the sum is one.

use super::dual::{Dual, DualFrame, DualJet};

/// A net of control points with one shape, which can be differentiated and cut.
pub trait DualNet: Sized {
    /// What one can differentiate along.
    type Direction: Copy;

    /// The control points.
    fn controls(&self) -> &[Dual];
    /// The same net with other control points.
    fn map(&self, f: impl Fn(&Dual) -> Dual) -> Self;
    /// The derivative along a direction.
    fn derivative(&self, along: Self::Direction) -> Self;
    /// The value in the middle.
    fn middle(&self) -> Dual;
    /// Four parts, in parameters half as long; these may run backwards.
    fn quarters(&self) -> [Self; 4];
}

/// A tensor-product Bézier patch over the unit square.
#[derive(Clone, Debug, PartialEq)]
pub struct DualSquare {
    degree: [usize; 2],
    controls: Vec<Dual>,
}

impl DualSquare {
    /// A patch of these degrees in u and v, with (p + 1)(q + 1) control points, u fastest; none if their number is another or a
    /// degree is zero.
    pub fn new(degree: [usize; 2], controls: Vec<Dual>) -> Option<Self> {
        let fits = degree[0] > 0 && degree[1] > 0 && controls.len() == (degree[0] + 1) * (degree[1] + 1);
        fits.then_some(Self { degree, controls })
    }

    /// Value and derivatives at (u, v).
    pub fn jet(&self, [u, v]: [f64; 2]) -> DualJet {
        let rows: Vec<[Dual; 3]> = self
            .controls
            .chunks(self.degree[0] + 1)
            .map(|row| curve_jet(row, u))
            .collect();
        let column = |order: usize| {
            let column: Vec<Dual> = rows.iter().map(|row| row[order]).collect();
            curve_jet(&column, v)
        };
        let [[value, dv, dvv], [du, duv, _], [duu, _, _]] = [column(0), column(1), column(2)];
        DualJet {
            terms: [value, du, dv, duu, duv, dvv],
        }
    }

    fn lines(&self, axis: usize) -> impl Iterator<Item = Vec<Dual>> + '_ {
        let width = self.degree[0] + 1;
        let (step, line_step) = if axis == 0 { (1, width) } else { (width, 1) };
        (0..=self.degree[1 - axis]).map(move |line| {
            (0..=self.degree[axis])
                .map(|k| self.controls[line * line_step + k * step])
                .collect()
        })
    }

    fn of_lines(axis: usize, lines: &[Vec<Dual>]) -> Self {
        let (count, length) = (lines.len(), lines.first().map_or(0, Vec::len));
        let controls = if axis == 0 {
            lines.concat()
        } else {
            (0..length)
                .flat_map(|k| lines.iter().map(move |line| line[k]))
                .collect()
        };
        let mut degree = [length - 1, count - 1];
        if axis == 1 {
            degree.reverse();
        }
        Self { degree, controls }
    }

    fn halves(&self, axis: usize) -> [Self; 2] {
        let (low, high): (Vec<_>, Vec<_>) = self.lines(axis).map(halves).unzip();
        [low, high].map(|lines| Self::of_lines(axis, &lines))
    }
}

impl DualNet for DualSquare {
    /// 0 for u, 1 for v.
    type Direction = usize;

    fn controls(&self) -> &[Dual] {
        &self.controls
    }

    fn map(&self, f: impl Fn(&Dual) -> Dual) -> Self {
        Self {
            degree: self.degree,
            controls: self.controls.iter().map(f).collect(),
        }
    }

    fn derivative(&self, axis: usize) -> Self {
        let [p, q] = self.degree;
        if self.degree[axis] == 0 {
            return self.map(|_| Dual::default());
        }
        let (width, step) = (p + 1, if axis == 0 { 1 } else { p + 1 });
        let (columns, rows) = if axis == 0 { (p, q + 1) } else { (p + 1, q) };
        let places = (0..rows).flat_map(|j| (0..columns).map(move |i| j * width + i));
        let scale = self.degree[axis] as f64;
        let slope = |place: usize| (self.controls[place + step] - self.controls[place]) * scale;
        Self {
            degree: [columns - 1, rows - 1],
            controls: places.map(slope).collect(),
        }
    }

    fn middle(&self) -> Dual {
        let [p, q] = self.degree;
        let terms = self.controls.iter().zip(0..);
        terms.fold(Dual::default(), |sum, (control, place)| {
            sum + *control * (halfway(p, place % (p + 1)) * halfway(q, place / (p + 1)))
        })
    }

    fn quarters(&self) -> [Self; 4] {
        let [[a, b], [c, d]] = self.halves(1).map(|half| half.halves(0));
        [a, b, c, d]
    }
}

/// The Bernstein polynomial k of a degree at 1/2.
fn halfway(degree: usize, k: usize) -> f64 {
    binomial(degree, k) * 0.5f64.powi(degree as i32)
}

fn binomial(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |product, i| product * (n - i) as f64 / (i + 1) as f64)
}

/// Value, first and second derivative of a Bézier curve, by de Casteljau's algorithm.
fn curve_jet(controls: &[Dual], t: f64) -> [Dual; 3] {
    let n = (controls.len() - 1) as f64;
    let mut points = controls.to_vec();
    let mut jet = [Dual::default(); 3];
    while points.len() > 1 {
        if points.len() == 3 {
            jet[2] = (points[2] - points[1] * 2.0 + points[0]) * (n * (n - 1.0));
        }
        if points.len() == 2 {
            jet[1] = (points[1] - points[0]) * n;
        }
        points = points
            .windows(2)
            .map(|pair| pair[0] * (1.0 - t) + pair[1] * t)
            .collect();
    }
    jet[0] = points[0];
    jet
}

fn halves(mut line: Vec<Dual>) -> (Vec<Dual>, Vec<Dual>) {
    let (mut low, mut high) = (Vec::new(), Vec::new());
    while let (Some(&first), Some(&last)) = (line.first(), line.last()) {
        low.push(first);
        high.push(last);
        line = line.windows(2).map(|pair| (pair[0] + pair[1]) * 0.5).collect();
    }
    high.reverse();
    (low, high)
}

/// Barycentric coordinates of a point, which sum to 1, or of a direction, which sum to 0.
type Barycentric = [f64; 3];

/// A triangular Bézier patch. Corners 0, 1, 2 are at (u, v) = (0, 0), (1, 0), (0, 1).
#[derive(Clone, Debug, PartialEq)]
pub struct DualTriangle {
    degree: usize,
    /// Row by row of the power of v, u fastest.
    controls: Vec<Dual>,
}

impl DualTriangle {
    /// A patch with (n + 1)(n + 2) / 2 control points: for j in 0..=n those of v^j u^i (1 − u − v)^(n − i − j), i in 0..=n − j. None if
    /// their number is another or the degree zero.
    pub fn new(degree: usize, controls: Vec<Dual>) -> Option<Self> {
        let fits = degree > 0 && controls.len() == (degree + 1) * (degree + 2) / 2;
        fits.then_some(Self { degree, controls })
    }

    /// Value and derivatives at (u, v).
    pub fn jet(&self, [u, v]: [f64; 2]) -> DualJet {
        let at = [1.0 - u - v, u, v];
        let (along_u, along_v) = ([-1.0, 1.0, 0.0], [-1.0, 0.0, 1.0]);
        let degree = self.degree as f64;
        let mut net = self.clone();
        let mut jet = DualJet::default();
        while net.degree > 0 {
            let scale = degree * (degree - 1.0);
            match net.degree {
                2 => {
                    let [du, dv] = [along_u, along_v].map(|h| net.step(h));
                    jet.terms[3] = du.step(along_u).controls[0] * scale;
                    jet.terms[4] = du.step(along_v).controls[0] * scale;
                    jet.terms[5] = dv.step(along_v).controls[0] * scale;
                }
                1 => {
                    jet.terms[1] = net.step(along_u).controls[0] * degree;
                    jet.terms[2] = net.step(along_v).controls[0] * degree;
                }
                _ => {}
            }
            net = net.step(at);
        }
        jet.terms[0] = net.controls[0];
        jet
    }

    fn index(degree: usize, i: usize, j: usize) -> usize {
        // Rows 0..j have degree + 1, degree, … control points.
        j * (2 * degree + 3 - j) / 2 + i
    }

    /// One step of de Casteljau's algorithm: the polar form with one argument set.
    fn step(&self, at: Barycentric) -> Self {
        let n = self.degree;
        let point = |i: usize, j: usize| self.controls[Self::index(n, i, j)];
        let places = (0..n).flat_map(|j| (0..n - j).map(move |i| (i, j)));
        let blend = |(i, j)| point(i, j) * at[0] + point(i + 1, j) * at[1] + point(i, j + 1) * at[2];
        Self {
            degree: n - 1,
            controls: places.map(blend).collect(),
        }
    }

    /// Over the triangle with these corners: the control points are the polar form at them.
    fn part(&self, corners: [Barycentric; 3]) -> Self {
        let n = self.degree;
        let mut controls = vec![Dual::default(); self.controls.len()];
        let mut by_last = self.clone();
        for j in 0..=n {
            let mut by_second = by_last.clone();
            for i in 0..=n - j {
                let rest = (0..n - i - j).fold(by_second.clone(), |net, _| net.step(corners[0]));
                controls[Self::index(n, i, j)] = rest.controls[0];
                if i < n - j {
                    by_second = by_second.step(corners[1]);
                }
            }
            if j < n {
                by_last = by_last.step(corners[2]);
            }
        }
        Self { degree: n, controls }
    }
}

impl DualNet for DualTriangle {
    type Direction = Barycentric;

    fn controls(&self) -> &[Dual] {
        &self.controls
    }

    fn map(&self, f: impl Fn(&Dual) -> Dual) -> Self {
        Self {
            degree: self.degree,
            controls: self.controls.iter().map(f).collect(),
        }
    }

    fn derivative(&self, along: Barycentric) -> Self {
        match self.degree {
            0 => self.map(|_| Dual::default()),
            degree => self.step(along).map(|control| *control * degree as f64),
        }
    }

    fn middle(&self) -> Dual {
        let n = self.degree;
        let places = (0..=n).flat_map(|j| (0..=n - j).map(move |i| (i, j)));
        let weight = |(i, j): (usize, usize)| binomial(n, j) * binomial(n - j, i) / 3f64.powi(n as i32);
        let terms = self.controls.iter().zip(places);
        terms.fold(Dual::default(), |sum, (control, place)| sum + *control * weight(place))
    }

    fn quarters(&self) -> [Self; 4] {
        let corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let middles = [[0.5, 0.5, 0.0], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5]];
        [
            self.part([corners[0], middles[0], middles[2]]),
            self.part([middles[0], corners[1], middles[1]]),
            self.part([middles[2], middles[1], corners[2]]),
            self.part([middles[1], middles[2], middles[0]]),
        ]
    }
}

/// A net in the coordinates of another frame.
pub fn in_frame<N: DualNet>(net: &N, frame: &DualFrame) -> N {
    net.map(|control| control.in_frame(frame))
}
