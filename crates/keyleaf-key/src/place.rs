//! A key decoded in integers (ARCHITECTURE section 2): where a node lies in its root, exactly, at every level.

use crate::{Key, MAX_LEVEL, ONE, Topology};
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

    /// Coordinates in the axes of another root of the same face, which has four corners: its roots are turned against each other by
    /// right angles. Negative beyond a spoke.
    fn in_axes_of(self, root: u32) -> [i64; 2] {
        let turns = self.root.wrapping_sub(root) & 3;
        let start = [self.x, self.y].map(i64::from);
        (0..turns).fold(start, |[a, b], _| [-b, a])
    }

    /// The point of a face with four corners that has these coordinates in the axes of a root.
    fn from_axes(face: u32, root: u32, mut at: [i64; 2]) -> Self {
        let mut own = root & 3;
        while at.iter().any(|&x| x < 0) {
            at = [at[1], -at[0]];
            own = (own + 1) & 3;
        }
        let [x, y] = at.map(|x| x as u32);
        Self { face, root: own, x, y }
    }

    /// The point in the middle between this one and another of the same root, or of the same face if it has four corners; none if it is
    /// not a multiple of 1/[`ONE`].
    pub fn middle(self, other: Self) -> Option<Self> {
        let [from, to] = [self, other].map(|point| point.in_axes_of(self.root));
        let sum = [from[0] + to[0], from[1] + to[1]];
        let is_whole = sum.iter().all(|x| x % 2 == 0);
        is_whole.then(|| {
            if self.root == other.root {
                let [x, y] = sum.map(|x| (x / 2) as u32);
                Self { x, y, ..self }
            } else {
                Self::from_axes(self.face, self.root, sum.map(|x| x / 2))
            }
        })
    }

    /// Whether a straight line from this point to another of the same face lies on a mesh edge without a neighbour.
    pub fn runs_along_boundary(self, other: Self, topology: &Topology) -> bool {
        let is_open = |root: u32| topology.twin(self.face, root).is_none();
        if self.root == other.root {
            return [self, other].iter().all(|point| point.is_on_mesh_edge()) && is_open(self.root);
        }
        // Only pairs of the roots of a four-cornered face reach over a spoke.
        (0..4).any(|root| {
            let is_on_edge = |[a, b]: [i64; 2]| a >= 0 && b >= 0 && a + b == i64::from(ONE);
            [self, other].iter().all(|point| is_on_edge(point.in_axes_of(root))) && is_open(root)
        })
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
/// a [`Topology`], neighbours take constant time.
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

    /// Whether this is the odd half of the pair that it may be half of: child 1 or 3, and root 1 or 3 of a face with four corners.
    /// An odd half is not drawn, the even one takes its place.
    pub fn is_odd_half(self) -> bool {
        self.digit().unwrap_or(self.root) & 1 == 1
    }

    /// The point (a, b) of the triangle of the pair of which this is the even half, in units of 1/[`ONE`] along its legs.
    ///
    /// In this node's axes the right angle is at (u, 0), and the legs end at (0, u) and (0, -u). Of two roots, what is beyond the spoke is in
    /// the root before this one; their face has four corners.
    pub fn at_of_pair(self, a: u32, b: u32) -> RootPoint {
        let (along, across) = (self.unit().wrapping_sub(a).wrapping_sub(b), a.wrapping_sub(b));
        if self.level == 0 && a < b {
            return RootPoint {
                face: self.face,
                root: self.root.wrapping_sub(1) & 3,
                x: b - a,
                y: along,
            };
        }
        self.at(along, across)
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

    /// The triangle that is drawn for this leaf, counter-clockwise: its own corners O, R, U, or those of the pair that it is half of, from
    /// its right angle on (ARCHITECTURE section 3). The even half then draws for both, and the odd one nothing.
    ///
    /// `paired` says that. Leaves must be pairs where the node across the leg that they share with their parent is a leaf, and may be
    /// where the four nodes about their right angle are leaves; roots only if their face has four corners.
    pub fn drawn(self, paired: bool) -> Option<[RootPoint; 3]> {
        if !paired {
            return Some(self.corners());
        }
        let unit = self.unit();
        let corners = [[0, 0], [unit, 0], [0, unit]];
        (!self.is_odd_half()).then(|| corners.map(|[a, b]| self.at_of_pair(a, b)))
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
                Some([parent.middle(), up, origin]),
                None,
                Some([parent.middle(), origin, right]),
                None
            ]
        );
        assert_eq!(parent.child(1).drawn(false), Some(parent.child(1).corners()));
    }

    #[test]
    fn two_pairs_of_roots_are_a_face_cut_along_a_diagonal() {
        let corner = |root: u32| RootPoint {
            face: 7,
            root,
            x: ONE,
            y: 0,
        };
        let last = |root: u32| RootPoint {
            face: 7,
            root,
            x: 0,
            y: ONE,
        };
        let drawn = [0, 1, 2, 3].map(|root| Place::of_root(7, root).drawn(true));
        let expected = |root: u32| Some([corner(root), last(root), corner((root + 3) & 3)]);
        assert_eq!(drawn, [expected(0), None, expected(2), None]);
    }

    #[test]
    fn middles_of_lines_over_a_spoke_lie_on_the_face() {
        let at = |root, x, y| RootPoint { face: 7, root, x, y };
        let half = ONE / 2;
        let cases = [
            (at(0, ONE, 0), at(3, ONE, 0), Some(at(3, half, half))), // a mesh edge, its ends in two roots
            (at(0, 0, ONE), at(3, ONE, 0), Some(at(0, 0, 0))),       // the diagonal
            (at(2, 0, half), at(3, 0, half), Some(at(3, half / 2, half / 2))),
            (at(1, 8, 4), at(1, 2, 6), Some(at(1, 5, 5))),
            (at(1, 8, 4), at(1, 3, 6), None),
        ];
        // The centre is one point in any root.
        let site = |at: RootPoint| if at.z() == ONE { RootPoint { root: 0, ..at } } else { at };
        for (from, to, middle) in cases {
            for found in [from.middle(to), to.middle(from)] {
                assert_eq!(found.map(site), middle, "{from:?} {to:?}");
            }
        }
    }
}
