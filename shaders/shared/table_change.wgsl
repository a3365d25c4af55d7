// Entering and leaving; for the passes that do not look up. The table always has empty entries (`copy` sees to it), so that every
// probe ends.
// requires: shared/table.wgsl

// Returns the entry.
fn insert_leaf(p: Place, slot: u32) -> u32 {
    let hash = place_hash(p);
    let word = entry_word(hash, slot);
    var entry = hash & frame.table_mask;
    loop {
        let seen = atomicLoad(&table[entry]);
        if seen != EMPTY && seen != TOMBSTONE {
            entry = (entry + 1u) & frame.table_mask;
            continue;
        }
        // Tried again at the same entry if somebody was faster, or the exchange failed for no reason.
        if atomicCompareExchangeWeak(&table[entry], seen, word).exchanged {
            if seen == EMPTY {
                atomicAdd(&control.entries_used, 1u);
            }
            break;
        }
    }
    return entry;
}

fn remove_leaf(entry: u32) {
    atomicStore(&table[entry], TOMBSTONE);
}
