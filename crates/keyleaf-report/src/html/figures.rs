//! The figures of a scene.

use crate::report::{Point, Quantity, SceneReport};
use crate::slope::{falling_error, power_law};
use crate::svg::{Axis, Bar, Plot, PlotPoint, PlotSeries, bars, plot};
use crate::table::{bytes, figure, thousands};

/// A figure with its heading and what there is to say of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Figure {
    /// The heading.
    pub title: String,
    /// The figure; [`standalone`](crate::svg::standalone) makes a file of it.
    pub svg: String,
    /// How to read it.
    pub remark: String,
}

const TIME: &str = "milliseconds a frame";
/// Bars in a figure.
const MOST_BARS: usize = 28;
/// The longest over the shortest frame that bars show in milliseconds.
const MOST_RATIO: f64 = 8.0;

/// The figures of a scene for which there are numbers, in the order of the page.
pub fn figures(scene: &SceneReport) -> Vec<Figure> {
    let mut figures: Vec<Figure> = Quantity::ALL
        .into_iter()
        .filter_map(|q| error_against_time(scene, q))
        .collect();
    figures.extend(triangles_against_error(scene));
    figures.extend(time_by_pass(scene));
    figures.extend(memory_against_time(scene));
    figures.extend(time_against_leaves(scene));
    figures
}

/// The points of all series that have both values. `look` tells place, filling and name of point number i.
fn series(scene: &SceneReport, look: impl Fn(usize, &Point) -> Option<PlotPoint>) -> Vec<PlotSeries> {
    let of = |(style, name): (usize, &str)| {
        let points = scene
            .points
            .iter()
            .enumerate()
            .filter(|(_, point)| point.series == name);
        let points: Vec<PlotPoint> = points.filter_map(|(i, point)| look(i, point)).collect();
        (!points.is_empty()).then(|| PlotSeries {
            name: name.to_owned(),
            style,
            points,
        })
    };
    scene.series().into_iter().enumerate().filter_map(of).collect()
}

fn full_name(point: &Point) -> String {
    format!("{} {}", point.series, point.label).trim().to_owned()
}

/// What shows when a point is pointed at.
fn title(point: &Point) -> String {
    let time = figure(point.ms);
    format!(
        "{}: {time} ms, {} triangles",
        full_name(point),
        thousands(point.triangles)
    )
}

fn error_against_time(scene: &SceneReport, quantity: Quantity) -> Option<Figure> {
    let front = scene.front(quantity);
    let has_one_series = scene.series().len() == 1;
    let series = series(scene, |i, point| {
        let name = if has_one_series {
            point.label.clone()
        } else {
            full_name(point)
        };
        let filled = front.contains(&i);
        Some(PlotPoint {
            x: point.ms,
            y: quantity.of(point)?,
            spread: point.spread.map(|spread| [spread.low, spread.high]),
            filled,
            name: filled.then_some(name),
            title: title(point),
        })
    });
    if series.is_empty() {
        return None;
    }
    let axis = if quantity.is_logarithmic() {
        Axis::logarithmic
    } else {
        Axis::linear
    };
    let place = |i: &usize| Some([scene.points[*i].ms, quantity.of(&scene.points[*i])?]);
    let better = if quantity.is_logarithmic() { "lower" } else { "higher" };
    Some(Figure {
        title: quantity.title().to_owned(),
        svg: plot(&Plot {
            title: format!("{}: {}", scene.name, quantity.title()),
            x: Axis::logarithmic(TIME),
            y: axis(quantity.axis()),
            series,
            line: stairs(&front.iter().filter_map(place).collect::<Vec<_>>()),
            line_name: "not beaten".to_owned(),
        }),
        remark: format!(
            "Further left and {better} is better. Filled and named: no other setting is as fast and as accurate. Thin lines: where the \
             median may lie."
        ),
    })
}

/// What a front leaves no setting beyond: each point holds until the next.
fn stairs(front: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let corner = |pair: &[[f64; 2]]| [[pair[1][0], pair[0][1]], pair[1]];
    front
        .first()
        .copied()
        .into_iter()
        .chain(front.windows(2).flat_map(corner))
        .collect()
}

fn triangles_against_error(scene: &SceneReport) -> Option<Figure> {
    let quantity = Quantity::ALL
        .into_iter()
        .find(|q| scene.points.iter().any(|point| q.of(point).is_some()))?;
    if !quantity.is_logarithmic() {
        return None;
    }
    let mut series = series(scene, |_, point| {
        Some(PlotPoint {
            x: point.triangles,
            y: quantity.of(point)?,
            filled: true,
            title: title(point),
            ..PlotPoint::default()
        })
    });
    for series in &mut series {
        let values: Vec<(f64, f64)> = series.points.iter().map(|p| (1.0 / p.x.sqrt(), p.y)).collect();
        if let Some(slope) = falling_error(&values).filter(|slope| slope.points > 2) {
            series.name = format!("{}: order {:.2}", series.name, slope.exponent);
        }
    }
    Some(Figure {
        title: "Triangles against error".to_owned(),
        svg: plot(&Plot {
            title: format!("{}: triangles against error", scene.name),
            x: Axis::logarithmic("triangles drawn"),
            y: Axis::logarithmic(quantity.axis()),
            series,
            line: Vec::new(),
            line_name: String::new(),
        }),
        remark: "Order: the power of the edge's length, 1/√triangles, with which the error falls, floor left out; 2 is that of chords."
            .to_owned(),
    })
}

