//! The chord error of Newell's tea set against values computed elsewhere.

use glam::{DMat4, DVec3, DVec4};
use keyleaf_key::Place;
use keyleaf_report::error::{DrawnTriangle, DrawnVertex, ErrorSettings, ScreenView, chord_error, measure};
use keyleaf_scene::{PatchFileOptions, read_patches};
use keyleaf_surface::{PatchKind, PatchSettings, Patches, Surface};
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

/// All nodes of a level, with positions as the GPU stores them.
fn drawn(surface: &Patches, level: u32) -> Vec<DrawnTriangle> {
    let mut nodes: Vec<Place> = surface.topology().roots().collect();
    for _ in 0..level {
        nodes = nodes.into_iter().flat_map(Place::children).collect();
    }
    let vertex = |at| {
        let frame = surface.frame(at);
        DrawnVertex {
            at,
            position: frame.position.as_vec3().as_dvec3(),
            normal: frame.normal.as_vec3().as_dvec3(),
        }
    };
    nodes
        .into_iter()
        .map(|node| DrawnTriangle {
            corners: node.corners().map(vertex),
        })
        .collect()
}

#[test]
fn errors_of_the_teapot_fall_with_the_square_of_the_edge_by_every_measure() {
    let Some(file) = shared("data/teaset/teapot") else {
        return;
    };
    let surface = patches(&file);
    let (low, high) = surface.bounding_box();
    let centre = (low + high) / 2.0;
    // A parallel view from the side, which is 500 pixels for the diagonal.
    let scale = 2.0 / low.distance(high);
    let [x, y, z] = [DVec3::X, DVec3::Z, DVec3::Y].map(|axis| (axis * scale).extend(-axis.dot(centre) * scale));
    let view = ScreenView::new(DMat4::from_rows(x, y, z, DVec4::W), [500, 500]);
    let errors = [2, 3].map(|level| {
        let triangles = drawn(&surface, level);
        let begin = std::time::Instant::now();
        let settings = ErrorSettings {
            intervals: 4,
            ..ErrorSettings::default()
        };
        let error = measure(&surface, &triangles, &settings, Some(&view)).unwrap();
        let us = begin.elapsed().as_secs_f64() * 1e6 / triangles.len() as f64;
        println!("level {level}: {us:.0} us a triangle; {error:?}");
        error
    });
    for error in errors {
        assert!(error.forward.max <= error.parametric.max && error.backward.max <= error.parametric.max);
        let screen = error.screen.unwrap();
        assert!(
            (screen.side_on.max - 500.0 * error.forward.max).abs() < 1e-6 * screen.side_on.max,
            "{screen:?}"
        );
        let silhouette = screen.silhouette.unwrap();
        assert!(
            silhouette.error.rms < screen.side_on.max && silhouette.length > 500.0,
            "{screen:?}"
        );
    }
    let ratio = |of: fn(&keyleaf_report::error::MeshError) -> f64| of(&errors[0]) / of(&errors[1]);
    for ratio in [
        ratio(|e| e.forward.rms),
        ratio(|e| e.backward.rms),
        ratio(|e| e.parametric.rms),
    ] {
        assert!((3.4..4.6).contains(&ratio), "{ratio}");
    }
    assert!((3.0..5.0).contains(&ratio(|e| e.forward.max)));
}
