// The leaf table: open addressing, linear probing, one word an entry: slot + 1 and an 8-bit tag of the hash. "Is this node a leaf,
// and where?" Keys are unique, so that an insertion takes the first free entry by one compare-exchange and compares nothing.
// The first four words of a leaf's decoded form are compared, not the key: both are the same information.
// requires: shared/place.wgsl, shared/leaf.wgsl, shared/control.wgsl, shared/frame.wgsl

const EMPTY: u32 = 0u;
const TOMBSTONE: u32 = 0x00ffffffu; // no slot has this number: capacities end at 2^24 - 2
const SLOT_MASK: u32 = 0x00ffffffu;

// Multiply and xor-shift (the finaliser of MurmurHash3) over the words of a place. Coarse places differ in the highest bits of x and
// y alone, which a multiplication would push out: they are folded down first.
fn place_hash(p: Place) -> u32 {
    var h = (p.x ^ (p.x >> 16u)) * 0x9e3779b1u;
    h = (h ^ (h >> 15u) ^ p.y ^ (p.y >> 16u)) * 0x85ebca77u;
    h = (h ^ (h >> 16u)) + p.face * 0xc2b2ae3du + ((p.root << 7u) | (p.level << 2u) | p.orientation);
    h = (h ^ (h >> 15u)) * 0x2c1b3c6du;
    h = (h ^ (h >> 13u)) * 0xc2b2ae35u;
    return h ^ (h >> 16u);
}

fn entry_word(hash: u32, slot: u32) -> u32 {
    return (hash & 0xff000000u) | (slot + 1u);
}
