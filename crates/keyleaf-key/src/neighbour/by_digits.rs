//! The neighbours by the digit rules of ARCHITECTURE section 2, on keys: up to one step a level. An independent check of the rules on
//! places, and what a reader of the papers knows. Keys are taken as they are made by this crate: well-formed.

use crate::{Key, Topology};

/// The neighbour across the leg O–R.
pub fn x(topology: &Topology, node: Key) -> Key {
    match (node.parent(), node.digit()) {
        (Some(parent), Some(0)) => parent.child(1),
        (Some(parent), Some(2)) => parent.child(3),
        (Some(parent), Some(1)) => y(topology, parent).child(2),
        (Some(parent), _) => x(topology, parent).child(0),
        (None, _) => {
            let count = topology.corner_count(node.face());
            Key::of_root(node.face(), (node.root() + count - 1) % count)
        }
    }
}

/// The neighbour across the leg O–U.
pub fn y(topology: &Topology, node: Key) -> Key {
    match (node.parent(), node.digit()) {
        (Some(parent), Some(1)) => parent.child(0),
        (Some(parent), Some(3)) => parent.child(2),
        (Some(parent), Some(0)) => y(topology, parent).child(3),
        (Some(parent), _) => x(topology, parent).child(1),
        (None, _) => Key::of_root(node.face(), (node.root() + 1) % topology.corner_count(node.face())),
    }
}

/// The neighbour across the hypotenuse R–U; none on a boundary of the mesh.
pub fn h(topology: &Topology, node: Key) -> Option<Key> {
    match (node.parent(), node.digit()) {
        (Some(parent), Some(1)) => Some(parent.child(2)),
        (Some(parent), Some(2)) => Some(parent.child(1)),
        (Some(parent), Some(0)) => Some(h(topology, parent)?.child(3)),
        (Some(parent), _) => Some(h(topology, parent)?.child(0)),
        (None, _) => topology
            .twin(node.face(), node.root())
            .map(|twin| Key::of_root(twin.face, twin.root)),
    }
}
