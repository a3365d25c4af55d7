//! The chord error of Newell's tea set against values computed elsewhere.

use keyleaf_report::error::chord_error;
use keyleaf_scene::{PatchFileOptions, read_patches};
use keyleaf_surface::{PatchKind, PatchSettings, Patches};
use std::path::{Path, PathBuf};

/// Levels that are compared; a finer one takes four times as long as the one before.
const LEVELS: usize = 4;
/// How far a value may be from that of the table, as a part of it.
const TOLERANCE: f64 = 0.05;

/// A shared file; `None` where the folder is absent.
fn shared(name: &str) -> Option<PathBuf> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared").join(name);
    if file.exists() {
        return Some(file);
    }
    println!("skipped: {} is not there", file.display());
    None
}

fn patches(file: &Path) -> Patches {
    let model = read_patches(file, &PatchFileOptions::default()).unwrap();
    let settings = PatchSettings {
        kind: PatchKind::Bezier,
        ..PatchSettings::default()
    };
    Patches::new(model.surfaces, settings).unwrap()
}

#[test]
fn chord_errors_of_the_tea_set_are_those_of_the_table() {
    let Some(table) = shared("oracles/accuracy_anchors.json") else {
        return;
    };
    let table: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(table).unwrap()).unwrap();
    for name in ["teapot", "teacup"] {
        let Some(file) = shared(&format!("data/teaset/{name}")) else {
            continue;
        };
        let surface = patches(&file);
        for row in table[name].as_array().unwrap().iter().take(LEVELS) {
            let level = row["L"].as_u64().unwrap() as u32;
            let found = chord_error(&surface, level).unwrap();
            assert_eq!(Some(found.triangles), row["triangles"].as_u64());
            let parts = [("max", found.error.max), ("rms", found.error.rms)].map(|(measure, value)| {
                let expected = row[format!("{measure}_over_diag")].as_f64().unwrap();
                let part = value / expected - 1.0;
                assert!(
                    part.abs() < TOLERANCE,
                    "{name} level {level}: {measure} is {value}, not {expected}"
                );
                format!("{measure} {value:.4e} ({:+.2} %)", 100.0 * part)
            });
            println!("{name} level {level}: {}", parts.join(", "));
        }
    }
}
