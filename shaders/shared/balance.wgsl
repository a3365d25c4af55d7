// Who publishes merge: child 0 speaks for its siblings.

fn publishes_merge(digit: u32) -> bool {
    return digit == 0u;
}
