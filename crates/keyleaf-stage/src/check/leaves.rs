//! Keys, the partition of the roots, the invariants, flags and lists.

use super::weld::{QuickMap, place_number};
use super::{FindingKind, Findings};
use keyleaf::key::forest::{Violation, violations};
use keyleaf::key::neighbour::{about_right_angle, across_outer_leg};
use keyleaf::key::{Place, Topology};
use keyleaf::layout::{Leaf, state};
use keyleaf::read_back::Snapshot;
use keyleaf::{Balance, Settings};

/// The leaves of a snapshot that are nodes of the mesh.
pub(super) struct Leaves {
    /// By slot; `None` where the words are no node.
    pub places: Vec<Option<Place>>,
    /// Slots that make triangles: all but the odd halves of pairs.
    pub drawn: Vec<u32>,
    /// By slot: whether it is drawn as half of a pair. Never of a root that is none, whatever its flag says.
    pub pairs: Vec<bool>,
    /// By slot: whether it is in the draw list.
    pub visible: Vec<bool>,
}

/// The place that the GPU draws a leaf at, if that is a node of the mesh.
fn node(topology: &Topology, leaf: &Leaf) -> Option<Place> {
    Some(leaf.place()).filter(|place| topology.has_root(place.face, place.root) && place.is_valid())
}

/// Checks everything about leaves that needs no vertices.
pub(super) fn check(topology: &Topology, snapshot: &Snapshot, settings: &Settings, findings: &mut Findings) -> Leaves {
    counters(snapshot, settings, findings);
    let places: Vec<Option<Place>> = snapshot.leaves.iter().map(|leaf| node(topology, leaf)).collect();
    for (slot, (leaf, place)) in snapshot.leaves.iter().zip(&places).enumerate() {
        if place.is_none() {
            findings.add(FindingKind::Key, [], || {
                format!("slot {slot} is no node of the mesh: {leaf:?}")
            });
        } else if leaf.key.place().ok() != *place {
            findings.add(FindingKind::Key, [leaf.key], || {
                format!("slot {slot} is decoded as {place:?}")
            });
        }
    }
    partition(topology, &places, settings, findings);
    states(topology, snapshot, &places, settings, findings);
    let may_be_pair = |place: &Option<Place>| place.is_some_and(|place| about_right_angle(topology, place).is_some());
    let pairs: Vec<bool> = (0..)
        .zip(&places)
        .map(|(slot, place)| snapshot.is_pair(slot) && may_be_pair(place))
        .collect();
    let drawn: Vec<u32> = (0..places.len() as u32)
        .filter(|&slot| {
            let odd = places[slot as usize].map(Place::is_odd_half);
            odd.is_some_and(|odd| !(odd && pairs[slot as usize]))
        })
        .collect();
    let visible = draw_list(snapshot, &drawn, settings, findings);
    Leaves {
        places,
        drawn,
        pairs,
        visible,
    }
}

fn counters(snapshot: &Snapshot, settings: &Settings, findings: &mut Findings) {
    let control = &snapshot.control;
    let mut wrong = |holds: bool, text: &dyn Fn() -> String| {
        if !holds {
            findings.add(FindingKind::Counter, [], text);
        }
    };
    wrong(control.lost == 0, &|| {
        format!(
            "{} look-ups failed although the invariants promise a leaf",
            control.lost
        )
    });
    wrong(control.leaves <= settings.capacity, &|| {
        format!("{} leaves in buffers for {}", control.leaves, settings.capacity)
    });
}

/// Whether the leaves cover every root exactly once and keep the invariants.
fn partition(topology: &Topology, places: &[Option<Place>], settings: &Settings, findings: &mut Findings) {
    for violation in violations(topology, places.iter().flatten().copied()) {
        use FindingKind as K;
        let (kind, nodes, text) = match violation {
            Violation::NotANode(place) => (K::Key, vec![place], "is no node of the mesh"),
            Violation::Duplicate(place) => (K::DuplicateLeaf, vec![place], "is there more than once"),
            Violation::Overlap(place) => (K::Overlap, vec![place], "is a leaf and has leaves inside it"),
            Violation::Gap(place) => (K::LostLeaf, vec![place], "is covered by no leaf"),
            Violation::HalfDiamond { .. } | Violation::Unbalanced { .. } if settings.balance == Balance::Off => {
                continue;
            }
            Violation::HalfDiamond { split, whole } => (
                K::HalfDiamond,
                vec![split, whole],
                "is split, but not the other half of its diamond",
            ),
            Violation::Unbalanced { split, whole } => (
                K::Unbalanced,
                vec![split, whole],
                "is split, but not the larger node across its outer leg",
            ),
        };
        findings.add(kind, nodes.iter().map(|place| place.key()), || {
            format!("the first {text}")
        });
    }
}

