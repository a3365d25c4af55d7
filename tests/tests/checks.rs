//! The checks can fail: each kind of damage to a good snapshot is found, and so are updates that lack a test.

use crate::snapshot::{Finding, findings, forest};
use crate::surfaces;
use crate::world::{EDGE, World, random_view, settings};
use crate::{meshes, random::Random};
use glam::{DVec3, UVec2};
use keyleaf::key::forest::Violation;
use keyleaf::key::neighbour::h;
use keyleaf::key::{Changes, Forest, Place};
use keyleaf::layout::{Leaf, state};
use keyleaf::read_back::Snapshot;
use keyleaf::surface::Surface;
use keyleaf::{Balance, Settings, View};
use std::collections::BTreeSet;
use std::sync::Arc;

fn house() -> Arc<dyn Surface> {
    surfaces::flat(&meshes::house())
}

fn near_view() -> View {
    View::look_at(
        DVec3::new(0.9, 1.0, 0.7),
        DVec3::new(0.5, 0.5, 0.3),
        1.0,
        1e-3,
        UVec2::new(400, 300),
    )
}

/// A good snapshot, settled, with pairs.
fn good() -> (Arc<dyn Surface>, Snapshot) {
    let surface = house();
    let snapshot = World::new(&surface, settings(EDGE)).passes(&near_view(), 20);
    assert_eq!(findings(surface.topology(), &snapshot), []);
    (surface, snapshot)
}

fn pair(snapshot: &Snapshot) -> usize {
    (0..snapshot.leaves.len())
        .find(|slot| snapshot.is_pair(*slot))
        .expect("some pair")
}

fn remove(snapshot: &mut Snapshot, slot: usize) {
    snapshot.leaves.remove(slot);
    snapshot.states.remove(slot);
}

#[test]
fn a_lost_a_doubled_and_a_foreign_leaf_are_found() {
    let (surface, snapshot) = good();
    let mut lost = snapshot.clone();
    remove(&mut lost, 7);
    let gap = Finding::Leaves(Violation::Gap(snapshot.leaves[7].place()));
    assert!(findings(surface.topology(), &lost).contains(&gap));

    let mut doubled = snapshot.clone();
    doubled.leaves.push(doubled.leaves[7]);
    doubled.states.push(doubled.states[7]);
    let twice = Finding::Leaves(Violation::Duplicate(snapshot.leaves[7].place()));
    assert!(findings(surface.topology(), &doubled).contains(&twice));

    let mut foreign = snapshot.clone();
    foreign.leaves[7].origin[0] += 1;
    let found = findings(surface.topology(), &foreign);
    assert!(
        found.contains(&Finding::Leaves(Violation::NotANode(foreign.leaves[7].place()))),
        "{found:?}"
    );
}

#[test]
fn half_a_split_diamond_is_found() {
    let (surface, mut snapshot) = good();
    let slot = (0..snapshot.leaves.len())
        .find(|slot| !snapshot.is_pair(*slot))
        .expect("not all are pairs");
    let place = snapshot.leaves[slot].place();
    let word = snapshot.states[slot];
    remove(&mut snapshot, slot);
    for child in place.children() {
        snapshot.leaves.push(Leaf::new(&child));
        snapshot.states.push(word & !state::PAIR);
    }
    let found = findings(surface.topology(), &snapshot);
    assert!(
        found
            .iter()
            .any(|f| matches!(f, Finding::Leaves(Violation::HalfDiamond { split, .. }) if *split == place)),
        "{found:?}"
    );
    assert!(found.iter().any(|f| matches!(f, Finding::Crack(_))), "{found:?}");
}

#[test]
fn a_pair_flag_too_few_and_one_too_many_are_found_and_crack() {
    let (surface, snapshot) = good();
    let other =
        (0..snapshot.leaves.len()).find(|slot| !snapshot.is_pair(*slot) && snapshot.leaves[*slot].place().level > 0);
    for slot in [Some(pair(&snapshot)), other].into_iter().flatten() {
        let mut broken = snapshot.clone();
        broken.states[slot] ^= state::PAIR;
        let found = findings(surface.topology(), &broken);
        let flag = Finding::Pair {
            place: snapshot.leaves[slot].place(),
            flag: broken.is_pair(slot),
        };
        assert!(found.contains(&flag), "{found:?}");
        assert!(found.iter().any(|f| matches!(f, Finding::Crack(_))), "{found:?}");
    }
}

