//! Stacked bars: what a whole is made of.

use super::element::{Anchor, Elements, LINE, fitting, width};
use super::legend::legend;
use super::scale::Scale;
use super::{COLOURS, WIDTH};
use crate::table::figure;

/// A bar.
#[derive(Clone, Debug, PartialEq)]
pub struct Bar {
    /// Its name.
    pub name: String,
    /// Its parts, as the legend has them.
    pub parts: Vec<f64>,
    /// What stands at its end.
    pub end: String,
}

/// Height of a bar with the room below it.
const ROW: f64 = 21.0;

/// Draws bars of the parts `names`, in `unit`.
pub fn bars(title: &str, names: &[String], unit: &str, rows: &[Bar]) -> String {
    let mut elements = Elements::default();
    let top = legend(&mut elements, names, 8.0, &|elements, i, [x, y]| {
        elements.rectangle(&format!("bar f{}", i % COLOURS), [x - 5.0, y - 5.0], [11.0, 11.0], "");
    });
    let total = |bar: &Bar| bar.parts.iter().filter(|part| part.is_finite()).sum::<f64>();
    let longest_name = rows
        .iter()
        .map(|bar| width(&bar.name))
        .fold(0.0, f64::max)
        .min(0.42 * WIDTH);
    let left = longest_name + 12.0;
    let totals = rows.iter().map(|bar| width(&bar.end)).fold(0.0, f64::max);
    let right = WIDTH - totals - 14.0;
    let scale = Scale::from_zero(rows.iter().map(total).fold(0.0, f64::max), [left, right]);
    let bottom = top + ROW * rows.len() as f64 + 2.0;
    for tick in scale.ticks(6) {
        let (Some(at), Some(text)) = (scale.place(tick.value), tick.text) else {
            continue;
        };
        elements.line("grid", [at, top - 2.0], [at, bottom]);
        elements.text("quiet", [at, bottom + 16.0], Anchor::Middle, &text);
    }
    for (i, bar) in rows.iter().enumerate() {
        let y = top + ROW * i as f64;
        elements.text(
            "",
            [left - 6.0, y + 14.0],
            Anchor::End,
            &fitting(&bar.name, longest_name),
        );
        let mut sum = 0.0;
        for (j, part) in bar
            .parts
            .iter()
            .enumerate()
            .filter(|(_, part)| **part > 0.0 && part.is_finite())
        {
            let (from, to) = (
                scale.place(sum).unwrap_or(left),
                scale.place(sum + part).unwrap_or(left),
            );
            let title = format!("{}: {} {unit}", names.get(j).map_or("", String::as_str), figure(*part));
            elements.rectangle(
                &format!("bar f{}", j % COLOURS),
                [from, y + 1.0],
                [to - from, ROW - 4.0],
                &title,
            );
            sum += part;
        }
        let end = scale.place(sum).unwrap_or(left);
        elements.text("quiet", [end + 6.0, y + 14.0], Anchor::Start, &bar.end);
    }
    elements.line("axis", [left, top - 2.0], [left, bottom]);
    elements.text("", [(left + right) / 2.0, bottom + 16.0 + LINE], Anchor::Middle, unit);
    elements.finish(bottom + 26.0 + LINE, title)
}
