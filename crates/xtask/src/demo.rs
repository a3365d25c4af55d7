//! `cargo xtask demo`: pictures of the default scenes, one camera path, a table.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use anyhow::Context;
use serde_json::Value;

use crate::run;
use crate::table;

/// Scenes of `scenes/`, in the order of the table.
const SCENES: [&str; 11] = [
    "terrain_real",
    "terrain_procedural",
    "fox",
    "several",
    "goblet",
    "pot",
    "mixed",
    "displaced",
    "cube",
    "open",
    "thin",
];
/// The scene whose camera path is flown.
const FLIGHT: &str = "terrain_real";
/// Size of the pictures in pixels.
const SIZE: &str = "1280x720";

// Where the figures are in the JSON that the program writes (JSON pointers).
const DEVICE: &str = "/device";
const LEAVES: &str = "/leaves";
const TRIANGLES: &str = "/triangles";
const PASSES: &str = "/passes";
const PASS_NAME: &str = "/name";
const PASS_MS: &str = "/ms";
const FLIGHT_DEVICE: &str = "/device/name";
const FLIGHT_RUN: &str = "/runs/0";
const FLIGHT_FRAMES: &str = "/frames";
const FLIGHT_LEAVES: &str = "/leaves/p50";
const FLIGHT_TRIANGLES: &str = "/triangles/p50";
const FLIGHT_PASS_MS: &str = "/ms/p50";

/// Builds the program and shows what it does; pictures and figures go to `out/demo/`.
///
/// # Errors
/// The build or the program failed, or a file could not be written or read.
pub fn demo() -> anyhow::Result<()> {
    eprintln!("demo: building keyleaf (release); the first time this takes some minutes");
    run::cargo(&["build", "--release", "--locked", "--package", "keyleaf-cli"])?;
    let start = Instant::now();
    let program = Program {
        path: release_program()?,
        folder: run::workspace(),
    };
    let folder = Path::new("out").join("demo");
    let absolute = program.folder.join(&folder);
    fs::create_dir_all(&absolute).with_context(|| format!("cannot make {}", absolute.display()))?;

    let (mut rows, mut pictures) = (Vec::new(), Vec::new());
    for scene in SCENES {
        let picture = folder.join(format!("{scene}.png"));
        eprintln!("demo: {scene}");
        let report = program.render(scene, &picture)?;
        rows.push(picture_row(scene, &report));
        pictures.push(picture);
    }
    let figures = folder.join(format!("{FLIGHT}.json"));
    eprintln!("demo: flying the camera path of {FLIGHT}");
    rows.push(flight_row(&program.fly(FLIGHT, &figures)?));

    println!(
        "{}\n",
        table::format(&["scene", "leaves", "triangles", "device", "ms per pass"], &rows)
    );
    println!("Pictures ({SIZE}):");
    for picture in &pictures {
        println!("  {}", picture.display());
    }
    println!("Figures of the flight: {}", figures.display());
    if let Some(hint) = viewer_hint(&program) {
        println!("{hint}");
    }
    println!("{:.0} s after the build.", start.elapsed().as_secs_f64());
    Ok(())
}

/// The built program, run in the root of the workspace so that the paths it prints are short.
struct Program {
    path: PathBuf,
    folder: PathBuf,
}

impl Program {
    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(&self.path);
        command.args(arguments).current_dir(&self.folder);
        command
    }

    /// Renders a scene from its first camera; the program's report.
    fn render(&self, scene: &str, picture: &Path) -> anyhow::Result<Value> {
        let scene = scene_path(scene);
        let mut command = self.command(&["render", &scene, "--size", SIZE, "--json"]);
        let text = run::output(command.arg("-o").arg(picture))?;
        serde_json::from_str(&text).with_context(|| format!("`keyleaf render {scene} --json` wrote no JSON"))
    }

    /// Flies the camera path of a scene; the report that the program wrote.
    fn fly(&self, scene: &str, figures: &Path) -> anyhow::Result<Value> {
        let mut command = self.command(&["bench", &scene_path(scene)]);
        run::output(command.arg("--out").arg(figures))?;
        let path = self.folder.join(figures);
        let text = fs::read_to_string(&path).with_context(|| format!("cannot read {}", path.display()))?;
        serde_json::from_str(&text).with_context(|| format!("{} is not JSON", path.display()))
    }
}

