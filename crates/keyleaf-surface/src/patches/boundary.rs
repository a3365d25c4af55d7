//! The boundary curves of surfaces and of the pieces into which tears cut them.
//!
//! A boundary is compared in its Bézier form, which clamped and unclamped knots, and knots of any multiplicity, have in common.

use super::basis::{BasisMethod, bezier_form, values};
use super::layout::{Layout, Side};
use super::nurbs_surface::NurbsSurface;
use super::span::{Fraction, MAX_ORDER, Span};
use glam::{DVec3, DVec4};

/// Numbers this close, relative to the largest of their kind, differ by rounding only.
const ROUNDING: f64 = 1e-12;

/// Where a boundary is: a side of a piece of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BoundaryPlace {
    pub surface: usize,
    /// The piece, counted between tears in u and in v.
    pub piece: [usize; 2],
    pub side: Side,
}

/// A boundary curve, counter-clockwise about its piece.
#[derive(Clone, Debug)]
pub struct BoundaryCurve {
    pub place: BoundaryPlace,
    degree: usize,
    /// The ends of the spans, from 0 to 1.
    breaks: Vec<f64>,
    /// Bézier control points with their weights, of the largest 1, a span after the other.
    controls: Vec<(DVec3, f64)>,
    /// The largest weight before that.
    pub largest_weight: f64,
    /// The multiplicities of the knots between its spans.
    multiplicities: Vec<usize>,
    /// The control points of the surface that make up the boundary, if it is clamped, by their indices.
    own_points: Option<Vec<usize>>,
}

/// How far two boundary curves are apart.
#[derive(Clone, Copy, Debug)]
pub struct Difference {
    /// Between control points.
    pub distance: f64,
    /// Between parameters and weights, of which the largest are 1.
    pub relative: f64,
}

impl Difference {
    /// Whether it is no more than rounding, for curves with coordinates up to `largest`.
    pub fn is_rounding(&self, largest: f64) -> bool {
        self.distance <= ROUNDING * largest && self.relative <= ROUNDING
    }
}

impl BoundaryCurve {
    pub fn new(surface: &NurbsSurface, layout: &Layout, place: BoundaryPlace) -> Self {
        let (along, across) = (place.side.along(), 1 - place.side.along());
        let run = |axis: usize| &layout.spans[axis][layout.runs[axis][place.piece[axis]].clone()];
        let spans = run(along);
        let (line, at) = match run(across) {
            [.., last] if place.side.is_at_end() => (last, Fraction::END),
            line => (&line[0], Fraction::START),
        };
        let strides = [1, surface.point_counts()[0]];
        let weights = values(BasisMethod::Triangular, line.degree, line, at);
        let control = |place: usize| -> DVec4 {
            let across_controls = line.controls().zip(weights);
            across_controls
                .map(|(across_place, n)| {
                    let (point, w) = surface.control(place * strides[along] + across_place * strides[across]);
                    (point * w).extend(w) * n
                })
                .sum()
        };
        let mut curve = Self {
            place,
            degree: spans[0].degree,
            breaks: breaks(spans),
            controls: spans.iter().flat_map(|span| bezier_controls(span, control)).collect(),
            largest_weight: 1.0,
            multiplicities: spans.windows(2).map(|pair| pair[1].index - pair[0].index).collect(),
            own_points: None,
        };
        let is_clamped = spans[0].is_clamped_at_start() && spans[spans.len() - 1].is_clamped_at_end();
        let row = match place.side.is_at_end() {
            true => line.is_clamped_at_end().then(|| line.controls().end - 1),
            false => line.is_clamped_at_start().then(|| line.controls().start),
        };
        if let (true, Some(row)) = (is_clamped, row) {
            let places = spans[0].controls().start..spans[spans.len() - 1].controls().end;
            curve.own_points = Some(
                places
                    .map(|place| place * strides[along] + row * strides[across])
                    .collect(),
            );
        }
        curve.normalise_weights();
        if place.side.is_backward() {
            curve.reverse();
        }
        curve
    }

    fn normalise_weights(&mut self) {
        let largest = self.controls.iter().map(|&(_, w)| w).fold(0.0, f64::max);
        if largest > 0.0 {
            self.largest_weight = largest;
            self.controls.iter_mut().for_each(|(_, w)| *w /= largest);
        }
    }

    fn reverse(&mut self) {
        self.controls.reverse();
        self.breaks.reverse();
        self.multiplicities.reverse();
        self.breaks.iter_mut().for_each(|x| *x = 1.0 - *x);
        if let Some(points) = &mut self.own_points {
            points.reverse();
        }
    }

    /// The indices of the control points of the surface that make up the boundary; none where it is not clamped.
    pub fn own_points(&self) -> &[usize] {
        self.own_points.as_deref().unwrap_or_default()
    }

