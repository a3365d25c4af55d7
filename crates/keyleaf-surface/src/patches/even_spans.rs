//! Knot spans cut into equal parts, so that KSQuads become as even as powers of two allow.
//!
//! # Theory
//!
//! Leaves are right isosceles triangles of the unit square of a KSQuad. With second derivatives uu and vv over that square, leaves with
//! hypotenuses h are about (uu + vv) h² from the surface: for an error of 1 there are proportional to uu + vv of them. Cut in v into k
//! parts, a KSQuad has uu k + vv / k, which is least, 2 √(uu vv), where k is the *ratio* r = √(vv / uu); as it is it has (r + 1/r) / 2
//! times as many. The mixed derivative has the same part in all.
//!
//! So the ratio is that of second derivatives, which are what deviation goes by, averaged over the KSQuads of a surface. A surface that
//! is flat in a direction would have KSQuads as long there as can be; it goes by lengths, for which the number of leaves with short
//! edges has the same formula, with the squares of first derivatives. Where it is curved in the other direction, only that one is cut.
//!
//! # Practice
//!
//! All spans of a direction of a surface are cut alike, into 2^n parts: KSQuads have no T-junctions. Directions that run along a joined
//! boundary, of either surface, are one *class* with one n: the least Σ area · (r + 1/r) / 2 of its surfaces. The class that saves most
//! comes first; the other directions of its surfaces then stay whole, since to cut both makes nothing more even.

use super::classes::Classes;
use super::evaluation::KsQuad;
use super::nurbs_surface::NurbsSurface;
use super::span::{Fraction, Span};
use super::{BasisMethod, layout::Layout};
use glam::DVec3;
use std::collections::BTreeMap;

/// Spans are cut into at most 2^this parts.
const MOST_HALVINGS: u32 = 3;

/// A class is left whole if it would save less than this part of its triangles.
const LEAST_GAIN: f64 = 0.01;

/// A direction is flat if its second derivatives are less than this part of its first, over a span.
const FLAT: f64 = 1e-3;

/// Derivatives are averaged over so many points squared of a KSQuad.
const SAMPLES: usize = 3;

/// A span is cut if it has more than so many units of the last place of its knots: parts are then still of one length.
const LEAST_UNITS: f64 = 65_536.0;

/// A surface by its number, and a direction of it: 0 for u, 1 for v.
pub type Direction = (usize, usize);

/// How often the knot spans of every surface are halved, in u and in v, if these directions run along the same curve.
pub fn halvings(surfaces: &[NurbsSurface], same: impl IntoIterator<Item = [Direction; 2]>) -> Vec<[u32; 2]> {
    let mut classes = Classes::new(2 * surfaces.len());
    let number = |(surface, axis): Direction| 2 * surface + axis;
    for [a, b] in same {
        classes.unite(number(a), number(b));
    }
    let shapes: Vec<Shape> = surfaces.iter().map(Shape::of).collect();
    let mut members: BTreeMap<usize, Vec<Direction>> = BTreeMap::new();
    for surface in 0..surfaces.len() {
        for axis in 0..2 {
            let class = classes.first(number((surface, axis)));
            members.entry(class).or_default().push((surface, axis));
        }
    }
    let mut wishes: Vec<(f64, u32, Vec<Direction>)> = members
        .into_values()
        .filter_map(|class| best(&shapes, &class).map(|(gain, n)| (gain, n, class)))
        .collect();
    // Those that save the same come in the order of the surfaces.
    wishes.sort_by(|(a, ..), (b, ..)| b.total_cmp(a));
    let mut halvings = vec![[0; 2]; surfaces.len()];
    for (_, n, class) in wishes {
        if class.iter().all(|&(surface, axis)| halvings[surface][1 - axis] == 0) {
            class.iter().for_each(|&(surface, axis)| halvings[surface][axis] = n);
        }
    }
    halvings
}

