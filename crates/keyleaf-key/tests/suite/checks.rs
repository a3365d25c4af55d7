//! The checks can fail: each kind of damage is found.

use crate::meshes;
use keyleaf_key::forest::{Violation, cracks, violations};
use keyleaf_key::neighbour::{across_outer_leg, h};
use keyleaf_key::{Forest, Place, Topology};

/// All leaves of one level.
fn uniform(topology: &Topology, level: u32) -> Vec<Place> {
    (0..level).fold(topology.roots().collect(), |nodes, _| {
        nodes.into_iter().flat_map(Place::children).collect()
    })
}

fn split(leaves: &mut Vec<Place>, node: Place) {
    leaves.retain(|leaf| *leaf != node);
    leaves.extend(node.children());
}

#[test]
fn lost_doubled_overlapping_and_foreign_leaves_are_found() {
    let topology = meshes::cube().topology();
    let leaves = uniform(&topology, 2);
    assert_eq!(violations(&topology, leaves.clone()), []);

    let lost = leaves[5];
    let without = leaves.iter().copied().filter(|leaf| *leaf != lost);
    assert_eq!(violations(&topology, without), [Violation::Gap(lost)]);

    let with = |extra: Place| leaves.iter().copied().chain([extra]);
    assert_eq!(violations(&topology, with(lost)), [Violation::Duplicate(lost)]);
    let parent = lost.ancestors().next().expect("level 2");
    assert_eq!(violations(&topology, with(parent)), [Violation::Overlap(parent)]);

    let foreign = [
        Place::of_root(6, 0),
        Place::of_root(0, 4),
        Place { x: lost.x + 1, ..lost },
        Place { level: 40, ..lost },
    ];
    for place in foreign {
        assert_eq!(violations(&topology, with(place)), [Violation::NotANode(place)]);
    }
    assert_eq!(violations(&topology, []).len(), 24);
}

#[test]
fn half_a_split_diamond_is_found_and_cracks() {
    let topology = meshes::cube().topology();
    let node = Place::of_root(2, 1);
    let mut leaves = uniform(&topology, 0);
    split(&mut leaves, node);
    let whole = h(&topology, node).expect("closed");
    assert_eq!(
        violations(&topology, leaves.clone()),
        [Violation::HalfDiamond { split: node, whole }]
    );
    assert!(!Forest::with_leaves(&topology, 9, leaves).cracks().is_empty());
}

#[test]
fn a_step_of_two_levels_is_found_and_cracks() {
    let topology = meshes::house().topology();
    let mut leaves = uniform(&topology, 0);
    let root = Place::of_root(1, 0);
    let child = root.child(1);
    for node in [Some(root), h(&topology, root), Some(child), h(&topology, child)]
        .into_iter()
        .flatten()
    {
        split(&mut leaves, node);
    }
    let found = violations(&topology, leaves.clone());
    let unbalanced = |split: Place| Violation::Unbalanced {
        split,
        whole: across_outer_leg(&topology, split).expect("level 1"),
    };
    assert_eq!(found, [unbalanced(child), unbalanced(root.child(2))]);
    assert!(!Forest::with_leaves(&topology, 9, leaves).cracks().is_empty());
}

#[test]
fn a_pair_drawn_as_two_triangles_is_a_t_junction() {
    let topology = meshes::cube().topology();
    let root = Place::of_root(0, 0);
    let mut leaves = uniform(&topology, 0);
    split(&mut leaves, root);
    split(&mut leaves, h(&topology, root).expect("closed"));
    let forest = Forest::with_leaves(&topology, 9, leaves.clone());
    assert_eq!(forest.invariants(), []);
    assert_eq!(forest.cracks(), []);
    assert!(!cracks(&topology, leaves.iter().map(|leaf| leaf.corners())).is_empty());
}

#[test]
fn boundaries_are_no_cracks_but_what_lies_on_them_twice_is() {
    let topology = meshes::open().topology();
    let mut triangles: Vec<_> = uniform(&topology, 2).into_iter().map(Place::corners).collect();
    assert_eq!(cracks(&topology, triangles.clone()), []);
    triangles.push(triangles[0]);
    let found = cracks(&topology, triangles.clone());
    assert_eq!(found.len(), 3);
    assert!(found.iter().all(|crack| crack.forward + crack.backward >= 2));
    triangles.truncate(triangles.len() - 2);
    assert_eq!(
        cracks(&topology, triangles.clone())
            .iter()
            .filter(|crack| crack.is_boundary)
            .count(),
        0
    );
    let flat = triangles[0][0];
    triangles.push([flat; 3]);
    assert!(
        cracks(&topology, triangles)
            .iter()
            .any(|crack| crack.ends[0] == crack.ends[1])
    );
}