    /// Pairs of own control points that have the same part in both curves; none where knots differ in kind.
    pub fn corresponding_points<'a>(&'a self, other: &'a Self) -> impl Iterator<Item = (usize, usize)> + 'a {
        let same = self.degree == other.degree && self.multiplicities == other.multiplicities;
        let count = if same { usize::MAX } else { 0 };
        let pairs = self.own_points().iter().zip(other.own_points());
        pairs.map(|(&own, &other)| (own, other)).take(count)
    }

    /// The same curve, run through from its end.
    pub fn reversed(&self) -> Self {
        let mut curve = self.clone();
        curve.reverse();
        curve
    }

    /// The knot at which it lies.
    pub fn knot(&self, layout: &Layout) -> f64 {
        let across = 1 - self.place.side.along();
        let run = layout.runs[across][self.place.piece[across]].clone();
        let spans = &layout.spans[across];
        if self.place.side.is_at_end() {
            spans[run.end - 1].end
        } else {
            spans[run.start].start
        }
    }

    /// The middle between its ends.
    pub fn key(&self) -> DVec3 {
        (self.controls[0].0 + self.controls[self.controls.len() - 1].0) / 2.0
    }

    /// The largest coordinate.
    pub fn largest(&self) -> f64 {
        self.controls
            .iter()
            .map(|(p, _)| p.abs().max_element())
            .fold(0.0, f64::max)
    }

    /// Points of it at `count` equal steps of its parameter, the ends among them.
    pub fn samples(&self, count: usize) -> Vec<DVec3> {
        let at = |i: usize| self.point(i as f64 / (count - 1) as f64);
        (0..count).map(at).collect()
    }

    /// Points that chords between them follow the curve: so many a span.
    pub fn chain(&self, a_span: usize) -> Vec<DVec3> {
        let spans = self.breaks.windows(2);
        let inner =
            spans.flat_map(|ends| (0..a_span).map(move |i| ends[0] + (ends[1] - ends[0]) * (i as f64 / a_span as f64)));
        inner.chain([1.0]).map(|t| self.point(t)).collect()
    }

    /// The point at a parameter from 0 to 1, by de Casteljau.
    fn point(&self, t: f64) -> DVec3 {
        let last = self.breaks.len() - 2;
        let span = self.breaks.partition_point(|&b| b <= t).saturating_sub(1).min(last);
        let (start, end) = (self.breaks[span], self.breaks[span + 1]);
        let f = ((t - start) / (end - start)).clamp(0.0, 1.0);
        let controls = &self.controls[span * (self.degree + 1)..][..=self.degree];
        let mut points: Vec<DVec4> = controls.iter().map(|&(p, w)| (p * w).extend(w)).collect();
        for length in (1..points.len()).rev() {
            for i in 0..length {
                points[i] = points[i].lerp(points[i + 1], f);
            }
        }
        points[0].truncate() / points[0].w.max(f64::MIN_POSITIVE)
    }

    /// Whether all of it lies within a distance of its start.
    pub fn is_collapsed(&self, tolerance: f64) -> bool {
        let start = self.controls[0].0;
        self.controls
            .iter()
            .all(|(p, w)| *w <= 0.0 || p.distance(start) <= tolerance)
    }

    /// How far it is from another curve with the same degree and as many spans; none from any other.
    pub fn difference(&self, other: &Self) -> Option<Difference> {
        if self.degree != other.degree || self.breaks.len() != other.breaks.len() {
            return None;
        }
        let mut difference = Difference {
            distance: 0.0,
            relative: 0.0,
        };
        for (a, b) in self.breaks.iter().zip(&other.breaks) {
            difference.relative = difference.relative.max((a - b).abs());
        }
        for ((p, w), (q, z)) in self.controls.iter().zip(&other.controls) {
            difference.relative = difference.relative.max((w - z).abs());
            if *w > 0.0 && *z > 0.0 {
                difference.distance = difference.distance.max(p.distance(*q));
            }
        }
        Some(difference)
    }
}

/// The ends of spans, from 0 to 1.
fn breaks(spans: &[Span]) -> Vec<f64> {
    let (first, last) = (spans[0].start, spans[spans.len() - 1].end);
    let ends = spans.iter().map(|span| span.end);
    std::iter::once(first)
        .chain(ends)
        .map(|x| (x - first) / (last - first))
        .collect()
}

fn bezier_controls(span: &Span, control: impl Fn(usize) -> DVec4) -> Vec<(DVec3, f64)> {
    let first = span.controls().start;
    let controls = std::array::from_fn(|r| {
        if r <= span.degree {
            control(first + r)
        } else {
            DVec4::ZERO
        }
    });
    let bezier: [DVec4; MAX_ORDER] = bezier_form(span.degree, span, controls);
    let position = |c: &DVec4| if c.w > 0.0 { c.truncate() / c.w } else { DVec3::ZERO };
    bezier[..=span.degree].iter().map(|c| (position(c), c.w)).collect()
}
