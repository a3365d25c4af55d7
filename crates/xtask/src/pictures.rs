//! `cargo xtask pictures`: the viewer drives itself and takes the pictures of `docs/pictures/viewer_*.png`.

use std::fs;
use std::process::Command;

use anyhow::Context;

use crate::demo;
use crate::display::Display;
use crate::run;

/// A scene, and the steps that end in its pictures: `docs/pictures/scripts/NAME.ron`.
const SCRIPTS: [(&str, &str); 3] = [
    ("scenes/terrain_real.ron", "terrain"),
    ("scenes/fox.ron", "fox"),
    ("scenes/creases.ron", "creases"),
];
/// Size of the window in pixels.
const SIZE: &str = "1280x800";

/// Builds the program and runs the scripts.
///
/// # Errors
/// The build, the display or the viewer failed.
pub fn pictures() -> anyhow::Result<()> {
    eprintln!("pictures: building keyleaf (release); the first time this takes some minutes");
    run::cargo(&["build", "--release", "--locked", "--package", "keyleaf-cli"])?;
    let folder = run::workspace();
    let program = demo::release_program()?;
    let display = Display::start()?;
    for (scene, script) in SCRIPTS {
        eprintln!("pictures: {script}");
        let script = format!("docs/pictures/scripts/{script}.ron");
        let mut command = Command::new(&program);
        command
            .args(["view", scene, "--size", SIZE, "--script", &script])
            .current_dir(&folder)
            .env("DISPLAY", &display.name)
            .env_remove("WAYLAND_DISPLAY");
        run::run(&mut command)?;
    }
    let made = fs::read_dir(folder.join("docs/pictures")).context("docs/pictures")?;
    let mut names: Vec<String> = made
        .flatten()
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .filter(|name| name.starts_with("viewer_"))
        .collect();
    names.sort();
    names.iter().for_each(|name| println!("docs/pictures/{name}"));
    Ok(())
}
