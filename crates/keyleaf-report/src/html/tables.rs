//! The tables of a report.

use super::svg::escape;
use crate::error::Measure;
use crate::report::{Point, Quantity, Report, SceneReport};
use crate::run::Device;
use crate::scaling::Scaling;
use crate::slope::falling_error;
use crate::table::{bytes, figure, is_number, thousands};

/// A table; `front` tells the rows that stand out. Columns stand right whose cells all begin with a digit, a sign or nothing.
fn table(head: &[&str], rows: &[Vec<String>], front: impl Fn(usize) -> bool, caption: &str) -> String {
    let cells = |column: usize| rows.iter().filter_map(move |row| row.get(column));
    // What no row has is no column.
    let columns: Vec<usize> = (0..head.len())
        .filter(|column| cells(*column).any(|cell| !cell.is_empty()))
        .collect();
    let class = |column: usize| {
        if cells(column).all(|cell| is_number(cell)) {
            ""
        } else {
            " class=\"words\""
        }
    };
    let cell = |kind: &str, column: usize, text: &str| format!("<{kind}{}>{}</{kind}>", class(column), escape(text));
    let names: String = columns
        .iter()
        .map(|column| cell("th", *column, head[*column]))
        .collect();
    let row = |(i, row): (usize, &Vec<String>)| {
        let text = |column: &usize| row.get(*column).map_or("", String::as_str);
        let cells: String = columns.iter().map(|column| cell("td", *column, text(column))).collect();
        format!("<tr{}>{cells}</tr>\n", if front(i) { " class=\"front\"" } else { "" })
    };
    let body: String = rows.iter().enumerate().map(row).collect();
    format!(
        "<div class=\"scroll\"><table>\n<caption>{}</caption>\n<thead><tr>{names}</tr></thead>\n<tbody>\n{body}</tbody>\n</table></div>\n",
        escape(caption)
    )
}

/// What was measured on, and with what.
pub(super) fn device(report: &Report) -> String {
    let (device, tool) = (&report.device, &report.tool);
    let yes = |flag: bool| if flag { "on" } else { "off" }.to_owned();
    let rows = [
        ("device", device.name.clone()),
        ("type", device.kind.clone()),
        ("driver", device.driver.clone()),
        ("backend", device.backend.clone()),
        ("times", device.times().to_owned()),
        ("features", device.features.join(", ")),
        ("flags", device.flags.join(", ")),
        ("validation of indirect calls", yes(device.indirect_validation)),
        ("CPU cores", device.cores.to_string()),
        (
            "keyleaf",
            format!("{} {} ({} build)", tool.version, tool.commit, tool.profile),
        ),
    ];
    let shown = rows.iter().filter(|(_, value)| !value.trim().is_empty());
    let items: String = shown
        .map(|(name, value)| format!("<dt>{name}</dt><dd>{}</dd>\n", escape(value)))
        .collect();
    let mut text = format!("<dl>\n{items}</dl>\n");
    if device.software {
        text += "<p class=\"warning\">This device computes on the CPU. Its times are not GPU times: they tell how settings compare, not \
                 how fast a GPU would be.</p>\n";
    }
    if tool.profile == "debug" {
        text += "<p class=\"warning\">A debug build was measured: its CPU times say nothing.</p>\n";
    }
    text
}

/// All settings of a scene.
pub(super) fn points(scene: &SceneReport, caption: &str) -> String {
    let fronts: Vec<usize> = Quantity::ALL
        .into_iter()
        .flat_map(|quantity| scene.front(quantity))
        .collect();
    let head = [
        "series",
        "setting",
        "ms",
        "median between",
        "leaves",
        "triangles",
        "memory",
        "threshold",
        "distance / diagonal",
        "rms",
        "pixels",
        "rms",
        "silhouette px",
        "normals °",
        "PSNR dB",
        "SSIM",
    ];
    let rows: Vec<Vec<String>> = scene.points.iter().map(row).collect();
    let caption = format!(
        "Bold: not beaten in time and at least one error. Errors are the greatest unless rms. Threshold: the factor by which full \
             buffers raised it, so that the setting was not reached. {caption}"
    );
    let clock = format!(" Times by {}.", scene.clock.text());
    table(&head, &rows, |i| fronts.contains(&i), &(caption + &clock))
}