fn time_by_pass(scene: &SceneReport) -> Option<Figure> {
    let mut names: Vec<String> = Vec::new();
    for pass in scene.points.iter().flat_map(|point| &point.passes) {
        if !names.contains(&pass.name) {
            names.push(pass.name.clone());
        }
    }
    if names.is_empty() {
        return None;
    }
    // Evenly chosen if there are too many.
    let every = scene.points.len().div_ceil(MOST_BARS).max(1);
    let chosen: Vec<&Point> = scene.points.iter().step_by(every).collect();
    let ms = |point: &Point| -> Vec<f64> {
        let of = |name: &String| {
            point
                .passes
                .iter()
                .filter(|pass| pass.name == *name)
                .map(|pass| pass.ms)
                .sum()
        };
        names.iter().map(of).collect()
    };
    let totals: Vec<f64> = chosen.iter().map(|point| ms(point).iter().sum()).collect();
    let (least, most) = totals
        .iter()
        .fold((f64::INFINITY, 0.0f64), |(l, m), t| (l.min(*t), m.max(*t)));
    // Where times differ much, short bars would show nothing.
    let as_parts = most > MOST_RATIO * least;
    let bar = |(point, total): (&&Point, &f64)| {
        let unit = if as_parts {
            100.0 / total.max(f64::MIN_POSITIVE)
        } else {
            1.0
        };
        Bar {
            name: full_name(point),
            parts: ms(point).into_iter().map(|part| part * unit).collect(),
            end: format!("{} ms", figure(*total)),
        }
    };
    let rows: Vec<Bar> = chosen.iter().zip(&totals).map(bar).collect();
    let mut remark = "Medians of passes; their sum, at the right, need not be the median of frames.".to_owned();
    if every > 1 {
        remark += &format!(" {} of {} settings; the table has all.", rows.len(), scene.points.len());
    }
    let unit = if as_parts { "% of the frame" } else { TIME };
    Some(Figure {
        title: "Time by pass".to_owned(),
        svg: bars(&format!("{}: time by pass", scene.name), &names, unit, &rows),
        remark,
    })
}

fn memory_against_time(scene: &SceneReport) -> Option<Figure> {
    const MEBIBYTE: f64 = 1_048_576.0;
    let series = series(scene, |_, point| {
        (point.bytes > 0).then(|| PlotPoint {
            x: point.ms,
            y: point.bytes as f64 / MEBIBYTE,
            filled: true,
            title: format!("{}, {}", title(point), bytes(point.bytes as f64)),
            ..PlotPoint::default()
        })
    });
    (!series.is_empty()).then(|| Figure {
        title: "Memory against time".to_owned(),
        svg: plot(&Plot {
            title: format!("{}: memory against time", scene.name),
            x: Axis::logarithmic(TIME),
            y: Axis::logarithmic("MiB of all buffers"),
            series,
            line: Vec::new(),
            line_name: String::new(),
        }),
        remark: "Buffers have the size of their capacity, whether it is used or not.".to_owned(),
    })
}

fn time_against_leaves(scene: &SceneReport) -> Option<Figure> {
    let point = |leaves: f64, ms: f64, title: String| PlotPoint {
        x: leaves,
        y: ms,
        filled: true,
        title,
        ..PlotPoint::default()
    };
    let (series, remark) = if scene.growth.is_empty() {
        let all = series(scene, |_, p| (p.leaves > 0.0).then(|| point(p.leaves, p.ms, title(p))));
        (all, String::new())
    } else {
        let title = |leaves| format!("{} leaves", thousands(leaves));
        let points: Vec<PlotPoint> = scene
            .growth
            .iter()
            .map(|g| point(g.leaves, g.ms, title(g.leaves)))
            .collect();
        let values: Vec<(f64, f64)> = scene.growth.iter().map(|g| (g.leaves, g.ms)).collect();
        let remark = power_law(&values).map_or(String::new(), |law| {
            format!(
                "Time grows as leaves to the power of {:.2} over the whole range.",
                law.exponent
            )
        });
        let name = "measured".to_owned();
        (vec![PlotSeries { name, style: 0, points }], remark)
    };
    (!series.is_empty()).then(|| Figure {
        title: "Time against leaves".to_owned(),
        svg: plot(&Plot {
            title: format!("{}: time against leaves", scene.name),
            x: Axis::logarithmic("leaves alive"),
            y: Axis::logarithmic(TIME),
            series,
            line: Vec::new(),
            line_name: String::new(),
        }),
        remark,
    })
}
