//! How long the probes of the leaf table are.

use crate::world::{World, settings};
use crate::{meshes, surfaces};
use glam::{DVec3, UVec2};
use keyleaf::layout::table_entries;
use keyleaf::{Metric, Settings, View};

/// A look-up of a node that is no leaf probes to the next empty entry: on the mean (1 + 1 / (1 - load)²) / 2 entries with a random
/// hash (Knuth, The Art of Computer Programming 3, 6.4). Leaves of one level differ in few bits only, on flat meshes above all.
#[test]
fn probes_are_hardly_longer_than_those_of_a_random_hash() {
    let surface = surfaces::flat(&meshes::cube());
    let view = View::look_at(DVec3::new(0.3, 0.9, 3.5), DVec3::ZERO, 1.0, 0.01, UVec2::new(1280, 720));
    let capacity = 60_000;
    for pixels in [24.0, 12.0, 6.0] {
        let settings = Settings {
            capacity,
            ..settings(Metric::Edge { pixels })
        };
        let snapshot = World::new(&surface, settings).passes(&view, 12);
        let entries = table_entries(capacity) as usize;
        assert_eq!(snapshot.table.len(), entries);
        // From every entry, how many are probed until an empty one: the table is a ring.
        let (mut run, mut probes) = (0u64, 0u64);
        for i in (0..2 * entries).rev() {
            run = if snapshot.table[i % entries] == 0 { 1 } else { run + 1 };
            if i < entries {
                probes += run;
            }
        }
        let used = snapshot.table.iter().filter(|entry| **entry != 0).count();
        let load = used as f64 / entries as f64;
        let expected = 0.5 * (1.0 + (1.0 - load).powi(-2));
        let mean = probes as f64 / entries as f64;
        println!(
            "{} leaves, load {load:.3}: {mean:.3} probes, expected {expected:.3}",
            snapshot.control.leaves
        );
        assert!(mean < 1.1 * expected + 0.05, "{mean} probes, expected {expected}");
    }
}
