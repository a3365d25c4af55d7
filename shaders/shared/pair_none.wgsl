// Nothing is kept of pairs that need not be.
// requires: shared/place.wgsl

fn keep_pair(slot: u32, leaf: Place, digit: u32) {
}

fn move_pair(source: u32, home: u32) {
}
