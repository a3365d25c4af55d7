//! The scenes that are shipped: the folder `scenes` of a checkout, found from the program or from the current folder.

use std::path::{Path, PathBuf};

/// Scene files of the nearest folder `scenes` at or above `near`, or of the current folder; sorted by name.
pub fn scenes(near: Option<&Path>) -> Vec<PathBuf> {
    let program = std::env::current_exe().ok();
    let current = std::env::current_dir().ok();
    let starts = [near.map(Path::to_path_buf), current, program];
    let found = starts
        .into_iter()
        .flatten()
        .find_map(|start| start.ancestors().map(scenes_in).find(|scenes| !scenes.is_empty()));
    found.unwrap_or_default()
}

fn scenes_in(folder: &Path) -> Vec<PathBuf> {
    let is_scene = |path: &PathBuf| path.extension().is_some_and(|e| e == "ron");
    let entries = std::fs::read_dir(folder.join("scenes")).into_iter().flatten().flatten();
    let mut scenes: Vec<PathBuf> = entries.map(|entry| entry.path()).filter(is_scene).collect();
    scenes.sort();
    scenes
}

/// The folder of the WGSL files of the checkout that a scene or the program lies in.
pub fn shaders(near: Option<&Path>) -> Option<PathBuf> {
    let program = std::env::current_exe().ok();
    let current = std::env::current_dir().ok();
    let starts = [near.map(Path::to_path_buf), current, program];
    starts.into_iter().flatten().find_map(|start| {
        let folders = start.ancestors().map(|folder| folder.join("shaders"));
        folders
            .into_iter()
            .find(|folder| folder.join("passes/update.wgsl").is_file())
    })
}

/// What a list calls a scene.
pub fn title(scene: &Path) -> String {
    scene
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .replace('_', " ")
}
