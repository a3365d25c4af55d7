//! The program as a user meets it: exit codes, messages, and files that are whole or not there.

mod accuracy;
mod back_faces;
mod bad_input;
mod display;
mod flights;
mod models;
mod oracles;
mod pictures;
mod reports;
mod scenes;
mod subdivision;
mod viewer;

use serde_json::Value;
use std::path::PathBuf;
use std::process::{Command, Output};

/// A folder of its own for each test, removed in the end.
struct Folder(PathBuf);

impl Folder {
    fn new(test: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("keyleaf-command-line-{test}-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        let folder = Self(folder);
        folder.write("cube.obj", CUBE);
        folder.write("two.ron", TWO);
        folder.write("hills.ron", HILLS);
        folder
    }

    fn write(&self, name: &str, contents: impl AsRef<[u8]>) {
        std::fs::write(self.0.join(name), contents).unwrap();
    }

    fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.0.join(name)).unwrap()
    }

    fn read_bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.0.join(name)).unwrap()
    }

    fn files(&self) -> Vec<String> {
        let name =
            |entry: std::io::Result<std::fs::DirEntry>| entry.unwrap().file_name().to_string_lossy().into_owned();
        let mut names: Vec<String> = std::fs::read_dir(&self.0).unwrap().map(name).collect();
        names.sort();
        names
    }

    fn run(&self, arguments: &str) -> Output {
        self.run_in(arguments, &[])
    }

    fn run_in(&self, arguments: &str, environment: &[(&str, &str)]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_keyleaf"))
            .args(arguments.split_whitespace())
            .current_dir(&self.0)
            .env("XDG_RUNTIME_DIR", &self.0) // without one, a display library on the way to the driver prints an error of its own
            .envs(environment.iter().copied())
            .output()
            .unwrap()
    }

    /// The standard output of a command that must succeed.
    fn succeed(&self, arguments: &str) -> String {
        let output = self.run(arguments);
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(0), "{arguments}: {errors}");
        String::from_utf8(output.stdout).unwrap()
    }

    fn succeed_with_json(&self, arguments: &str) -> Value {
        serde_json::from_str(&self.succeed(arguments)).unwrap()
    }

    /// A command must end with 2 and one message that has all of `parts`, and leave no file.
    fn refuse(&self, arguments: &str, parts: &[&str]) {
        let before = self.files();
        refused(arguments, &self.run(arguments), parts);
        assert_eq!(self.files(), before, "{arguments}");
    }
}

fn refused(arguments: &str, output: &Output, parts: &[&str]) {
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments}: {errors}");
    assert!(output.stdout.is_empty(), "{arguments}");
    assert!(!errors.contains("panicked"), "{arguments}: {errors}");
    assert_eq!(errors.matches("error:").count(), 1, "{arguments}: {errors}");
    assert!(errors.starts_with("error: "), "{arguments}: {errors}");
    for part in parts {
        assert!(errors.contains(part), "{arguments}: '{part}' is not in: {errors}");
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

const CUBE: &str = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1
f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

const TWO: &str = r#"Scene(
    surfaces: [
        Surface(name: "left", source: Mesh("cube.obj"), transform: (translation: (-2, 0, 0), rotation: (10, 20, 30))),
        Surface(name: "right", source: Mesh("cube.obj"), transform: (translation: (2, 0, 0), scale: 0.5)),
    ],
    settings: (metric: Edge(pixels: 12), capacity: 4096),
    cameras: [(name: "front", eye: (0, 1, 8), look_at: (0, 0, 0)), (name: "top", eye: (0, 9, 0.1), look_at: (0, 0, 0))],
    paths: [(
        name: "around",
        keys: [
            (time: 0, eye: (0, 1, 8), look_at: (0, 0, 0)),
            (time: 0.2, eye: (-2, 0.5, 1.6), look_at: (-2, 0, 0)),
            (time: 0.3, eye: (9, 1, 0), look_at: (0, 0, 0), cut: true),
        ],
    )],
)"#;

const HILLS: &str = r#"Scene(
    surfaces: [Surface(name: "hills", source: Terrain(extent: 10000, height: 800, first_level: 2, octaves: 6))],
    settings: (metric: Edge(pixels: 16), capacity: 20000),
    cameras: [(name: "over", eye: (5000, 1500, -1000), look_at: (5000, 0, -5000))],
)"#;

/// A height map of 16 bits: 700 a column, 900 a row.
fn png(width: u32, height: u32) -> Vec<u8> {
    let picture = image::ImageBuffer::from_fn(width, height, |x, y| image::Luma([(x * 700 + y * 900) as u16]));
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::DynamicImage::ImageLuma16(picture)
        .write_to(&mut bytes, image::ImageFormat::Png)
        .unwrap();
    bytes.into_inner()
}
