// The normal cone of a leaf moves with it.

fn move_cone(source: u32, home: u32) {
    parents[frame.capacity + home] = parents[frame.capacity + source];
}
