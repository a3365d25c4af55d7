//! Figures as SVG, without scripts: scatter plots and stacked bars.
//!
//! Colours and fonts are classes, so that one style sheet ([`STYLE`]) serves light and dark screens and print; [`standalone`] embeds
//! it. Series differ by colour and by the shape of their markers. Labels are placed where they cover nothing, or not at all: tables have them.

mod bars;
mod element;
mod label;
mod legend;
mod plot;
mod scale;
#[cfg(test)]
mod tests;

pub use bars::{Bar, bars};
pub use plot::{Plot, PlotPoint, PlotSeries, plot};
pub use scale::Axis;

/// The style sheet of all figures.
pub const STYLE: &str = include_str!("figure.css");

/// Width of all figures in their own units; text is 13 units high.
const WIDTH: f64 = 480.0;

/// Colours of the style sheet.
const COLOURS: usize = 7;

/// A figure that needs no page around it.
pub fn standalone(svg: &str) -> String {
    match svg.find('>') {
        Some(end) => format!("{}<style>{STYLE}</style>{}", &svg[..=end], &svg[end + 1..]),
        None => svg.to_owned(),
    }
}

/// Text as XML, and as HTML, has it.
pub fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            // What XML has no way to write.
            c if c.is_control() && c != '\n' && c != '\t' => escaped.push('\u{fffd}'),
            c => escaped.push(c),
        }
    }
    escaped
}