/// Digits and pair flags.
fn states(
    topology: &Topology,
    snapshot: &Snapshot,
    places: &[Option<Place>],
    settings: &Settings,
    findings: &mut Findings,
) {
    let there: QuickMap<u128, usize> = (0..)
        .zip(places)
        .filter_map(|(slot, place)| Some((place_number(topology, (*place)?), slot)))
        .collect();
    let slot_of = |place: Place| there.get(&place_number(topology, place)).copied();
    for (slot, place) in places.iter().enumerate() {
        let Some(place) = *place else { continue };
        let word = snapshot.states[slot];
        let digit = state::digit_of(place);
        if state::digit(word) != digit {
            findings.add(FindingKind::State, [place.key()], || {
                format!("slot {slot} says digit {}, the key says {digit}", state::digit(word))
            });
        }
        if settings.balance == Balance::Off {
            continue;
        }
        let about = about_right_angle(topology, place);
        let about = about.and_then(|nodes| {
            Some([
                slot_of(nodes[0])?,
                slot_of(nodes[1])?,
                slot_of(nodes[2])?,
                slot_of(nodes[3])?,
            ])
        });
        if snapshot.is_free(slot) != about.is_some() {
            findings.add(FindingKind::State, [place.key()], || {
                let (are, flag) = if about.is_some() {
                    ("are", "not set")
                } else {
                    ("are not", "set")
                };
                format!("the four nodes about the right angle {are} leaves, and the flag is {flag}")
            });
        }
        let larger = across_outer_leg(topology, place);
        let is_blocked = larger.is_some_and(|larger| slot_of(larger).is_some());
        let is_pair = snapshot.is_pair(slot);
        if about.is_none() && is_pair != is_blocked {
            let keys = [Some(place), larger].into_iter().flatten().map(Place::key);
            findings.add(FindingKind::PairFlag, keys, || {
                let (across, flag) = if is_blocked { ("a", "not set") } else { ("no", "set") };
                format!("there is {across} leaf across the outer leg, and the flag is {flag}")
            });
        }
        let other = about
            .into_iter()
            .flatten()
            .find(|&other| snapshot.is_pair(other) != is_pair);
        if let Some(other) = other.and_then(|other| places[other]) {
            findings.add(FindingKind::PairFlag, [place.key(), other.key()], || {
                "of the leaves about a right angle some are drawn as pairs, some are not".to_owned()
            });
        }
    }
}

/// Whether the draw list names slots that are drawn, each once, and all of them if nothing is culled.
fn draw_list(snapshot: &Snapshot, drawn: &[u32], settings: &Settings, findings: &mut Findings) -> Vec<bool> {
    let mut is_drawn = vec![false; snapshot.leaves.len()];
    drawn.iter().for_each(|&slot| is_drawn[slot as usize] = true);
    let mut visible = vec![false; snapshot.leaves.len()];
    for &slot in &snapshot.visible {
        let Some(listed) = visible.get_mut(slot as usize) else {
            findings.add(FindingKind::DrawList, [], || {
                format!("slot {slot} is drawn, behind the last leaf")
            });
            continue;
        };
        let key = [snapshot.leaves[slot as usize].key];
        if std::mem::replace(listed, true) {
            findings.add(FindingKind::DrawList, key, || format!("slot {slot} is drawn twice"));
        } else if !is_drawn[slot as usize] {
            findings.add(FindingKind::DrawList, key, || {
                format!("slot {slot} is drawn, the odd half of a pair")
            });
        }
    }
    if !settings.cull {
        for slot in drawn.iter().copied().filter(|&slot| !visible[slot as usize]) {
            let key = [snapshot.leaves[slot as usize].key];
            findings.add(FindingKind::DrawList, key, || {
                format!("slot {slot} is not drawn, and nothing is culled")
            });
        }
    }
    visible
}
