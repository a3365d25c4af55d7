//! Knot vectors cut into spans, each normalised to its own length.

use std::ops::Range;

/// The highest degree.
pub const MAX_DEGREE: usize = 7;
/// Functions of the highest degree over a span.
pub const MAX_ORDER: usize = MAX_DEGREE + 1;

/// A parameter of a span and its complement: f in 0..=1 from the start, g = 1 − f.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fraction {
    pub f: f64,
    pub g: f64,
}

impl Fraction {
    pub const START: Self = Self { f: 0.0, g: 1.0 };
    pub const END: Self = Self { f: 1.0, g: 0.0 };

    pub fn new(f: f64) -> Self {
        Self { f, g: 1.0 - f }
    }
}

/// A span `x[i]..x[i + 1]` that is not empty, with the knots beside it in units of its length D, from its ends:
/// `left[j] = (x[i] − x[i + 1 − j]) / D` and `right[j] = (x[i + j] − x[i + 1]) / D` for j in 1..=p, so that `left[1] = right[1] = 0`.
///
/// Differences of knots come first, so that nothing is lost where knots are close together or far from zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Span {
    /// p.
    pub degree: usize,
    /// i.
    pub index: usize,
    /// `x[i]`.
    pub start: f64,
    /// `x[i + 1]`.
    pub end: f64,
    pub left: [f64; MAX_ORDER],
    pub right: [f64; MAX_ORDER],
}

impl Span {
    fn new(degree: usize, knots: &[f64], index: usize) -> Self {
        let (start, end) = (knots[index], knots[index + 1]);
        let (mut left, mut right) = ([0.0; MAX_ORDER], [0.0; MAX_ORDER]);
        for j in 1..=degree {
            left[j] = (start - knots[index + 1 - j]) / (end - start);
            right[j] = (knots[index + j] - end) / (end - start);
        }
        Self {
            degree,
            index,
            start,
            end,
            left,
            right,
        }
    }

    /// D.
    pub fn length(&self) -> f64 {
        self.end - self.start
    }

    /// The control points of the span.
    pub fn controls(&self) -> Range<usize> {
        self.index - self.degree..self.index + 1
    }

    /// `(x[i + a] − x[i + 1 − b]) / D`, at least 1, for a and b in 1..=p.
    pub fn width(&self, a: usize, b: usize) -> f64 {
        1.0 + (self.left[b] + self.right[a])
    }

    /// Whether the boundary at the start is that of the first control point.
    pub fn is_clamped_at_start(&self) -> bool {
        self.left == [0.0; MAX_ORDER]
    }

    /// Whether the boundary at the end is that of the last control point.
    pub fn is_clamped_at_end(&self) -> bool {
        self.right == [0.0; MAX_ORDER]
    }

    /// Where a knot parameter within the span lies.
    pub fn fraction(&self, u: f64) -> Fraction {
        Fraction {
            f: (u - self.start) / self.length(),
            g: (self.end - u) / self.length(),
        }
    }
}

/// The spans of the domain that are not empty. The knot vector is one of [`NurbsSurface`](super::NurbsSurface).
pub fn spans(degree: usize, knots: &[f64]) -> Vec<Span> {
    (degree..knots.len() - degree - 1)
        .filter(|&i| knots[i] < knots[i + 1])
        .map(|i| Span::new(degree, knots, i))
        .collect()
}

/// The span that holds a parameter: at a knot the right-hand one, at the end of the domain the last.
pub fn find(spans: &[Span], u: f64) -> Option<usize> {
    let (first, last) = (spans.first()?, spans.last()?);
    let holds = u >= first.start && u <= last.end;
    holds.then(|| spans.partition_point(|span| span.start <= u).clamp(1, spans.len()) - 1)
}

/// Runs of spans between tears: knots of multiplicity p + 1, over which the control points have nothing in common.
pub fn runs(spans: &[Span]) -> Vec<Range<usize>> {
    let is_tear = |&s: &usize| spans[s].index - spans[s - 1].index > spans[s].degree;
    let tears: Vec<usize> = (1..spans.len()).filter(is_tear).collect();
    let starts = std::iter::once(0).chain(tears.iter().copied());
    let ends = tears.iter().copied().chain([spans.len()]);
    starts.zip(ends).map(|(start, end)| start..end).collect()
}
