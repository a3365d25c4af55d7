//! Scatter plots of series, with a front and names.

use super::WIDTH;
use super::element::{Anchor, Elements, width};
use super::label::{Area, Labels};
use super::legend::legend;
use super::scale::{Axis, Scale};

/// A plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// For those who do not see it.
    pub title: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// The series.
    pub series: Vec<PlotSeries>,
    /// Corners of a dashed line, such as the stairs of a front.
    pub line: Vec<[f64; 2]>,
    /// What the dashed line is; its entry in the legend.
    pub line_name: String,
}

/// Points of one colour and shape.
#[derive(Clone, Debug, PartialEq)]
pub struct PlotSeries {
    /// Its entry in the legend.
    pub name: String,
    /// Which colour and shape: alike in all plots of a scene.
    pub style: usize,
    /// Its points, joined in this order.
    pub points: Vec<PlotPoint>,
}

/// A point of a series.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlotPoint {
    /// Its horizontal value.
    pub x: f64,
    /// Its vertical value.
    pub y: f64,
    /// Where x may lie, as a thin line.
    pub spread: Option<[f64; 2]>,
    /// Whether its marker is filled.
    pub filled: bool,
    /// A name that stands beside it, if there is room.
    pub name: Option<String>,
    /// What shows when it is pointed at.
    pub title: String,
}

/// Height of the part that holds the data.
const HEIGHT: f64 = 280.0;
const RIGHT: f64 = WIDTH - 14.0;

/// Draws a plot.
pub fn plot(plot: &Plot) -> String {
    let mut elements = Elements::default();
    let points = || plot.series.iter().flat_map(|series| &series.points);
    let top = key(&mut elements, plot);
    let bottom = top + HEIGHT;
    let y = Scale::new(&plot.y, points().map(|p| p.y), [bottom, top]);
    let y_ticks = y.ticks(7);
    let widest = y_ticks
        .iter()
        .filter_map(|tick| tick.text.as_deref())
        .map(width)
        .fold(0.0, f64::max);
    let left = 30.0 + widest;
    let spreads = points().flat_map(|p| p.spread.into_iter().flatten().chain([p.x]));
    let x = Scale::new(&plot.x, spreads, [left, RIGHT]);

    for tick in &y_ticks {
        let Some(at) = y.place(tick.value) else { continue };
        elements.line(
            if tick.text.is_some() { "grid" } else { "minor" },
            [left, at],
            [RIGHT, at],
        );
        if let Some(text) = &tick.text {
            elements.text("quiet", [left - 6.0, at + 4.5], Anchor::End, text);
        }
    }
    let mut free_from = f64::NEG_INFINITY;
    for tick in x.ticks(8) {
        let Some(at) = x.place(tick.value) else { continue };
        elements.line(
            if tick.text.is_some() { "grid" } else { "minor" },
            [at, top],
            [at, bottom],
        );
        let Some(text) = &tick.text else { continue };
        // Texts that would touch the one before are left out.
        let half = width(text) / 2.0;
        if at - half > free_from {
            elements.text("quiet", [at, bottom + 17.0], Anchor::Middle, text);
            free_from = at + half + 6.0;
        }
    }
    elements.polyline("axis", &[[left, top], [left, bottom], [RIGHT, bottom]]);
    elements.text("", [(left + RIGHT) / 2.0, bottom + 37.0], Anchor::Middle, &plot.x.title);
    elements.vertical_text([14.0, (top + bottom) / 2.0], &plot.y.title);
    data(&mut elements, plot, &x, &y, Area::new(left, top, RIGHT, bottom));
    elements.finish(bottom + 46.0, &plot.title)
}

/// The legend: markers, and the dashed line.
fn key(elements: &mut Elements, plot: &Plot) -> f64 {
    let mut names: Vec<String> = plot.series.iter().map(|series| series.name.clone()).collect();
    names.extend((plot.line.len() > 1).then(|| plot.line_name.clone()));
    legend(
        elements,
        &names,
        30.0,
        &|elements, i, [x, y]| match plot.series.get(i) {
            Some(series) => elements.marker(series.style, true, [x, y], ""),
            None => elements.line("front", [x - 7.0, y], [x + 5.0, y]),
        },
    )
}

fn data(elements: &mut Elements, plot: &Plot, x: &Scale, y: &Scale, area: Area) {
    let place = |px: f64, py: f64| Some([x.place(px)?, y.place(py)?]);
    let mut lines = Vec::new();
    for series in &plot.series {
        let colour = series.style % super::COLOURS;
        let line: Vec<[f64; 2]> = series.points.iter().filter_map(|p| place(p.x, p.y)).collect();
        elements.polyline(&format!("line s{colour}"), &line);
        lines.push(line);
        for point in &series.points {
            let ends = point.spread.map(|ends| ends.map(|end| place(end, point.y)));
            if let Some([Some(low), Some(high)]) = ends {
                elements.line(&format!("whisker s{colour}"), low, high);
            }
        }
    }
    let front: Vec<[f64; 2]> = plot.line.iter().filter_map(|[px, py]| place(*px, *py)).collect();
    if front.len() > 1 {
        elements.polyline("front", &front);
    }
    let mut labels = Labels {
        area,
        obstacles: line_areas(&front),
        lines: lines.iter().flat_map(|line| line_areas(line)).collect(),
    };
    let mut named = Vec::new();
    for series in &plot.series {
        for point in &series.points {
            let Some(at) = place(point.x, point.y) else { continue };
            elements.marker(series.style, point.filled, at, &point.title);
            labels.obstacles.push(Area::of_marker(at));
            named.extend(point.name.as_ref().map(|name| (at, name)));
        }
    }
    for (at, name) in named {
        labels.place(elements, at, name);
    }
}

/// A line as a chain of small areas that texts can keep clear of.
fn line_areas(line: &[[f64; 2]]) -> Vec<Area> {
    let dots = |pair: &[[f64; 2]]| -> Vec<Area> {
        let [from, to] = [pair[0], pair[1]];
        let steps = ((to[0] - from[0]).hypot(to[1] - from[1]) / 5.0).ceil().max(1.0);
        let along = |i: usize| [0, 1].map(|axis| from[axis] + i as f64 / steps * (to[axis] - from[axis]));
        let dot = |[x, y]: [f64; 2]| Area::new(x - 1.0, y - 1.0, x + 1.0, y + 1.0);
        (0..=steps as usize).map(|i| dot(along(i))).collect()
    };
    line.windows(2).flat_map(dots).collect()
}
