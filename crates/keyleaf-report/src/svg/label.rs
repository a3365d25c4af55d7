//! Texts beside points that cover nothing.

use super::element::{Anchor, Elements, width};

/// A rectangle: left, top, right, bottom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Area([f64; 4]);

impl Area {
    pub fn new(left: f64, top: f64, right: f64, bottom: f64) -> Self {
        Self([left, top, right, bottom])
    }

    /// About a marker.
    pub fn of_marker([x, y]: [f64; 2]) -> Self {
        Self([x - 6.0, y - 6.0, x + 6.0, y + 6.0])
    }

    pub fn meets(&self, other: &Self) -> bool {
        let ([a, b, c, d], [e, f, g, h]) = (self.0, other.0);
        a < g && e < c && b < h && f < d
    }

    fn holds(&self, other: &Self) -> bool {
        let ([a, b, c, d], [e, f, g, h]) = (self.0, other.0);
        a <= e && b <= f && c >= g && d >= h
    }
}

/// Places labels one after the other; the area is that of the plot, the obstacles what must not be covered.
pub(super) struct Labels {
    pub area: Area,
    pub obstacles: Vec<Area>,
}

/// Distances of a text from its point, the nearest first.
const RINGS: [f64; 4] = [10.0, 20.0, 34.0, 50.0];
/// Directions in which a text may stand: right above first, since fronts fall to the right.
const DIRECTIONS: [[f64; 2]; 8] = [
    [0.8, -0.6],
    [-0.8, 0.6],
    [1.0, 0.0],
    [0.0, -1.0],
    [0.0, 1.0],
    [-1.0, 0.0],
    [0.8, 0.6],
    [-0.8, -0.6],
];

impl Labels {
    /// Writes a text near a point, with a line to it where it stands far off. `false` if there is no room.
    pub fn place(&mut self, elements: &mut Elements, at: [f64; 2], text: &str) -> bool {
        let size = width(text);
        for ring in RINGS {
            for [dx, dy] in DIRECTIONS {
                let (x, y) = (at[0] + ring * dx, at[1] + ring * dy);
                let (anchor, left) = match dx {
                    dx if dx > 0.1 => (Anchor::Start, x),
                    dx if dx < -0.1 => (Anchor::End, x - size),
                    _ => (Anchor::Middle, x - size / 2.0),
                };
                let area = Area::new(left - 1.0, y - 8.0, left + size + 1.0, y + 8.0);
                if self.area.holds(&area) && !self.obstacles.iter().any(|other| other.meets(&area)) {
                    if ring > RINGS[0] {
                        let near = [at[0] + 7.0 * dx, at[1] + 7.0 * dy];
                        elements.line("leader", near, [x - 2.0 * dx, y - 2.0 * dy]);
                    }
                    elements.text("", [x, y + 4.5], anchor, text);
                    self.obstacles.push(area);
                    return true;
                }
            }
        }
        false
    }
}