#[test]
fn damage_to_keys_the_table_counters_and_the_visible_list_is_found() {
    let (surface, snapshot) = good();
    let broken = |damage: &dyn Fn(&mut Snapshot)| {
        let mut broken = snapshot.clone();
        damage(&mut broken);
        let found = findings(surface.topology(), &broken);
        assert_eq!(found.len(), 1, "{found:?}");
        found.into_iter().next()
    };
    let key = broken(&|s| s.leaves[3].key = s.leaves[3].place().parent().expect("not a root").key());
    assert!(matches!(key, Some(Finding::Key(_))), "{key:?}");
    let digit = broken(&|s| s.states[3] ^= 1 << state::DIGIT_SHIFT);
    assert!(matches!(digit, Some(Finding::Key(_))), "{digit:?}");
    let fresh = broken(&|s| s.states[3] |= state::FRESH);
    assert!(matches!(fresh, Some(Finding::Unpublished(_))), "{fresh:?}");
    let entry = broken(&|s| s.table[s.leaves[3].entry as usize] ^= 1);
    assert!(matches!(entry, Some(Finding::Unreachable(_))), "{entry:?}");
    let ghost = broken(&|s| {
        let free = s.table.iter().position(|word| *word == 0).expect("half is free");
        s.table[free] = 1;
    });
    assert!(matches!(ghost, Some(Finding::Entries { .. })), "{ghost:?}");
    let lost = broken(&|s| s.control.lost = 1);
    assert!(matches!(lost, Some(Finding::Counters { .. })), "{lost:?}");
    let twice = broken(&|s| s.visible.push(s.visible[0]));
    assert!(matches!(twice, Some(Finding::Drawn { .. })), "{twice:?}");
    let hidden = broken(&|s| {
        let odd = (0..s.leaves.len()).find(|slot| s.is_pair(*slot) && s.leaves[*slot].place().is_odd_half());
        s.visible.push(odd.expect("some pair") as u32);
    });
    assert!(matches!(hidden, Some(Finding::Drawn { .. })), "{hidden:?}");
}

#[test]
fn the_update_without_neighbour_test_cracks_on_the_gpu() {
    let surface = house();
    let mut world = World::new(
        &surface,
        Settings {
            balance: Balance::Off,
            ..settings(EDGE)
        },
    );
    let snapshot = world.passes(&near_view(), 12);
    let found = findings(surface.topology(), &snapshot);
    for what in ["Crack", "Pair"] {
        assert!(
            found.iter().any(|finding| format!("{finding:?}").contains(what)),
            "no {what} among {} findings",
            found.len()
        );
    }
}

/// Decides by random wishes on leaf sets that the GPU held, with a fault. Returns whether leaves or triangles are found wrong.
fn is_caught(fault: impl Fn(&Forest<'_>, &mut Changes)) -> bool {
    let surface = house();
    let topology = surface.topology();
    let mut world = World::new(&surface, settings(EDGE));
    let mut random = Random(2);
    for _ in 0..4 {
        let mut twin = forest(topology, &world.passes(&random_view(&mut random, surface.as_ref()), 8));
        let willing: BTreeSet<Place> = twin
            .leaves
            .keys()
            .filter_map(|leaf| leaf.parent())
            .filter(|_| random.below(3) > 0)
            .collect();
        for (leaf, published) in &mut twin.leaves {
            published.wish = random.pick(&[0.5, 0.5, 2.0]);
            published.merge = leaf.parent().is_some_and(|parent| willing.contains(&parent));
        }
        let mut changes = twin.decide(usize::MAX);
        fault(&twin, &mut changes);
        twin.apply(changes);
        if !twin.invariants().is_empty() || !twin.cracks().is_empty() {
            return true;
        }
    }
    false
}

#[test]
fn updates_with_a_deliberate_fault_are_caught() {
    assert!(
        !is_caught(|_, _| ()),
        "the right decisions are good, whatever is published"
    );
    let wants =
        |forest: &Forest<'_>, leaf: &Place| forest.leaves.get(leaf).is_some_and(|published| published.wish > 1.0);
    let splits = |forest: &Forest<'_>, may: &dyn Fn(&Place) -> bool| -> Vec<Place> {
        forest
            .leaves
            .keys()
            .filter(|leaf| wants(forest, leaf) && may(leaf))
            .copied()
            .collect()
    };
    let unblocked = |forest: &Forest<'_>, changes: &mut Changes| {
        let both_want = |leaf: &Place| h(forest.topology(), *leaf).is_none_or(|other| wants(forest, &other));
        changes.splits = splits(forest, &both_want);
    };
    assert!(is_caught(unblocked), "without the blocked test");
    let one_sided = |forest: &Forest<'_>, changes: &mut Changes| {
        changes.splits = splits(forest, &|leaf| !forest.is_blocked(*leaf));
    };
    assert!(is_caught(one_sided), "without asking the other half of the diamond");
    let eager = |forest: &Forest<'_>, changes: &mut Changes| {
        let is_ready = |parent: &Place| {
            let may_go = |child: &Place| {
                forest
                    .leaves
                    .get(child)
                    .is_some_and(|published| published.merge && published.wish <= 1.0)
            };
            parent.children().iter().all(may_go)
        };
        let parents: BTreeSet<Place> = forest
            .leaves
            .keys()
            .filter_map(|leaf| leaf.parent())
            .filter(is_ready)
            .collect();
        changes.merges = parents.into_iter().collect();
    };
    assert!(is_caught(eager), "merges that look at no neighbour");
    let forgetful =
        |_: &Forest<'_>, changes: &mut Changes| drop(changes.splits.split_off(changes.splits.len().saturating_sub(1)));
    assert!(is_caught(forgetful), "a record that is lost");
}
