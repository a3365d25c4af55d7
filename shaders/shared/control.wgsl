// What the passes tell each other; one buffer a quadtree. Rust: keyleaf `quadtree::layout::Control`; a test compares the offsets.

struct Control {
    leaves: u32,             // live leaves = slots in use, after compaction
    allocated: atomic<u32>,  // slots in use while changes are applied: leaves + 3 a split half
    visible: atomic<u32>,
    splitters: atomic<u32>,  // leaves that want to split
    changes: atomic<u32>,    // records: one a half of a diamond
    splits: atomic<u32>,     // halves of diamonds split by the present changes
    merges: atomic<u32>,
    freed: atomic<u32>,
    sources: atomic<u32>,    // of moves
    targets: atomic<u32>,
    requests: atomic<u32>,   // raised by `decide_splits`, folded in by `update`
    lowest_bucket: u32,      // admitted; BUCKETS: none
    pressure: i32,           // sixteenths of an octave by which the threshold is raised
    idle: u32,               // passes without a change
    entries_used: atomic<u32>, // entries of the table that are not empty
    rebuilds: u32,           // of the table, since the start
    unmet: u32,              // leaves that wish to split, as last published
    starved: u32,            // of those, the ones that do not fit
    passes: u32,             // since the start
    lost: atomic<u32>,       // look-ups that failed although the invariants promise a leaf: 0 in a correct program
    last_splits: u32,        // of the last pass, for statistics
    last_merges: u32,
    near: atomic<u32>,       // wishes that the next lower step of pressure would turn into splits
    since_step: u32,         // passes since the pressure changed
    failed: i32,             // pressure at which wishes did not fit in the present view; -1: none
    view_serial: u32,        // of the view that `failed` is of
    mergers: atomic<u32>,    // leaves that speak for a parent that is satisfied
    wishes: array<atomic<u32>, 32>, // by bucket
}
