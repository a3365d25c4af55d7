//! Writing elements, and how wide text is.

use super::{WIDTH, escape};
use std::fmt::Write;

/// The elements of a figure.
#[derive(Default)]
pub(super) struct Elements(String);

/// Where a text stands at its point.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

impl Elements {
    fn add(&mut self, arguments: std::fmt::Arguments<'_>) {
        // Writing to a string does not fail.
        let _ = self.0.write_fmt(arguments);
        self.0.push('\n');
    }

    pub fn line(&mut self, class: &str, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2]) {
        self.add(format_args!(
            r#"<line class="{class}" x1="{x1:.1}" y1="{y1:.1}" x2="{x2:.1}" y2="{y2:.1}"/>"#
        ));
    }

    pub fn polyline(&mut self, class: &str, points: &[[f64; 2]]) {
        let points: Vec<String> = points.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
        self.add(format_args!(
            r#"<polyline class="{class}" points="{}"/>"#,
            points.join(" ")
        ));
    }

    pub fn rectangle(&mut self, class: &str, [x, y]: [f64; 2], [width, height]: [f64; 2], title: &str) {
        self.add(format_args!(
            r#"<rect class="{class}" x="{x:.1}" y="{y:.1}" width="{width:.1}" height="{height:.1}"><title>{}</title></rect>"#,
            escape(title)
        ));
    }

    pub fn text(&mut self, class: &str, [x, y]: [f64; 2], anchor: Anchor, text: &str) {
        let anchor = ["start", "middle", "end"][anchor as usize];
        self.add(format_args!(
            r#"<text class="{class}" x="{x:.1}" y="{y:.1}" text-anchor="{anchor}">{}</text>"#,
            escape(text)
        ));
    }

    /// Text that runs upwards, centred.
    pub fn vertical_text(&mut self, [x, y]: [f64; 2], text: &str) {
        self.add(format_args!(
            r#"<text transform="translate({x:.1} {y:.1}) rotate(-90)" text-anchor="middle">{}</text>"#,
            escape(text)
        ));
    }

    /// The marker of a series, filled or hollow, with a text that shows when it is pointed at.
    pub fn marker(&mut self, series: usize, is_filled: bool, [x, y]: [f64; 2], title: &str) {
        let colour = series % super::COLOURS;
        let class = if is_filled {
            format!("mark s{colour} f{colour}")
        } else {
            format!("mark s{colour} hollow")
        };
        const SHAPES: [&str; 5] = [
            "M-4.2 -4.2H4.2V4.2H-4.2Z",
            "M0 -5.4L5.2 4H-5.2Z",
            "M0 -5.8L5.8 0L0 5.8L-5.8 0Z",
            "M0 5.4L5.2 -4H-5.2Z",
            "M-5 0L-2.5 -4.6H2.5L5 0L2.5 4.6H-2.5Z",
        ];
        let title = escape(title);
        match series
            .checked_sub(1)
            .map(|i| SHAPES[i % SHAPES.len()])
            .filter(|_| !series.is_multiple_of(6))
        {
            Some(path) => self.add(format_args!(
                r#"<path class="{class}" transform="translate({x:.1} {y:.1})" d="{path}"><title>{title}</title></path>"#
            )),
            None => self.add(format_args!(
                r#"<circle class="{class}" cx="{x:.1}" cy="{y:.1}" r="4.6"><title>{title}</title></circle>"#
            )),
        }
    }

    /// The figure, with a text for those who do not see it.
    pub fn finish(self, height: f64, what: &str) -> String {
        let what = escape(what);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"fig\" viewBox=\"0 0 {WIDTH:.0} {height:.0}\" role=\"img\" \
             aria-label=\"{what}\">\n{}</svg>",
            self.0
        )
    }
}

/// Height of a line of text.
pub(super) const LINE: f64 = 18.0;

/// About how wide a text is, rather too wide than too narrow.
pub(super) fn width(text: &str) -> f64 {
    let of = |c: char| match c {
        'i' | 'j' | 'l' | '.' | ',' | ':' | ';' | '|' | '\'' | '!' | 'I' | 'f' | 't' | '(' | ')' | ' ' | '/' => 0.38,
        'm' | 'w' | 'M' | 'W' | '%' | '@' => 0.92,
        '⁰'..='⁹' | '¹' | '²' | '³' | '⁻' => 0.42,
        c if c.is_uppercase() => 0.7,
        _ => 0.61,
    };
    13.0 * text.chars().map(of).sum::<f64>()
}

/// The text, cut off with an ellipsis where it is wider than allowed.
pub(super) fn fitting(text: &str, allowed: f64) -> String {
    if width(text) <= allowed {
        return text.to_owned();
    }
    let mut cut: Vec<char> = text.chars().collect();
    while cut.len() > 1 && width(&cut.iter().collect::<String>()) + 13.0 > allowed {
        cut.pop();
    }
    cut.into_iter().chain(['…']).collect()
}