fn scene_path(scene: &str) -> String {
    format!("scenes/{scene}.ron")
}

/// The release program beside the profile folder that this program was built in.
pub fn release_program() -> anyhow::Result<PathBuf> {
    let here = env::current_exe().context("cannot find this program's own path")?;
    let target = here
        .ancestors()
        .nth(2)
        .context("this program does not lie in a target folder")?;
    let path = target
        .join("release")
        .join(format!("keyleaf{}", env::consts::EXE_SUFFIX));
    anyhow::ensure!(path.is_file(), "{} was not built", path.display());
    Ok(path)
}

fn picture_row(scene: &str, report: &Value) -> Vec<String> {
    let device = report.pointer(DEVICE);
    row(scene.into(), device, report, [LEAVES, TRIANGLES, PASS_MS])
}

/// Medians over the frames of the flight.
fn flight_row(report: &Value) -> Vec<String> {
    let nothing = Value::Null;
    let flight = report.pointer(FLIGHT_RUN).unwrap_or(&nothing);
    let frames = count(flight, FLIGHT_FRAMES);
    let title = format!("{FLIGHT}, median of {frames} frames");
    let device = report.pointer(FLIGHT_DEVICE);
    row(title, device, flight, [FLIGHT_LEAVES, FLIGHT_TRIANGLES, FLIGHT_PASS_MS])
}

fn row(title: String, device: Option<&Value>, figures: &Value, [leaves, triangles, ms]: [&str; 3]) -> Vec<String> {
    let device = device.and_then(Value::as_str).unwrap_or("-");
    vec![
        title,
        count(figures, leaves),
        count(figures, triangles),
        device.into(),
        passes(figures, ms),
    ]
}

/// A whole number of the report, `-` where it has none.
fn count(report: &Value, pointer: &str) -> String {
    let number = report.pointer(pointer).and_then(Value::as_f64);
    number.map_or_else(|| "-".into(), |number| table::thousands(number.round() as u64))
}

/// `update 1.20, apply 0.10, …`; `-` where the device has no timestamps.
fn passes(report: &Value, ms: &str) -> String {
    let passes = report
        .pointer(PASSES)
        .and_then(Value::as_array)
        .map(Vec::as_slice)
        .unwrap_or_default();
    let texts: Vec<String> = passes
        .iter()
        .filter_map(|pass| {
            let name = pass.pointer(PASS_NAME)?.as_str()?;
            Some(format!("{name} {:.2}", pass.pointer(ms)?.as_f64()?))
        })
        .collect();
    if texts.is_empty() { "-".into() } else { texts.join(", ") }
}

/// How to open the viewer, where there is a display and this build has one.
fn viewer_hint(program: &Program) -> Option<String> {
    let set = |name: &str| env::var_os(name).is_some_and(|value| !value.is_empty());
    let display = set("DISPLAY") || set("WAYLAND_DISPLAY") || !cfg!(target_os = "linux");
    let has_viewer = run::succeeds(&program.path.to_string_lossy(), &["view", "--help"]);
    let command = format!("cargo run --release -- view {}", scene_path(FLIGHT));
    (display && has_viewer).then(|| format!("To fly yourself: {command}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_show_what_a_report_has_and_a_dash_for_what_it_lacks() {
        let report = serde_json::json!({
            "device": "llvmpipe", "leaves": 12345, "triangles": 197520,
            "passes": [{ "name": "update", "ms": 1.234 }, { "name": "draw", "ms": null }]
        });
        assert_eq!(
            picture_row("cube", &report),
            ["cube", "12,345", "197,520", "llvmpipe", "update 1.23"]
        );
        assert_eq!(picture_row("cube", &Value::Null), ["cube", "-", "-", "-", "-"]);
    }

    #[test]
    fn flight_row_shows_medians() {
        let report = serde_json::json!({
            "device": { "name": "llvmpipe" },
            "runs": [{
                "frames": 120, "leaves": { "p50": 10.0 }, "triangles": { "p50": 160 },
                "passes": [{ "name": "update", "ms": { "p50": 0.5 } }]
            }]
        });
        let title = format!("{FLIGHT}, median of 120 frames");
        assert_eq!(
            flight_row(&report),
            [title.as_str(), "10", "160", "llvmpipe", "update 0.50"]
        );
    }
}
