//! A record as a run might leave it, for tests.

use crate::run::{BufferBytes, Clock, Device, PassRecord, RunRecord, SceneRun, Series, Tool};

const FRAMES: usize = 120;

/// Numbers between 0 and 1 that look random.
fn noise(i: usize) -> f64 {
    ((i as f64 * 12.9898).sin() * 43758.5453).rem_euclid(1.0)
}

/// A run whose draw takes `slower` times as long, with noise of its own.
pub(crate) fn record(slower: f64, seed: usize) -> RunRecord {
    let cost = |i: usize| 2.0 + (i as f64 / 20.0).sin();
    let series = |factor: f64, seed: usize| {
        let sample = |i: usize| factor * cost(i) * (1.0 + 0.1 * noise(i + seed));
        // To a nanosecond, as clocks do: such numbers survive JSON.
        Series::new((0..FRAMES).map(|i| (sample(i) * 1e6).round() / 1e6))
    };
    let count = |factor: f64| Series::new((0..FRAMES).map(|i| (factor * cost(i)).floor()));
    let tool = Tool {
        version: "0.1.0".to_owned(),
        commit: "1234567".to_owned(),
        profile: "release".to_owned(),
    };
    let device = Device {
        name: "A device".to_owned(),
        driver: "a driver 1.2".to_owned(),
        backend: "vulkan".to_owned(),
        kind: "discrete GPU".to_owned(),
        cores: 8,
        ..Device::default()
    };
    let mut record = RunRecord::new(tool, device, [1280, 720], 30);
    record.runs.push(SceneRun {
        scene: "torus".to_owned(),
        file: "scenes/torus.ron".to_owned(),
        path: "flight".to_owned(),
        variant: String::new(),
        settings: [("metric".to_owned(), "edge 4 px".to_owned())].into(),
        frames: FRAMES,
        clock: Clock::Timestamps,
        passes: vec![
            PassRecord::new("update", series(0.1, seed)),
            PassRecord::new("draw", series(0.3 * slower, seed + 7)),
        ],
        leaves: count(10_000.0),
        visible: count(6_000.0),
        triangles: count(96_000.0),
        splits: count(30.0),
        merges: count(20.0),
        starved: Series::new([0.0; FRAMES]),
        record_ms: series(0.02, seed + 1),
        cpu_ms: series(0.2, seed + 2),
        wall_ms: series(0.6, seed + 3),
        memory: vec![BufferBytes {
            surface: "torus".to_owned(),
            buffer: "leaves".to_owned(),
            bytes: 1 << 20,
        }],
        figures: Default::default(),
    });
    record
}
