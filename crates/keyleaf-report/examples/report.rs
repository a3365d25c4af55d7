//! A report from made-up numbers, to look at: `cargo run -p keyleaf-report --example report -- FOLDER` writes `report.html`, `report.csv`
//! and every figure by itself.

use keyleaf_report::error::Measure;
use keyleaf_report::picture::PictureError;
use keyleaf_report::report::{Errors, GrowthPoint, PassTime, Point, Report, SceneReport};
use keyleaf_report::run::{Clock, Device, Tool};
use keyleaf_report::scaling::{CostModel, device_classes, scaling};
use keyleaf_report::statistics::Interval;
use keyleaf_report::{html, svg};
use std::path::PathBuf;

/// A way to refine: its name, triangles at 1 px, error in pixels at 1 px, and its cost a leaf over that of the first.
const SERIES: [(&str, f64, f64, f64); 5] = [
    ("edge", 1.6e6, 0.02, 1.0),
    ("deviation", 9.0e4, 0.8, 1.02),
    ("distance test", 7.0e4, 0.95, 1.35),
    ("edge, geomorph", 2.2e6, 0.021, 1.2),
    ("uniform", 3.0e6, 0.05, 0.9),
];

/// Numbers between −1 and 1 that look random.
fn noise(i: usize) -> f64 {
    2.0 * ((i as f64 * 12.9898).sin() * 43758.5453).rem_euclid(1.0) - 1.0
}

fn point((name, at_one, error_at_one, cost): (&str, f64, f64, f64), i: usize) -> Point {
    let pixels = 16.0 / 2f64.powi(i as i32);
    let power = if name.starts_with("edge") || name == "uniform" {
        2.0
    } else {
        1.0
    };
    let triangles = (at_one / pixels.powf(power) + 400.0) * (1.0 + 0.02 * noise(i + name.len()));
    let leaves = triangles / 16.0 * 1.6;
    let update = 0.09 + leaves * 2.1e-6 * cost;
    let draw = 0.05 + triangles * 4.5e-7;
    let error = error_at_one * pixels.powf(power) * (1.0 + 0.05 * noise(3 * i + name.len())) + 2e-3;
    let both = |max: f64| Some(Measure { max, rms: 0.31 * max });
    let ms = update + draw;
    let pass = |name: &str, ms: f64| PassTime {
        name: name.to_owned(),
        ms,
    };
    Point {
        series: name.to_owned(),
        label: format!("{pixels} px"),
        ms,
        spread: Some(Interval {
            low: 0.98 * ms,
            high: 1.03 * ms,
        }),
        passes: vec![
            pass("decide", 0.1 * update),
            pass("apply", 0.06 * update),
            pass("measure", 0.14 * update),
            pass("compact", 0.05 * update),
            pass("update", 0.65 * update),
            pass("draw", draw),
        ],
        leaves,
        triangles,
        bytes: (120.0 * (leaves * 1.3).max(65536.0).log2().ceil().exp2()) as u64,
        threshold_factor: 1.0,
        errors: Errors {
            object: both(error * 6e-4),
            normal: both(2.0 * error.sqrt()),
            pixels: both(error),
            silhouette: both(1.3 * error),
            picture: Some(PictureError {
                psnr: Some(52.0 - 8.0 * (error + 0.02).log10()),
                ssim: 1.0 - 1e-3 * error.powf(0.7),
                covered: 0.43,
            }),
        },
    }
}

fn scene(name: &str, count: usize) -> SceneReport {
    let series = SERIES.into_iter().take(count);
    let size = |i: i32| {
        let leaves = 1e3 * 10f64.powf(f64::from(i) / 2.0);
        GrowthPoint {
            leaves,
            ms: (0.15 + leaves * 6e-6) * (1.0 + 0.04 * noise(i as usize)),
            bytes: (leaves * 120.0) as u64,
        }
    };
    SceneReport {
        name: name.to_owned(),
        camera: "start".to_owned(),
        size: [1280, 720],
        clock: Clock::Timestamps,
        points: series
            .flat_map(|series| (0..7).map(move |i| point(series, i)))
            .collect(),
        growth: (0..8).map(size).collect(),
        notes: vec!["All numbers of this report are made up.".to_owned()],
    }
}

fn report() -> Report {
    let scenes: Vec<SceneReport> = vec![scene("teapot", 5), scene("terrain_real", 1)];
    let model = CostModel {
        moved_per_leaf: 96.0,
        kept_per_leaf: 120.0,
        kept_fixed: 3e6,
        passes: 13.0,
        start_us: 6.0,
        efficiency: 0.6,
    };
    let measured: Vec<(f64, f64)> = scenes[0].growth.iter().map(|g| (g.leaves, g.ms)).collect();
    let classes = device_classes();
    Report {
        title: "What accuracy costs in time".to_owned(),
        tool: Tool {
            version: "0.1.0".to_owned(),
            commit: "b374797".to_owned(),
            profile: "release".to_owned(),
        },
        device: Device {
            name: "An invented GPU".to_owned(),
            driver: "driver 1.2.3".to_owned(),
            backend: "vulkan".to_owned(),
            kind: "discrete GPU".to_owned(),
            features: vec!["TIMESTAMP_QUERY".to_owned()],
            cores: 8,
            ..Device::default()
        },
        notes: vec!["Every point is a setting. Errors are measured against the surface in 64-bit numbers.".to_owned()],
        scaling: Some(scaling(&model, &classes, &measured, classes.get(3))),
        scenes,
    }
}

fn main() -> std::io::Result<()> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| ".".to_owned()));
    std::fs::create_dir_all(&folder)?;
    let report = report();
    for scene in &report.scenes {
        for (i, figure) in html::figures(scene).iter().enumerate() {
            let name = format!("{}_{i}.svg", scene.name);
            std::fs::write(folder.join(name), svg::standalone(&figure.svg))?;
        }
    }
    std::fs::write(folder.join("report.html"), html::page(&report))?;
    std::fs::write(folder.join("report.csv"), report.csv())
}
