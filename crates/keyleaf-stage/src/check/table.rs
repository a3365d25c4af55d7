//! The leaf table: open addressing with linear probing, one word an entry (`shaders/shared/table.wgsl`).

use super::{FindingKind, Findings};
use keyleaf::layout::{NO_ENTRY, place_hash};
use keyleaf::read_back::Snapshot;

const EMPTY: u32 = 0;
const SLOT_MASK: u32 = 0x00ff_ffff;
const TOMBSTONE: u32 = SLOT_MASK;

/// Every entry belongs to a leaf, and every leaf is found.
pub(super) fn check(snapshot: &Snapshot, findings: &mut Findings) {
    let table = &snapshot.table;
    let mask = table.len().wrapping_sub(1);
    if !table.len().is_power_of_two() {
        findings.add(FindingKind::Table, [], || {
            format!("the table has {} entries, no power of two", table.len())
        });
        return;
    }
    let mut used = 0;
    for (entry, &word) in table.iter().enumerate().filter(|(_, word)| **word != EMPTY) {
        used += 1;
        let slot = (word & SLOT_MASK).wrapping_sub(1) as usize;
        if word & SLOT_MASK == TOMBSTONE {
            continue;
        }
        if snapshot
            .leaves
            .get(slot)
            .is_none_or(|leaf| leaf.entry as usize != entry)
        {
            findings.add(FindingKind::Table, [], || {
                format!("entry {entry} names slot {slot}, which does not name it")
            });
        }
    }
    if (snapshot.control.entries_used as usize) < used {
        let counted = snapshot.control.entries_used;
        findings.add(FindingKind::Table, [], || {
            format!("{used} entries are in use, {counted} are counted")
        });
    }
    for (slot, leaf) in snapshot.leaves.iter().enumerate() {
        let hash = place_hash(&leaf.place());
        let expected = (hash & !SLOT_MASK) | (slot as u32 + 1);
        let entry = leaf.entry as usize;
        if leaf.entry == NO_ENTRY || table.get(entry) != Some(&expected) {
            findings.add(FindingKind::Table, [leaf.key], || {
                format!(
                    "slot {slot} says that entry {entry} is its own, which holds {:?}",
                    table.get(entry)
                )
            });
            continue;
        }
        // A probe starts at the hash and ends at the first empty entry.
        let home = hash as usize & mask;
        let distance = entry.wrapping_sub(home) & mask;
        if (0..distance).any(|i| table[(home + i) & mask] == EMPTY) {
            findings.add(FindingKind::Table, [leaf.key], || {
                format!("no probe reaches slot {slot} in entry {entry}")
            });
        }
    }
}

/// Enters leaves as the GPU does.
#[cfg(test)]
pub(super) fn fill(table: &mut [u32], leaves: &mut [keyleaf::layout::Leaf]) {
    let mask = table.len() - 1;
    for (slot, leaf) in leaves.iter_mut().enumerate() {
        let hash = place_hash(&leaf.place());
        let mut entry = hash as usize & mask;
        while table[entry] != EMPTY {
            entry = (entry + 1) & mask;
        }
        table[entry] = (hash & !SLOT_MASK) | (slot as u32 + 1);
        leaf.entry = entry as u32;
    }
}
