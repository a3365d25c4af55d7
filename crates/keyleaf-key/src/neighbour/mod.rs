//! The neighbours of a node across its three edges, in constant time, also across roots and faces (ARCHITECTURE section 2).
//!
//! All of it follows from the geometry of [`Place`]s. Inside a root the node across a leg has the same O and is turned by a
//! quarter, the one across the hypotenuse lies at the fourth corner of the diamond, turned by two. Where the edge lies on the
//! root's own, the result is carried into the coordinates of the neighbouring root:
//!
//! | edge | crossed by | neighbouring root | map |
//! |---|---|---|---|
//! | spoke y = 0 | X of orientation 0, Y of 1 | the previous one of the face | (x, 0) to (0, x), one turn left |
//! | spoke x = 0 | X of orientation 3, Y of 0 | the next one of the face | (0, y) to (y, 0), one turn right |
//! | mesh edge x + y = 1 | H of orientation 0 | the twin | O = (x, y) to (y, x), no turn |
//!
//! [`by_digits`] has the recursive rules on keys that the tests compare this with.

pub mod by_digits;

use crate::{ONE, Place, Topology};

/// The neighbour across the leg O–R, which is the neighbour's leg O–U. Every node has one.
pub fn x(topology: &Topology, node: Place) -> Place {
    across_leg(topology, node, 3, 0)
}

/// The neighbour across the leg O–U, which is the neighbour's leg O–R. Every node has one.
pub fn y(topology: &Topology, node: Place) -> Place {
    across_leg(topology, node, 1, 1)
}

/// The neighbour across the hypotenuse R–U, the other half of the diamond; none on a boundary of the mesh.
pub fn h(topology: &Topology, node: Place) -> Option<Place> {
    let unit = node.unit();
    if node.orientation == 0 && node.x + node.y + unit == ONE {
        let twin = topology.twin(node.face, node.root)?;
        return Some(Place {
            face: twin.face,
            root: twin.root,
            x: node.y,
            y: node.x,
            ..node
        });
    }
    let origin = node.at(unit, unit);
    Some(Place {
        x: origin.x,
        y: origin.y,
        orientation: (node.orientation + 2) & 3,
        ..node
    })
}

/// C(n): the node of the parent's level across the leg that the node shares with its parent; none at a root.
///
/// A leaf whose C(n) is a leaf is *blocked*: it is drawn as half of a pair, and it may not split.
pub fn across_outer_leg(topology: &Topology, node: Place) -> Option<Place> {
    let (parent, digit) = node.ascend()?;
    Some(if digit >= 2 {
        x(topology, parent)
    } else {
        y(topology, parent)
    })
}

/// The four nodes about the vertex at the right angle of a node, which is the middle of the leg that its parent and C(n) share: their
/// children along that leg, the node and its sibling first. About the centre of a face with four corners these are its roots; none of
/// other roots.
///
/// Where all four are leaves, they may be drawn as two pairs, without that vertex: their other edges are hypotenuses and outer legs of
/// theirs, which stay as they are.
pub fn about_right_angle(topology: &Topology, node: Place) -> Option<[Place; 4]> {
    if node.level == 0 {
        // An even root and the one before it are a pair.
        let sibling = if node.is_odd_half() { 1 } else { 3 };
        let root = |turns: u32| Place::of_root(node.face, (node.root + turns) & 3);
        return (topology.corner_count(node.face) == 4).then(|| [node, root(sibling), root(sibling + 2), root(2)]);
    }
    let (parent, digit) = node.ascend()?;
    let across = across_outer_leg(topology, node)?;
    let side = digit & 2;
    let sibling = parent.child(digit ^ 1);
    Some([node, sibling, across.child(2 - side), across.child(3 - side)])
}

/// The node with the same O, turned left by `turns` quarters more. `on_x_axis` is the orientation in which the leg to be
/// crossed lies along the first axis of root space with the node above it; one turn to the right (orientation - 1) it lies
/// along the second.
fn across_leg(topology: &Topology, node: Place, turns: u32, on_x_axis: u32) -> Place {
    let orientation = (node.orientation + turns) & 3;
    let corner_count = topology.corner_count(node.face);
    if node.y == 0 && node.orientation == on_x_axis {
        let root = node.root.checked_sub(1).unwrap_or(corner_count - 1);
        Place {
            root,
            x: 0,
            y: node.x,
            orientation: (orientation + 1) & 3,
            ..node
        }
    } else if node.x == 0 && node.orientation == (on_x_axis + 3) & 3 {
        let root = if node.root + 1 == corner_count {
            0
        } else {
            node.root + 1
        };
        Place {
            root,
            x: node.y,
            y: 0,
            orientation: (orientation + 3) & 3,
            ..node
        }
    } else {
        Place { orientation, ..node }
    }
}
