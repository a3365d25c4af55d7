// Nothing is kept of pairs that need not be.
// requires: shared/place.wgsl

const ROOTS_MAY_BE_PAIRS: bool = false;

fn keep_pair(slot: u32, leaf: Place, digit: u32) {
}

fn move_pair(source: u32, home: u32) {
}
