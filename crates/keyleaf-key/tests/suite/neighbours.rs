//! Neighbours against the digit rules and against geometry.

use crate::meshes::{self, Mesh};
use crate::places::digits;
use keyleaf_key::neighbour::{across_outer_leg, by_digits, h, x, y};
use keyleaf_key::{Place, Topology};
use proptest::prelude::*;

/// Everything that must hold of the neighbours of one node.
fn check(mesh: &Mesh, topology: &Topology, node: Place) {
    let key = node.key();
    let (across_x, across_y, across_h) = (x(topology, node), y(topology, node), h(topology, node));
    assert_eq!(across_x.key(), by_digits::x(topology, key), "X of {node:?}");
    assert_eq!(across_y.key(), by_digits::y(topology, key), "Y of {node:?}");
    assert_eq!(across_h.map(Place::key), by_digits::h(topology, key), "H of {node:?}");

    let triangle = |place: Place| place.corners().map(|point| mesh.position(point));
    let ([o, r, u], [x_o, _, x_u], [y_o, y_r, _]) = (triangle(node), triangle(across_x), triangle(across_y));
    assert_eq!((x_o, x_u), (o, r), "{across_x:?} lies across the leg O-R of {node:?}");
    assert_eq!((y_o, y_r), (o, u), "{across_y:?} lies across the leg O-U of {node:?}");
    assert_eq!((y(topology, across_x), x(topology, across_y)), (node, node));
    if let Some(other) = across_h {
        let [_, h_r, h_u] = triangle(other);
        assert_eq!((h_r, h_u), (u, r), "{other:?} lies across the hypotenuse of {node:?}");
        assert_eq!(h(topology, other), Some(node));
        assert_eq!(
            mesh.position(node.middle()) == mesh.position(other.middle()),
            node.level < 31
        );
    } else {
        let [_, r, u] = node.corners();
        assert!(r.is_on_mesh_edge() && u.is_on_mesh_edge() && topology.twin(node.face, node.root).is_none());
    }
    for neighbour in [Some(across_x), Some(across_y), across_h].into_iter().flatten() {
        assert!(neighbour.is_valid() && neighbour.level == node.level);
    }

    let outer = across_outer_leg(topology, node);
    assert_eq!(outer.map(|place| place.level + 1), node.parent().map(|_| node.level));
    if let (Some(outer), Some(parent), Some(digit)) = (outer, node.parent(), node.digit()) {
        assert_eq!(
            if digit >= 2 {
                y(topology, outer)
            } else {
                x(topology, outer)
            },
            parent
        );
    }
}

#[test]
fn neighbours_are_exact_for_every_node_to_level_four() {
    for mesh in meshes::by_hand() {
        let topology = mesh.topology();
        let mut nodes: Vec<Place> = topology.roots().collect();
        for _ in 0..=4 {
            nodes.iter().for_each(|node| check(&mesh, &topology, *node));
            nodes = nodes.into_iter().flat_map(Place::children).collect();
        }
    }
}

proptest! {
    #[test]
    fn neighbours_are_exact_at_every_level_of_random_meshes(mesh in meshes::random(), digits in digits(), pick: u16) {
        let topology = mesh.topology();
        let roots: Vec<_> = topology.roots().collect();
        let mut node = roots[usize::from(pick) % roots.len()];
        check(&mesh, &topology, node);
        for digit in digits {
            node = node.child(digit);
            check(&mesh, &topology, node);
        }
    }

    /// Few random digits lead to a border; these stay at one.
    #[test]
    fn neighbours_are_exact_along_spokes_and_mesh_edges(
        mesh in meshes::random(), pick: u16, sides in prop::collection::vec(any::<bool>(), 31), border in 0..3_usize,
    ) {
        let topology = mesh.topology();
        let roots: Vec<_> = topology.roots().collect();
        let mut node = roots[usize::from(pick) % roots.len()];
        for side in sides {
            let touches = |place: &Place| {
                let on_border = |p: &keyleaf_key::RootPoint| [p.x, p.y, p.z()][border] == 0;
                place.corners().iter().filter(|p| on_border(p)).count() == 2
            };
            let mut along = node.children().into_iter().filter(touches).collect::<Vec<_>>();
            prop_assert!(!along.is_empty());
            node = if side { along.swap_remove(0) } else { along.pop().expect("one child at least") };
            check(&mesh, &topology, node);
        }
    }
}
