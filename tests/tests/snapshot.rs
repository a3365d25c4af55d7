//! What can be wrong with what the GPU holds after a pass. All in integers: nothing is evaluated here.

use keyleaf::key::forest::{Crack, Violation, cracks, violations};
use keyleaf::key::neighbour::about_right_angle;
use keyleaf::key::{Forest, Place, Published, Topology};
use keyleaf::layout::{Leaf, place_hash, state};
use keyleaf::read_back::Snapshot;
use std::collections::{BTreeMap, BTreeSet};

/// One thing that is wrong.
#[derive(Debug, Clone, PartialEq)]
pub enum Finding {
    /// The leaves do not cover the roots once, or break (I1) or (I2).
    Leaves(Violation),
    /// The triangles that are drawn by the GPU's flags do not match.
    Crack(Crack),
    /// Key, decoded place and digit of a slot differ.
    Key(Leaf),
    /// The pair flag does not say whether C(n) is a leaf, or a free leaf does not agree with the others about its right angle.
    Pair { place: Place, flag: bool },
    /// The flag does not say whether the four nodes about the right angle are leaves.
    Free { place: Place, flag: bool },
    /// A leaf has not published.
    Unpublished(Place),
    /// A leaf is not where the table says, or not on the way of its hash.
    Unreachable(Place),
    /// Entries of the table that are neither empty nor tombstones.
    Entries { live: usize, leaves: usize },
    /// Counters that cannot be.
    Counters {
        lost: u32,
        leaves: u32,
        capacity: u32,
        entries_used: u32,
    },
    /// A slot is drawn twice, or is hidden or free.
    Drawn { slot: u32 },
}

const SLOT_MASK: u32 = 0x00ff_ffff;
const TOMBSTONE: u32 = SLOT_MASK;

/// Everything that is wrong, nothing after any pass.
pub fn findings(topology: &Topology, snapshot: &Snapshot) -> Vec<Finding> {
    let leaves: Vec<Place> = snapshot.leaves.iter().map(Leaf::place).collect();
    let mut found: Vec<Finding> = violations(topology, leaves.iter().copied())
        .into_iter()
        .map(Finding::Leaves)
        .collect();
    if found
        .iter()
        .any(|f| matches!(f, Finding::Leaves(Violation::NotANode(_))))
    {
        return found; // has no neighbours
    }
    let drawn = (0..leaves.len()).filter_map(|slot| leaves[slot].drawn(snapshot.is_pair(slot)));
    found.extend(cracks(topology, drawn).into_iter().map(Finding::Crack));
    let forest = Forest::with_leaves(topology, 31, leaves.iter().copied());
    let slots = 0..leaves.len();
    let pairs: BTreeMap<Place, bool> = slots.map(|slot| (leaves[slot], snapshot.is_pair(slot))).collect();
    for ((leaf, place), word) in snapshot.leaves.iter().zip(&leaves).zip(&snapshot.states) {
        if leaf.key != place.key() || state::digit(*word) != state::digit_of(*place) {
            found.push(Finding::Key(*leaf));
        }
        let (pair, free) = (word & state::PAIR != 0, word & state::FREE != 0);
        if free != forest.is_free(*place) {
            found.push(Finding::Free {
                place: *place,
                flag: free,
            });
        }
        let about = about_right_angle(topology, *place).filter(|_| free);
        let as_others = |nodes: [Place; 4]| nodes.iter().all(|node| pairs.get(node) == Some(&pair));
        if !about.map_or(pair == forest.is_blocked(*place), as_others) {
            found.push(Finding::Pair {
                place: *place,
                flag: pair,
            });
        }
        if word & state::FRESH != 0 {
            found.push(Finding::Unpublished(*place));
        }
    }
    found.extend(table_findings(snapshot, &leaves));
    found.extend(drawn_findings(snapshot, &leaves));
    let (control, capacity) = (&snapshot.control, snapshot.statistics.capacity);
    if control.lost > 0 || control.leaves > capacity || control.entries_used as usize > snapshot.table.len() {
        let (lost, leaves, entries_used) = (control.lost, control.leaves, control.entries_used);
        found.push(Finding::Counters {
            lost,
            leaves,
            capacity,
            entries_used,
        });
    }
    found
}

/// The table holds every leaf once, reachable from its hash, and nothing else. Twin of `table_find.wgsl`.
fn table_findings(snapshot: &Snapshot, leaves: &[Place]) -> Vec<Finding> {
    let mask = snapshot.table.len() - 1;
    let mut found = Vec::new();
    for (slot, place) in leaves.iter().enumerate() {
        let hash = place_hash(place);
        let mut entry = hash as usize & mask;
        let reached = loop {
            match snapshot.table[entry] {
                0 => break false,
                word if word == (hash & !SLOT_MASK) | (slot as u32 + 1) => {
                    break entry == snapshot.leaves[slot].entry as usize;
                }
                _ => entry = (entry + 1) & mask,
            }
        };
        if !reached {
            found.push(Finding::Unreachable(*place));
        }
    }
    let live = snapshot
        .table
        .iter()
        .filter(|word| **word != 0 && **word & SLOT_MASK != TOMBSTONE)
        .count();
    if live != leaves.len() {
        found.push(Finding::Entries {
            live,
            leaves: leaves.len(),
        });
    }
    found
}

fn drawn_findings(snapshot: &Snapshot, leaves: &[Place]) -> Vec<Finding> {
    let mut seen = BTreeSet::new();
    let mut found = Vec::new();
    for &slot in &snapshot.visible {
        let place = leaves.get(slot as usize);
        let is_drawn = place.is_some_and(|place| place.drawn(snapshot.is_pair(slot as usize)).is_some());
        if !is_drawn || !seen.insert(slot) {
            found.push(Finding::Drawn { slot });
        }
    }
    found
}

/// The slots that have a triangle: all but the odd halves of pairs.
pub fn drawn_slots(snapshot: &Snapshot) -> Vec<u32> {
    let is_drawn = |slot: &u32| {
        snapshot.leaves[*slot as usize]
            .place()
            .drawn(snapshot.is_pair(*slot as usize))
            .is_some()
    };
    (0..snapshot.leaves.len() as u32).filter(is_drawn).collect()
}

/// The CPU twin in the state that the GPU published.
pub fn forest<'t>(topology: &'t Topology, snapshot: &Snapshot) -> Forest<'t> {
    let states: BTreeMap<Place, u32> = snapshot
        .leaves
        .iter()
        .map(Leaf::place)
        .zip(snapshot.states.iter().copied())
        .collect();
    let mut forest = Forest::with_leaves(topology, 31, states.keys().copied());
    for (place, published) in &mut forest.leaves {
        // Child 0 speaks for its siblings; each of them says for itself that it has been there for a pass.
        let leader = place.parent().and_then(|parent| states.get(&parent.child(0)));
        let says_merge = leader.is_some_and(|word| word & state::MERGE != 0);
        let word = states[place];
        *published = Published {
            wish: state::wish(word),
            merge: says_merge && word & state::MATURE != 0,
        };
    }
    forest
}
