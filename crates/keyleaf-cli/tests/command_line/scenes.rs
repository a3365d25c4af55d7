//! The scenes that keyleaf ships with.

use super::Folder;
use std::path::{Path, PathBuf};

/// All, by name.
pub fn shipped() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../scenes")
        .canonicalize()
        .unwrap();
    let is_scene = |path: &PathBuf| path.extension().is_some_and(|e| e == "ron");
    let mut all: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|e| e.unwrap().path())
        .filter(is_scene)
        .collect();
    all.sort();
    all
}

/// A few frames far apart: what moves has moved, the camera has jumped.
#[test]
fn check_finds_nothing_wrong_in_any_scene() {
    let folder = Folder::new("check-scenes");
    let scenes = shipped();
    assert!(scenes.len() > 15);
    for scene in &scenes {
        let scene = scene.display();
        let output = folder.run(&format!("check {scene} --step 3 --pixels 40 --size 160x120 --quiet"));
        let text = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success() && text.contains(": 0 findings"), "{text}");
    }
}
