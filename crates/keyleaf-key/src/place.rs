//! A key decoded in integers (ARCHITECTURE section 2): where a node lies in its root, exactly, at every level.

use crate::{Key, MAX_LEVEL, ONE};
use bytemuck::{Pod, Zeroable};

/// The images of (1, 0) after 0, 1, 2 and 3 quarter turns to the left. The arithmetic wraps: `u32::MAX` stands for -1, and
/// every result lies in `0..=ONE`.
const AXES: [[u32; 2]; 4] = [[1, 0], [0, 1], [u32::MAX, 0], [0, u32::MAX]];

/// A point of a face by its weights in one root, in units of 1/[`ONE`].
///
/// `x` is the weight of corner `root` of the face, `y` that of the next corner, and the rest, [`RootPoint::z`], that of the
/// face's centre. A point on a spoke or a mesh edge has several such addresses; its [`Site`](crate::Site) is one.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Pod, Zeroable)]
pub struct RootPoint {
    /// The face, counted from 0.
    pub face: u32,
    /// The root of the face.
    pub root: u32,
    /// Weight of corner `root`, at most [`ONE`].
    pub x: u32,
    /// Weight of corner `root + 1`, at most [`ONE`]` - x`.
    pub y: u32,
}

impl RootPoint {
    /// The weight of the face's centre.
    pub fn z(self) -> u32 {
        ONE.wrapping_sub(self.x).wrapping_sub(self.y)
    }

    /// Whether the point lies on the mesh edge of its root, end points included.
    pub fn is_on_mesh_edge(self) -> bool {
        self.z() == 0
    }
}

/// A node of the quadtree, decoded: its right-angled corner O, its size and its turn in root space.
///
/// With the unit u = [`Place::unit`] and the axes A = (1, 0) and B = (0, 1) turned left `orientation` times by 90 degrees, the
/// corners are O = (`x`, `y`), R = O + u A and U = O + u B. Places and keys are in bijection. Children, parent, digit and, with
/// a [`Topology`](crate::Topology), neighbours take constant time.
///
/// The fields are public because the GPU writes places too; [`Place::is_valid`] tells whether one is the place of a key.
///
/// ```
/// use keyleaf_key::{Key, ONE, Place};
/// let place = Place::of_root(0, 1).child(1);
/// assert_eq!((place.x, place.y, place.orientation), (0, ONE / 2, 3));
/// assert_eq!(place.key(), Key::of_root(0, 1).child(1));
/// assert_eq!(place.key().place(), Ok(place));
/// ```
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Pod, Zeroable)]
pub struct Place {
    /// The face, counted from 0.
    pub face: u32,
    /// The root of the face, counted from 0.
    pub root: u32,
    /// First coordinate of O in root space, in units of 1/[`ONE`].
    pub x: u32,
    /// Second coordinate of O in root space, in units of 1/[`ONE`].
    pub y: u32,
    /// Quarter turns to the left, 0 to 3.
    pub orientation: u32,
    /// 0 for a root, at most [`MAX_LEVEL`].
    pub level: u32,
}

impl Place {
    /// Level 0 of root `root` of face `face`.
    pub fn of_root(face: u32, root: u32) -> Self {
        Self {
            face,
            root,
            x: 0,
            y: 0,
            orientation: 0,
            level: 0,
        }
    }

    /// The length of the legs, in units of 1/[`ONE`].
    pub fn unit(self) -> u32 {
        ONE.checked_shr(self.level).unwrap_or(0)
    }

    /// The point O + a A + b B; `a` and `b` in units of 1/[`ONE`], a result outside the root wraps.
    pub fn at(self, a: u32, b: u32) -> RootPoint {
        let [ax, ay] = AXES[(self.orientation & 3) as usize];
        let [bx, by] = AXES[(self.orientation.wrapping_add(1) & 3) as usize];
        let along = |o: u32, a_axis: u32, b_axis: u32| {
            o.wrapping_add(a.wrapping_mul(a_axis))
                .wrapping_add(b.wrapping_mul(b_axis))
        };
        RootPoint {
            face: self.face,
            root: self.root,
            x: along(self.x, ax, bx),
            y: along(self.y, ay, by),
        }
    }

    /// The corners O, R, U, counter-clockwise in root space.
    pub fn corners(self) -> [RootPoint; 3] {
        [self.at(0, 0), self.at(self.unit(), 0), self.at(0, self.unit())]
    }

    /// The middle of the hypotenuse, which both halves of the diamond share.
    ///
    /// At [`MAX_LEVEL`] it is not a multiple of 1/[`ONE`]; there the answer is R, half a unit away, and the two halves differ.
    pub fn middle(self) -> RootPoint {
        let half = self.unit() / 2;
        if half == 0 { self.at(1, 0) } else { self.at(half, half) }
    }

    /// Child `digit` (0..4) of a node above [`MAX_LEVEL`].
    #[must_use]
    pub fn child(self, digit: u32) -> Self {
        debug_assert!(self.level < MAX_LEVEL && digit < 4);
        let half = self.unit() / 2;
        let (origin, turns) = match digit {
            0 => (self.at(0, half), 0),
            1 => (self.at(0, half), 3),
            2 => (self.at(half, 0), 1),
            _ => (self.at(half, 0), 0),
        };
        Self {
            x: origin.x,
            y: origin.y,
            orientation: (self.orientation + turns) & 3,
            level: self.level + 1,
            ..self
        }
    }

    /// The four children, by digit.
    pub fn children(self) -> [Self; 4] {
        [0, 1, 2, 3].map(|digit| self.child(digit))
    }

    /// The parent, none at a root.
    pub fn parent(self) -> Option<Self> {
        self.ascend().map(|(parent, _)| parent)
    }