fn row(point: &Point) -> Vec<String> {
    let maybe = |value: Option<f64>| value.map_or(String::new(), figure);
    let max = |measure: Option<Measure>| maybe(measure.map(|m| m.max));
    let rms = |measure: Option<Measure>| maybe(measure.map(|m| m.rms));
    let errors = &point.errors;
    let spread = point
        .spread
        .map_or(String::new(), |s| format!("{} – {}", figure(s.low), figure(s.high)));
    let decibels =
        |picture: crate::picture::PictureError| picture.psnr.map_or("equal".to_owned(), |db| format!("{db:.1}"));
    vec![
        point.series.clone(),
        point.label.clone(),
        figure(point.ms),
        spread,
        thousands(point.leaves),
        thousands(point.triangles),
        bytes(point.bytes as f64),
        if point.threshold_factor > 1.0 {
            format!("× {}", figure(point.threshold_factor))
        } else {
            String::new()
        },
        max(errors.object),
        rms(errors.object),
        max(errors.pixels),
        rms(errors.pixels),
        max(errors.silhouette),
        max(errors.normal),
        errors.picture.map_or(String::new(), decibels),
        errors
            .picture
            .map_or(String::new(), |picture| format!("{:.5}", picture.ssim)),
    ]
}

/// How fast each series' error falls, and where rounding stops it.
pub(super) fn slopes(scene: &SceneReport) -> String {
    let mut rows = Vec::new();
    for name in scene.series() {
        for quantity in [Quantity::Object, Quantity::Pixels] {
            let points = scene
                .points
                .iter()
                .filter(|point| point.series == name && point.triangles > 0.0);
            let values: Vec<(f64, f64)> = points
                .filter_map(|p| Some((1.0 / p.triangles.sqrt(), quantity.of(p)?)))
                .collect();
            let Some(slope) = falling_error(&values).filter(|slope| slope.points > 2) else {
                continue;
            };
            rows.push(vec![
                name.to_owned(),
                quantity.axis().to_owned(),
                format!("{:.2}", slope.exponent),
                slope.floor.map_or("none reached".to_owned(), figure),
                format!("{} of {}", slope.points, values.len()),
                format!("{:.0} %", 100.0 * (10f64.powf(slope.residual) - 1.0)),
            ]);
        }
    }
    if rows.is_empty() {
        return String::new();
    }
    let head = ["series", "error", "order", "floor", "points fitted", "rms off the fit"];
    let caption = "Error ∝ edge length to the power of the order, the edge taken as 1/√triangles; 2 is what chords of a smooth surface \
                   give. The floor is where rounding stops the fall.";
    table(&head, &rows, |_| false, caption)
}

/// Predictions for other sizes and devices, and how far the model is to be trusted.
pub(super) fn scaling(scaling: &Scaling, device: &Device) -> String {
    let sizes = scaling
        .devices
        .first()
        .map(|(_, row)| row.as_slice())
        .unwrap_or_default();
    let mut head = vec!["device".to_owned(), "GB/s".to_owned()];
    head.extend(sizes.iter().map(|p| format!("{} leaves, ms", thousands(p.leaves))));
    head.push("source of the bandwidth".to_owned());
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    let row = |(class, predictions): &(crate::scaling::DeviceClass, Vec<crate::scaling::Prediction>)| {
        let mut cells = vec![class.name.clone(), figure(class.gigabytes_per_second)];
        cells.extend(predictions.iter().map(|p| figure(p.ms)));
        cells.push(class.source.clone());
        cells
    };
    let mut rows: Vec<Vec<String>> = scaling.devices.iter().map(row).collect();
    if !sizes.is_empty() {
        let memory = sizes.iter().map(|p| bytes(p.bytes));
        rows.push(
            ["memory".to_owned(), String::new()]
                .into_iter()
                .chain(memory)
                .chain([String::new()])
                .collect(),
        );
    }
    let caption = format!("Predicted, not measured. Assumed: {}.", scaling.assumptions.join("; "));
    let mut text = format!(
        "<section id=\"scaling\">\n<h2>Scaling on paper</h2>\n{}",
        table(&head, &rows, |_| false, &caption)
    );
    let ratio = |ratio: Option<f64>| ratio.map_or(String::new(), figure);
    let check = |c: &crate::scaling::Check| {
        vec![
            thousands(c.leaves),
            figure(c.measured_ms),
            ratio(c.line_ratio),
            ratio(c.model_ratio),
        ]
    };
    let checks: Vec<Vec<String>> = scaling.checks.iter().map(check).collect();
    if !checks.is_empty() {
        let head = ["leaves", "measured ms", "line / measured", "model / measured"];
        let power = scaling.growth.map_or(String::new(), |law| {
            format!(
                " Time grows as leaves to the power of {:.2} over all sizes.",
                law.exponent
            )
        });
        let caption = format!(
            "Sizes measured on {}. The line start + leaves × cost is fitted to all but the largest. Near 1: the prediction holds.{power}",
            device.name
        );
        text += &table(&head, &checks, |_| false, &caption);
    }
    text + "</section>\n"
}
