use crate::{
    meshes,
    metrics::{Kind, Metric},
};
use keyleaf_key::{Forest, Place};
use std::collections::BTreeSet;
#[test]
fn diag() {
    let mut hist = std::collections::BTreeMap::new();
    let mut wrong = 0;
    let level: u32 = std::env::var("LV")
        .ok()
        .and_then(|v| v.parse().ok())
        .unwrap_or(4);
    for mesh in meshes::by_hand() {
        let topology = mesh.topology();
        for kind in [Kind::Random, Kind::Graded] {
            let mut forest = Forest::new(&topology, level);
            for seed in 0..12u64 {
                let m = Metric { kind, seed }.on(&topology);
                let mut last = 0;
                for i in 0..60 {
                    if forest.update(&m, usize::MAX).leaves_changed() > 0 {
                        last = i + 1
                    }
                }
                *hist.entry((format!("{kind:?}"), last)).or_insert(0) += 1;
                let l: BTreeSet<Place> = forest.leaves.keys().copied().collect();
                if l != forest.coarsest_balanced(&m) {
                    wrong += 1;
                }
            }
        }
    }
    println!("{hist:?} wrong {wrong}");
}
