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

/// Places labels one after the other.
pub(super) struct Labels {
    /// That of the plot.
    pub area: Area,
    /// What must not be covered.
    pub obstacles: Vec<Area>,
    /// What should not be.
    pub lines: Vec<Area>,
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
    /// Writes a text near a point, with a line to it where it stands far off; clear of lines if that can be. `false` if there is no
    /// room.
    pub fn place(&mut self, elements: &mut Elements, at: [f64; 2], text: &str) -> bool {
        let places = || {
            RINGS
                .into_iter()
                .flat_map(|ring| DIRECTIONS.map(|direction| Place::new(at, ring, direction, text)))
        };
        let is_free = |place: &Place| {
            let is_covered = self.obstacles.iter().any(|other| other.meets(&place.area));
            self.area.holds(&place.area) && !is_covered
        };
        let is_clear = |place: &Place| !self.lines.iter().any(|line| line.meets(&place.area));
        let found = places()
            .find(|place| is_free(place) && is_clear(place))
            .or_else(|| places().find(is_free));
        let Some(Place { area, from, leader }) = found else {
            return false;
        };
        if let Some([near, far]) = leader {
            elements.line("leader", near, far);
        }
        elements.text("", from.0, from.1, text);
        self.obstacles.push(area);
        true
    }
}

/// Where a text may stand.
struct Place {
    area: Area,
    from: ([f64; 2], Anchor),
    leader: Option<[[f64; 2]; 2]>,
}

impl Place {
    fn new(at: [f64; 2], ring: f64, [dx, dy]: [f64; 2], text: &str) -> Self {
        let size = width(text);
        let (x, y) = (at[0] + ring * dx, at[1] + ring * dy);
        let (anchor, left) = match dx {
            dx if dx > 0.1 => (Anchor::Start, x),
            dx if dx < -0.1 => (Anchor::End, x - size),
            _ => (Anchor::Middle, x - size / 2.0),
        };
        let near = [at[0] + 7.0 * dx, at[1] + 7.0 * dy];
        let is_far = ring > RINGS[0];
        // A text above or below its point is met at its edge.
        let edge = if anchor == Anchor::Middle { 8.0 * dy } else { 0.0 };
        Self {
            area: Area::new(left - 1.0, y - 8.0, left + size + 1.0, y + 8.0),
            from: ([x, y + 4.5], anchor),
            leader: is_far.then_some([near, [x - 2.0 * dx, y - 2.0 * dy - edge]]),
        }
    }
}
