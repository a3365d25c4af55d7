// What a leaf keeps of its pair moves with it.

fn move_pair(source: u32, home: u32) {
    parents[frame.pairs + home] = parents[frame.pairs + source];
}
