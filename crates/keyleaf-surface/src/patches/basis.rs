//! B-spline basis functions over a span, and the Bézier form of a span.
//!
//! With `L[j] = f + left[j]` and `R[j] = g + right[j]` all methods compute the same functions. A basis function is a sum over lattice
//! paths (Concheiro 6.13); the p of them that the stair strategy keeps are all there are up to degree 3, and above it all are summed.

use super::span::{Fraction, MAX_ORDER, Span};
use std::ops::{Add, Mul};

/// How patches are evaluated: by which basis functions, or without. All give the same surface; they differ in speed and rounding.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BasisMethod {
    /// The triangular table (Piegl & Tiller A2.2), its loops written out where no degree is above 3.
    #[default]
    Triangular,
    /// The triangular table by loops, which degrees above 3 take anyway.
    Loops,
    /// Sums of products along staircases (Concheiro 6.13 to 6.16, repaired).
    Stair,
    /// The recursion of Cox and de Boor.
    DeBoor,
    /// Bernstein polynomials times a matrix a span (Bézier extraction).
    Extraction,
    /// No basis functions: coefficients of powers, made once a KSQuad (Concheiro 2.2), about its middle. Cheap for samples, but at a
    /// collapsed edge derivatives are zero only up to rounding, and where weights of a KSQuad differ by decades digits are lost.
    Power,
}

/// The values of the p + 1 functions over a span, the first first; of the span's degree or a lower one.
pub fn values(method: BasisMethod, degree: usize, span: &Span, at: Fraction) -> [f64; MAX_ORDER] {
    let each = |function: &dyn Fn(usize, usize) -> f64| {
        std::array::from_fn(|r| if r <= degree { function(r, degree - r) } else { 0.0 })
    };
    match method {
        BasisMethod::Triangular | BasisMethod::Loops | BasisMethod::Power => triangular(degree, span, at),
        BasisMethod::Stair if degree <= 3 => each(&|m, k| staircases(m, k, span, at)),
        BasisMethod::Stair => each(&|m, k| all_paths(Path::START, [m, k], span, at)),
        BasisMethod::DeBoor => each(&|_, k| de_boor(k, degree, span, at)),
        BasisMethod::Extraction => extraction(degree, span, at),
    }
}

/// Piegl & Tiller A2.2.
fn triangular(degree: usize, span: &Span, at: Fraction) -> [f64; MAX_ORDER] {
    let mut n = [0.0; MAX_ORDER];
    n[0] = 1.0;
    for j in 1..=degree {
        let mut saved = 0.0;
        for (r, value) in n.iter_mut().enumerate().take(j) {
            let share = *value / span.width(r + 1, j - r);
            *value = saved + (at.g + span.right[r + 1]) * share;
            saved = (at.f + span.left[j - r]) * share;
        }
        n[j] = saved;
    }
    n
}

/// A lattice path through the triangular table: its steps so far, and the product of their weights.
#[derive(Clone, Copy)]
struct Path {
    lefts: usize,
    rights: usize,
    weight: f64,
}

impl Path {
    const START: Self = Self {
        lefts: 0,
        rights: 0,
        weight: 1.0,
    };

    fn left(mut self, span: &Span, at: Fraction) -> Self {
        let (a, b) = (self.lefts + 1, self.rights + 1);
        self.weight *= (at.f + span.left[b]) / span.width(a, b);
        self.lefts = a;
        self
    }

    fn right(mut self, span: &Span, at: Fraction) -> Self {
        let (a, b) = (self.lefts + 1, self.rights + 1);
        self.weight *= (at.g + span.right[a]) / span.width(a, b);
        self.rights = b;
        self
    }
}

/// The weights of the paths R^d L^m R^(k−d), d in 1..=k, and L^c R^k L^(m−c), c in 1..=m.
fn staircases(m: usize, k: usize, span: &Span, at: Fraction) -> f64 {
    let lefts = |path: Path, count: usize| (0..count).fold(path, |path, _| path.left(span, at));
    let rights = |path: Path, count: usize| (0..count).fold(path, |path, _| path.right(span, at));
    if m == 0 || k == 0 {
        return rights(lefts(Path::START, m), k).weight;
    }
    let diagonals = (1..=k).map(|d| rights(lefts(rights(Path::START, d), m), k - d));
    let columns = (1..=m).map(|c| lefts(rights(lefts(Path::START, c), k), m - c));
    diagonals.chain(columns).map(|path| path.weight).sum()
}

/// The weights of all paths that continue with this many steps to the left and to the right.
fn all_paths(path: Path, [lefts, rights]: [usize; 2], span: &Span, at: Fraction) -> f64 {
    let by_left = (lefts > 0).then(|| all_paths(path.left(span, at), [lefts.saturating_sub(1), rights], span, at));
    let by_right = (rights > 0).then(|| all_paths(path.right(span, at), [lefts, rights.saturating_sub(1)], span, at));
    match (by_left, by_right) {
        (None, None) => path.weight,
        (left, right) => left.unwrap_or(0.0) + right.unwrap_or(0.0),
    }
}

/// `N[i − k]` of a degree. Over a span that is not empty the functions that are not zero never meet 0/0.
fn de_boor(k: usize, degree: usize, span: &Span, at: Fraction) -> f64 {
    if degree == 0 {
        return 1.0;
    }
    let mut sum = 0.0;
    if k < degree {
        sum += (at.f + span.left[k + 1]) / span.width(degree - k, k + 1) * de_boor(k, degree - 1, span, at);
    }
    if k > 0 {
        let a = degree - k + 1;
        sum += (at.g + span.right[a]) / span.width(a, k) * de_boor(k - 1, degree - 1, span, at);
    }
    sum
}

fn extraction(degree: usize, span: &Span, at: Fraction) -> [f64; MAX_ORDER] {
    let mut bernstein = [0.0; MAX_ORDER];
    bernstein[0] = 1.0;
    for j in 1..=degree {
        for r in (1..=j).rev() {
            bernstein[r] = at.g * bernstein[r] + at.f * bernstein[r - 1];
        }
        bernstein[0] *= at.g;
    }
    let row = |row: [f64; MAX_ORDER]| row.iter().zip(bernstein).map(|(m, b)| m * b).sum();
    extraction_matrix(degree, span).map(row)
}

/// The matrix M with N = M B: a row a function, a column a Bernstein polynomial.
pub fn extraction_matrix(degree: usize, span: &Span) -> [[f64; MAX_ORDER]; MAX_ORDER] {
    std::array::from_fn(|r| {
        let unit = std::array::from_fn(|i| if i == r && r <= degree { 1.0 } else { 0.0 });
        bezier_form(degree, span, unit)
    })
}

/// The Bézier control points of a span from its control points: the polar form at p − k times the start and k times the end.
pub fn bezier_form<T>(degree: usize, span: &Span, controls: [T; MAX_ORDER]) -> [T; MAX_ORDER]
where
    T: Copy + Add<Output = T> + Mul<f64, Output = T>,
{
    let mut bezier = controls;
    for (k, point) in bezier.iter_mut().enumerate().take(degree + 1) {
        let mut d = controls;
        for j in 1..=degree {
            let at = if j <= degree - k {
                Fraction::START
            } else {
                Fraction::END
            };
            for r in (j..=degree).rev() {
                let (a, b) = (1 + r - j, degree + 1 - r);
                let width = span.width(a, b);
                d[r] = d[r - 1] * ((at.g + span.right[a]) / width) + d[r] * ((at.f + span.left[b]) / width);
            }
        }
        *point = d[degree];
    }
    bezier
}

#[cfg(test)]
#[path = "basis_tests.rs"]
mod tests;
