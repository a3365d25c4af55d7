// Who publishes merge when neighbours are not looked at: every leaf for itself.

fn publishes_merge(digit: u32) -> bool {
    return digit < 4u;
}
