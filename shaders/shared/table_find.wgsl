// Looking up; for the passes that do not change the table.
// requires: shared/table.wgsl

// The slot of a leaf, or NONE if the node is not a leaf.
fn find_leaf(p: Place) -> u32 {
    if p.face == NONE {
        return NONE;
    }
    let hash = place_hash(p);
    var entry = hash & frame.table_mask;
    var found = NONE;
    loop {
        let word = table[entry];
        if word == EMPTY {
            break;
        }
        if ((word ^ hash) & ~SLOT_MASK) == 0u && (word & SLOT_MASK) != TOMBSTONE {
            let slot = (word & SLOT_MASK) - 1u;
            if leaves[slot].x == p.x && leaves[slot].y == p.y && leaves[slot].face == p.face && leaves[slot].root == p.root
                && leaves[slot].orientation_level == (p.orientation | (p.level << 8u)) {
                found = slot;
                break;
            }
        }
        entry = (entry + 1u) & frame.table_mask;
    }
    return found;
}