/// What the best number of halvings of a class saves, and that number; none where nothing is saved.
fn best(shapes: &[Shape], class: &[Direction]) -> Option<(f64, u32)> {
    // Both directions of a surface, which follow each other, would be cut.
    let has_both = class.windows(2).any(|pair| pair[0].0 == pair[1].0);
    if has_both || !class.iter().all(|&(surface, axis)| shapes[surface].can_cut[axis]) {
        return None;
    }
    let cost = |n: u32| -> f64 {
        let of_member = |&(surface, axis): &Direction| {
            let Shape { area, log_ratio, .. } = shapes[surface];
            let wish = if axis == 1 { log_ratio } else { -log_ratio };
            area * ((f64::from(n) - wish) * std::f64::consts::LN_2).cosh()
        };
        class.iter().map(of_member).sum()
    };
    let n = (1..=MOST_HALVINGS).min_by(|&a, &b| cost(a).total_cmp(&cost(b)))?;
    let gain = cost(0) - cost(n);
    (gain > LEAST_GAIN * cost(0)).then_some((gain, n))
}

/// What is asked about a surface.
struct Shape {
    /// log2 of the ratio: above 0, KSQuads are long in v.
    log_ratio: f64,
    /// About that of the surface; 0 where the ratio is not known.
    area: f64,
    /// Whether the spans of u and v are long enough to be cut.
    can_cut: [bool; 2],
}

impl Shape {
    fn of(surface: &NurbsSurface) -> Self {
        let layout = Layout::new(surface, 0);
        let [us, vs] = &layout.spans;
        let (mut first, mut second, mut squares, mut area) = ([0.0; 2], [0.0; 2], [0.0; 2], 0.0);
        for spans in vs.iter().flat_map(|v| us.iter().map(move |u| [u, v])) {
            for [du, dv, duu, dvv] in derivatives(surface, spans) {
                for (axis, [one, two]) in [[du, duu], [dv, dvv]].into_iter().enumerate() {
                    first[axis] += one.length();
                    second[axis] += two.length();
                    squares[axis] += one.length_squared();
                }
                area += du.length() * dv.length();
            }
        }
        let log2 = |[u, v]: [f64; 2]| 0.5 * (v / u).log2();
        let log_ratio = match [0, 1].map(|axis| second[axis] <= FLAT * first[axis]) {
            [false, false] => log2(second),
            [true, true] => log2(squares),
            // Only the curved direction is cut.
            [true, false] => log2(squares).max(0.0),
            [false, true] => log2(squares).min(0.0),
        };
        let is_known = log_ratio.is_finite() && f64::is_finite(area);
        Self {
            log_ratio: if is_known { log_ratio } else { 0.0 },
            area: if is_known { area } else { 0.0 },
            can_cut: [us, vs].map(|spans| spans.iter().all(can_cut)),
        }
    }
}

/// First and second derivatives all over a KSQuad: in u, v, uu and vv.
fn derivatives(surface: &NurbsSurface, spans: [&Span; 2]) -> [[DVec3; 4]; SAMPLES * SAMPLES] {
    let quad = KsQuad {
        surface,
        spans,
        method: BasisMethod::Triangular,
    };
    let fraction = |k: usize| Fraction::new((k as f64 + 0.5) / SAMPLES as f64);
    std::array::from_fn(|k| {
        let jet = quad.jet([fraction(k % SAMPLES), fraction(k / SAMPLES)]);
        [jet.du, jet.dv, jet.duu, jet.dvv]
    })
}

fn can_cut(span: &Span) -> bool {
    span.length() > LEAST_UNITS * f64::EPSILON * span.start.abs().max(span.end.abs())
}

/// The surface with all knot spans of its domain halved so often, in u and in v.
pub fn cut(surface: &NurbsSurface, [u, v]: [u32; 2]) -> NurbsSurface {
    let mut cut = surface.clone();
    if u > 0 {
        cut = cut.with_knots_u(&new_knots(&cut.spans()[0], u));
    }
    if v > 0 {
        let turned = cut.transposed();
        cut = turned.with_knots_u(&new_knots(&turned.spans()[0], v)).transposed();
    }
    cut
}

/// The knots between 2^`halvings` parts of each span. Midpoints are the same whichever end a curve is run through from.
fn new_knots(spans: &[Span], halvings: u32) -> Vec<f64> {
    let mut knots = Vec::new();
    for span in spans {
        let mut ends = vec![span.start, span.end];
        for _ in 0..halvings {
            let halves = ends.windows(2).flat_map(|pair| [pair[0], 0.5 * (pair[0] + pair[1])]);
            ends = halves.chain([span.end]).collect();
        }
        knots.extend(&ends[1..ends.len() - 1]);
    }
    knots
}
