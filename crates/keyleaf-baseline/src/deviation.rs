//! How far a tessellation is from its surfaces.

use crate::cells::position;
use crate::check::domain;
use crate::geometry::{distance_to_triangle, height_over_triangle};
use crate::{BaselineError, Sampler, Tessellation, View};
use glam::{DVec2, DVec3};
use std::cell::OnceCell;
use std::collections::HashMap;

/// Least number of intervals that the edges of a triangle are sampled in.
const LEAST_INTERVALS: u32 = 4;
/// Intervals a knot span, so that what is small inside a large triangle is not missed.
const INTERVALS_PER_SPAN: f64 = 32.0;
/// Greatest number of intervals.
const MOST_INTERVALS: u32 = 64;

/// Distances between a tessellation and its surfaces.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// The greatest, in object units.
    pub max: f64,
    /// The mean over the area of the triangles, in object units.
    pub mean: f64,
    /// The greatest, in pixels as seen side-on.
    pub max_pixels: f64,
    /// The mean over the area of the triangles, in pixels.
    pub mean_pixels: f64,
}

/// Measures samples of the surface above every triangle: the distance of each to that triangle, or, beside it, to the
/// nearest of it and its neighbours.
///
/// This bounds the distance of the sample to the whole tessellation. Sliding along the surface, where parameters run at
/// uneven speed, does not count unless it leaves the neighbours too. Triangles are sampled at least 32 times a knot
/// span, and where they are smaller at 12 points besides their corners. Samples above slivers are measured to the
/// nearest triangle at the edge that the sliver shrinks to; they count for the greatest distances, not for the means,
/// since slivers have no area.
///
/// # Errors
/// [`BaselineError`] if the view is at fault, a sample is not finite, or a triangle names a vertex or surface that is
/// not there.
pub fn deviation(sampler: &dyn Sampler, view: &View, tessellation: &Tessellation) -> Result<Deviation, BaselineError> {
    view.check()?;
    let mut measure = Measure {
        sampler,
        view,
        spans: mean_spans(sampler),
        result: Deviation::default(),
    };
    let neighbours = triangles_by_edge(tessellation);
    let mut area = 0.0;
    let mut means = [0.0; 2];
    for (&triangle, &(surface, at)) in tessellation.triangles.iter().zip(&tessellation.domains) {
        let own @ [a, b, c] = corners(tessellation, triangle)?;
        // Few triangles have samples beside them.
        let around = OnceCell::new();
        let beside = |point| nearest(point, around.get_or_init(|| near(tessellation, &neighbours, triangle)));
        let distance = |point| height_over_triangle(point, own).unwrap_or_else(|| beside(point));
        let sums = measure.samples(surface, at, distance)?;
        let weight = (b - a).cross(c - a).length();
        area += weight;
        means = [means[0] + weight * sums[0], means[1] + weight * sums[1]];
    }
    for sliver in &tessellation.slivers {
        corners(tessellation, sliver.vertices)?;
        let near = near(tessellation, &neighbours, sliver.vertices);
        measure.samples(sliver.surface, sliver.at, |point| nearest(point, &near))?;
    }
    let mut result = measure.result;
    if area > 0.0 {
        [result.mean, result.mean_pixels] = means.map(|sum| sum / area);
    }
    Ok(result)
}

struct Measure<'a> {
    sampler: &'a dyn Sampler,
    view: &'a View,
    /// Mean size of the knot spans of each surface.
    spans: Vec<DVec2>,
    result: Deviation,
}

impl Measure<'_> {
    /// Means over the samples of a triangle of a domain, in units and in pixels.
    fn samples(
        &mut self,
        surface: u32,
        at: [DVec2; 3],
        distance: impl Fn(DVec3) -> f64,
    ) -> Result<[f64; 2], BaselineError> {
        let Some(&span) = self.spans.get(surface as usize) else {
            return Err(missing("surface of a triangle", surface));
        };
        let sides = [at[1] - at[0], at[2] - at[1], at[0] - at[2]];
        let longest = sides
            .map(|side| (side.abs() / span).max_element())
            .into_iter()
            .fold(0.0, f64::max);
        let intervals = ((longest * INTERVALS_PER_SPAN).ceil() as u32).clamp(LEAST_INTERVALS, MOST_INTERVALS);
        let mut sums = [0.0; 2];
        let mut samples = 0.0;
        for i in 0..=intervals {
            for j in 0..=intervals - i {
                let w = [i, j, intervals - i - j].map(|w| f64::from(w) / f64::from(intervals));
                let at = at[0] * w[0] + at[1] * w[1] + at[2] * w[2];
                let point = position(self.sampler, surface as usize, at)?;
                let distance = distance(point);
                let pixels = self.view.pixels(distance, point);
                self.result.max = self.result.max.max(distance);
                self.result.max_pixels = self.result.max_pixels.max(pixels);
                sums = [sums[0] + distance, sums[1] + pixels];
                samples += 1.0;
            }
        }
        Ok(sums.map(|sum| sum / samples))
    }
}

fn mean_spans(sampler: &dyn Sampler) -> Vec<DVec2> {
    let mean = |surface| {
        let [first, last] = domain(sampler, surface);
        let spans = sampler.spans(surface).map(|knots| knots.len().max(2) as f64 - 1.0);
        (last - first) / DVec2::from_array(spans)
    };
    (0..sampler.surfaces()).map(mean).collect()
}

fn corners(tessellation: &Tessellation, triangle: [u32; 3]) -> Result<[DVec3; 3], BaselineError> {
    let mut corners = [DVec3::ZERO; 3];
    for (corner, vertex) in corners.iter_mut().zip(triangle) {
        let position = tessellation.positions.get(vertex as usize);
        *corner = *position.ok_or_else(|| missing("vertex of a triangle", vertex))?;
    }
    Ok(corners)
}

fn missing(name: &'static str, value: u32) -> BaselineError {
    BaselineError::Setting {
        name,
        value: f64::from(value),
        expected: "one of the model",
    }
}

type Neighbours = HashMap<[u32; 2], Vec<[u32; 3]>>;

fn triangles_by_edge(tessellation: &Tessellation) -> Neighbours {
    let mut neighbours = Neighbours::new();
    for &triangle in &tessellation.triangles {
        for edge in edges(triangle) {
            neighbours.entry(edge).or_default().push(triangle);
        }
    }
    neighbours
}

fn edges([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]].map(|[a, b]| [a.min(b), a.max(b)])
}

/// A triangle, and those that share an edge with it.
fn near(tessellation: &Tessellation, neighbours: &Neighbours, triangle: [u32; 3]) -> Vec<[DVec3; 3]> {
    let sides = edges(triangle);
    let others = sides.iter().filter_map(|edge| neighbours.get(edge)).flatten();
    others
        .chain([&triangle])
        .filter_map(|&triangle| corners(tessellation, triangle).ok())
        .collect()
}

fn nearest(point: DVec3, triangles: &[[DVec3; 3]]) -> f64 {
    triangles
        .iter()
        .map(|&corners| distance_to_triangle(point, corners))
        .fold(f64::MAX, f64::min)
}
