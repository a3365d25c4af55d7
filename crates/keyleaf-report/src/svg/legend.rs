//! The legend, above the data.

use super::WIDTH;
use super::element::{Anchor, Elements, LINE, fitting, width};

/// Room for a marker before its text, and between entries.
const MARKER: f64 = 16.0;
const GAP: f64 = 16.0;

/// How an entry is drawn, at its middle.
pub(super) type Symbol<'a> = &'a dyn Fn(&mut Elements, usize, [f64; 2]);

/// Writes names in rows from `left`; the height that they take.
pub(super) fn legend(elements: &mut Elements, names: &[String], left: f64, symbol: Symbol<'_>) -> f64 {
    let (mut x, mut y) = (left, 12.0);
    for (i, name) in names.iter().enumerate() {
        let name = fitting(name, WIDTH - left - MARKER - 8.0);
        let needed = MARKER + width(&name);
        if x > left && x + needed > WIDTH - 4.0 {
            (x, y) = (left, y + LINE);
        }
        symbol(elements, i, [x + 6.0, y]);
        elements.text("", [x + MARKER, y + 4.5], Anchor::Start, &name);
        x += needed + GAP;
    }
    if names.is_empty() { 4.0 } else { y + LINE }
}