    /// Which child of its parent this is, none at a root.
    pub fn digit(self) -> Option<u32> {
        self.ascend().map(|(_, digit)| digit)
    }

    /// The parent and the digit, from the place alone.
    ///
    /// In units of u a child's origin is its parent's origin, whose coordinates are even, plus one step along the parent's A
    /// (children 2, 3) or B (0, 1): the axis is the odd coordinate. A parent below the root is itself one step from its own
    /// parent, so its coordinates have an odd sum in units of 2u, which leaves one sign. The child's turn against that
    /// step is then its digit.
    pub fn ascend(self) -> Option<(Self, u32)> {
        if self.level == 0 || self.level > MAX_LEVEL {
            return None;
        }
        let shift = MAX_LEVEL - self.level;
        let (x, y) = (self.x >> shift, self.y >> shift);
        let forward = self.level == 1 || x.wrapping_add(y) & 3 == 3;
        let direction = u32::from(x & 1 == 0) + if forward { 0 } else { 2 };
        let digit = (direction + 3).wrapping_sub(self.orientation) & 3;
        let turns = [0, 1, 3, 0][digit as usize];
        let [step_x, step_y] = AXES[direction as usize];
        let parent = Self {
            x: self.x.wrapping_sub(step_x.wrapping_mul(self.unit())),
            y: self.y.wrapping_sub(step_y.wrapping_mul(self.unit())),
            orientation: (self.orientation + turns) & 3,
            level: self.level - 1,
            ..self
        };
        Some((parent, digit))
    }

    /// This node's ancestors, its parent first.
    pub fn ancestors(self) -> impl Iterator<Item = Self> {
        std::iter::successors(self.parent(), |place| place.parent())
    }

    /// The key, one step a level.
    pub fn key(self) -> Key {
        let (mut node, mut place) = (0, self);
        for shift in (0..self.level).map(|i| 2 * i) {
            let Some((parent, digit)) = place.ascend() else {
                break;
            };
            node |= u64::from(digit) << shift;
            place = parent;
        }
        Key::from_parts(node | 1 << (2 * self.level.min(MAX_LEVEL)), self.face, self.root)
    }

    /// Whether this is the place of a key: for places that were not made here. It does not ask whether the face exists.
    pub fn is_valid(self) -> bool {
        self.level <= MAX_LEVEL && self.key().place() == Ok(self)
    }

    /// The triangle that is drawn for this leaf, corners in the order O, R, U of its own or its parent's leaf space.
    ///
    /// `paired` says that the node across the leg that the leaf shares with its parent is a leaf, so that the pair of
    /// children along that leg is drawn as one triangle, half of the parent (ARCHITECTURE section 3, *T-junctions*). The even child
    /// then draws for both and the odd one nothing.
    pub fn drawn(self, paired: bool) -> Option<[RootPoint; 3]> {
        let Some((parent, digit)) = self.ascend().filter(|_| paired) else {
            return Some(self.corners());
        };
        let [origin, right, up] = parent.corners();
        match digit {
            0 => Some([origin, parent.middle(), up]),
            2 => Some([origin, right, parent.middle()]),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn descend(digits: impl IntoIterator<Item = u32>) -> Place {
        digits.into_iter().fold(Place::of_root(3, 2), Place::child)
    }

    #[test]
    fn children_of_the_root_lie_as_in_the_table_of_the_design() {
        let half = ONE / 2;
        let at = |x, y| RootPoint { face: 3, root: 2, x, y };
        let expected = [
            [at(0, half), at(half, half), at(0, ONE)],
            [at(0, half), at(0, 0), at(half, half)],
            [at(half, 0), at(half, half), at(0, 0)],
            [at(half, 0), at(ONE, 0), at(half, half)],
        ];
        assert_eq!(Place::of_root(3, 2).children().map(Place::corners), expected);
    }

    #[test]
    fn every_place_to_level_five_finds_its_parent_digit_and_key() {
        let mut nodes = vec![(Place::of_root(3, 2), Key::of_root(3, 2))];
        for _ in 0..5 {
            let mut below = Vec::new();
            for (place, key) in nodes {
                for digit in 0..4 {
                    let (child, child_key) = (place.child(digit), key.child(digit));
                    assert_eq!(child.ascend(), Some((place, digit)));
                    assert_eq!(child.key(), child_key);
                    assert_eq!(child_key.place(), Ok(child));
                    assert!(child.is_valid());
                    below.push((child, child_key));
                }
            }
            nodes = below;
        }
    }

    #[test]
    fn places_that_are_no_node_are_told() {
        let leaf = descend([2, 1, 0, 3]);
        assert!(
            !Place {
                orientation: leaf.orientation ^ 2,
                x: leaf.x + 1,
                ..leaf
            }
            .is_valid()
        );
        assert!(!Place { level: 32, ..leaf }.is_valid());
        assert!(
            !Place {
                orientation: 4,
                ..Place::of_root(0, 0)
            }
            .is_valid()
        );
        assert!(
            !Place {
                x: ONE,
                ..Place::of_root(0, 0)
            }
            .is_valid()
        );
    }

    #[test]
    fn pairs_are_drawn_once_as_half_of_their_parent() {
        let parent = descend([1, 3]);
        let [origin, right, up] = parent.corners();
        let drawn = parent.children().map(|child| child.drawn(true));
        assert_eq!(
            drawn,
            [
                Some([origin, parent.middle(), up]),
                None,
                Some([origin, right, parent.middle()]),
                None
            ]
        );
        assert_eq!(parent.child(1).drawn(false), Some(parent.child(1).corners()));
        assert_eq!(Place::of_root(0, 0).drawn(true), Some(Place::of_root(0, 0).corners()));
    }
}
