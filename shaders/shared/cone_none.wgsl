// No normal cones are kept of leaves.
// requires: shared/place.wgsl

fn keep_cone(slot: u32, leaf: Place, digit: u32) {
}

fn move_cone(source: u32, home: u32) {
}
