//! Places and keys to level 31.

use crate::meshes;
use keyleaf_key::{Key, MAX_LEVEL, ONE, Place, Site, neighbour};
use proptest::prelude::*;
use std::collections::BTreeSet;

/// Base-4 digits of a node of any level, as often deep as not.
pub fn digits() -> impl Strategy<Value = Vec<u32>> {
    prop::collection::vec(0..4_u32, 0..=MAX_LEVEL as usize)
}

proptest! {
    #[test]
    fn places_and_keys_are_in_bijection_at_every_level(digits in digits(), face: u32, root in 0..65_535_u32) {
        let place = digits.iter().copied().fold(Place::of_root(face, root), Place::child);
        let key = digits.iter().copied().fold(Key::of_root(face, root), Key::child);
        prop_assert_eq!(place.key(), key);
        prop_assert_eq!(key.place(), Ok(place));
        prop_assert_eq!(key.digits().collect::<Vec<_>>(), digits);
        prop_assert_eq!((place.level, place.digit()), (key.level(), key.digit()));
        prop_assert_eq!(place.parent().map(Place::key), key.parent());
        prop_assert!(place.is_valid());
    }

    #[test]
    fn a_leaf_lies_in_its_root_and_has_three_distinct_corners_one_unit_apart(digits in digits()) {
        let place = digits.iter().copied().fold(Place::of_root(0, 0), Place::child);
        let [o, r, u] = place.corners();
        for corner in [o, r, u] {
            prop_assert!(corner.x <= ONE && corner.y <= ONE - corner.x);
        }
        prop_assert_eq!(o.x.abs_diff(r.x) + o.y.abs_diff(r.y), place.unit());
        prop_assert_eq!(o.x.abs_diff(u.x) + o.y.abs_diff(u.y), place.unit());
        prop_assert_eq!(r.x.abs_diff(u.x), r.y.abs_diff(u.y));
        prop_assert!(place.unit() > 0);
    }

    #[test]
    fn a_diamond_has_four_distinct_corners_at_every_level(mesh in meshes::random(), digits in digits(), pick: u16) {
        let topology = mesh.topology();
        let roots: Vec<_> = topology.roots().collect();
        let node = digits.into_iter().fold(roots[usize::from(pick) % roots.len()], Place::child);
        for half in std::iter::once(node).chain(neighbour::h(&topology, node)) {
            let corners: BTreeSet<_> = half.corners().map(|point| Site::of(&topology, point)).into();
            prop_assert_eq!(corners.len(), 3);
        }
        if let Some(other) = neighbour::h(&topology, node) {
            let all = node.corners().into_iter().chain(other.corners());
            prop_assert_eq!(all.map(|point| Site::of(&topology, point)).collect::<BTreeSet<_>>().len(), 4);
        }
    }
}
