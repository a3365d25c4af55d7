//! The program as a user meets it: exit codes, messages, and files that are whole or not there.

use serde_json::Value;
use std::path::{Path, PathBuf};
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

fn png(width: u32, height: u32) -> Vec<u8> {
    let picture = image::ImageBuffer::from_fn(width, height, |x, y| image::Luma([(x * 700 + y * 900) as u16]));
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::DynamicImage::ImageLuma16(picture)
        .write_to(&mut bytes, image::ImageFormat::Png)
        .unwrap();
    bytes.into_inner()
}

fn picture(folder: &Folder, name: &str) -> image::DynamicImage {
    image::open(folder.0.join(name)).unwrap()
}

#[test]
fn bad_input_exits_2_with_one_message_and_no_file() {
    let folder = Folder::new("bad-input");
    let map = png(16, 16);
    folder.write("cut.png", &map[..map.len() / 2]);
    folder.write("nan.obj", CUBE.replace("v 1 1 1", "v 1 nan 1"));
    folder.write("range.obj", CUBE.replace("f 5 6 7 8", "f 5 6 7 99"));
    folder.write(
        "fins.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 1 2 3\nf 2 1 4\nf 1 2 5\n",
    );
    folder.write("empty.obj", "v 0 0 0\n");
    folder.write("field.ron", TWO.replace("scale: 0.5", "size: 0.5"));
    folder.write(
        "keys.ron",
        "Scene(surfaces: [Surface(name: \"a\", source: Terrain())], paths: [(name: \"p\", keys: [])])",
    );
    folder.write("lost.ron", TWO.replace("Mesh(\"cube.obj\")", "Mesh(\"nowhere.obj\")"));
    for (input, parts) in [
        ("nothing.obj", &["nothing.obj"][..]),
        ("cut.png", &["cut.png"]),
        ("nan.obj", &["nan.obj"]),
        ("range.obj", &["range.obj"]),
        ("fins.obj", &["fins.obj", "face"]),
        ("empty.obj", &["empty.obj"]),
        ("field.ron", &["field.ron:4", "size", "scale"]),
        ("keys.ron", &["keys.ron", "key"]),
        ("lost.ron", &["nowhere.obj"]),
        ("two.ron --capacity 5", &["capacity", "5", "24"]),
        ("two.ron --capacity 0", &["capacity"]),
        ("two.ron --pixels -3", &["pixels"]),
        ("two.ron --base-grid 7", &["base_grid"]),
        ("two.ron --camera nobody", &["nobody", "front, top"]),
        ("two.ron --size 0x0", &["0x0"]),
        ("two.ron --size 640", &["640"]),
        ("two.ron --size 999999x2", &["999999"]),
        ("two.ron --eye 1,2,3", &["--look-at"]),
        ("two.ron --eye 1,2,3 --look-at 1,2,3", &["--look-at"]),
        ("two.ron --eye 1,2,nan --look-at 0,0,0", &["1,2,nan"]),
        ("two.ron --channel normal --wireframe", &["--wireframe"]),
        ("two.ron -o", &["a value is required"]),
    ] {
        let arguments = if input.ends_with("-o") {
            format!("render {input}")
        } else {
            format!("render {input} -o out.png")
        };
        folder.refuse(&arguments, parts);
    }
    folder.refuse("render cube.obj -o out.gif", &["out.gif", ".png"]);
    folder.refuse("render cube.obj -o out.exr", &["out.exr", "position"]);
    folder.refuse("render cube.obj -o nowhere/out.png", &["nowhere"]);
    folder.refuse("check two.ron --path nothing", &["nothing", "around"]);
    folder.refuse("check two.ron --step 0", &["--step"]);
    folder.refuse("bench nothing.ron --out run.json", &["nothing.ron"]);
    folder.refuse("bench two.ron --out run.json --frames 0", &["--frames"]);
    folder.refuse("plan two.blend", &["two.blend"]);
    folder.refuse("fly two.ron", &["fly"]);
}

#[test]
fn no_adapter_exits_2_with_advice() {
    let folder = Folder::new("no-adapter");
    let nothing = [
        ("WGPU_BACKEND", "dx12"),
        ("VK_DRIVER_FILES", "/nowhere"),
        ("VK_ICD_FILENAMES", "/nowhere"),
    ];
    for arguments in [
        "info",
        "render cube.obj -o out.png",
        "check cube.obj",
        "export cube.obj -o out.obj",
    ] {
        refused(
            arguments,
            &folder.run_in(arguments, &nothing),
            &["no graphics adapter", "mesa-vulkan-drivers"],
        );
    }
    assert!(!folder.files().iter().any(|file| file.starts_with("out")));
    let plan = folder.run_in("plan cube.obj", &nothing);
    assert_eq!(plan.status.code(), Some(0), "a plan needs no adapter");
}

#[test]
fn every_command_has_help_with_an_example() {
    let folder = Folder::new("help");
    for command in ["render", "export", "eval", "check", "bench", "plan", "info"] {
        let help = folder.succeed(&format!("{command} --help"));
        assert!(
            help.contains(&format!("keyleaf {command} ")) && help.contains("Example"),
            "{help}"
        );
    }
    let help = folder.succeed("--help");
    assert!(help.contains("SCENE") && !help.contains("compare"), "{help}");
}

#[test]
fn info_names_the_device() {
    let folder = Folder::new("info");
    let info = folder.succeed_with_json("info --json");
    assert!(!info["device"].as_str().unwrap().is_empty() && info["limits"]["texture_side"].as_u64().unwrap() >= 8192);
    assert!(folder.succeed("info").contains(info["device"].as_str().unwrap()));
}

#[test]
fn plan_lists_what_is_named_and_nothing_else() {
    let folder = Folder::new("plan");
    let plan = |arguments: &str| folder.succeed(&format!("plan {arguments} --json"));
    let bare = plan("cube.obj");
    assert!(!bare.contains("displaced") && !bare.contains("wireframe") && !bare.contains("height"));
    assert!(plan("cube.obj --wireframe").contains("overlay_wireframe.wgsl"));
    let roots = serde_json::from_str::<Value>(&bare)
        .unwrap()
        .pointer("/surfaces/0/roots")
        .and_then(Value::as_u64);
    assert_eq!(roots, Some(24));
    assert!(folder.succeed("plan hills.ron").contains("surfaces/terrain.wgsl"));
}

#[test]
fn render_writes_the_picture_that_was_asked_for() {
    let folder = Folder::new("render");
    let report = folder.succeed_with_json("render two.ron -o a.png --size 96x64 --json");
    for name in [
        "device",
        "leaves",
        "triangles",
        "visible",
        "starved",
        "passes",
        "size",
        "camera",
        "seconds",
    ] {
        assert!(!report[name].is_null(), "{name} in {report}");
    }
    assert_eq!(
        (report["camera"].as_str(), report["settled"].as_bool()),
        (Some("front"), Some(true))
    );
    assert!(report["passes"][0]["ms"].as_f64().unwrap() > 0.0);
    let [first, again] = ["a.png", "b.png"].map(|name| {
        folder.succeed(&format!("render two.ron -o {name} --size 96x64"));
        picture(&folder, name).to_rgb8()
    });
    assert_eq!(first.dimensions(), (96, 64));
    assert_eq!(first, again, "two runs give the same picture");
    folder.succeed("render two.ron -o top.png --size 96x64 --camera top --wireframe --level-tint");
    assert_ne!(first, picture(&folder, "top.png").to_rgb8());
    for channel in ["normal", "level"] {
        folder.succeed(&format!(
            "render cube.obj -o {channel}.png --size 40x30 --channel {channel}"
        ));
        assert_eq!(picture(&folder, &format!("{channel}.png")).width(), 40);
    }
}

#[test]
fn positions_are_in_the_world() {
    let folder = Folder::new("positions");
    let view = "--size 33x33 --eye 0,0,5 --look-at 0,0,0 --fov 40 --channel position";
    folder.succeed(&format!("render cube.obj -o p.exr {view}"));
    folder.succeed(&format!("render cube.obj -o p.png {view}"));
    let floats = picture(&folder, "p.exr").to_rgba32f();
    let [x, y, z, there] = floats.get_pixel(16, 16).0;
    assert!(
        x.abs() < 0.01 && y.abs() < 0.01 && (z - 1.0).abs() < 1e-5 && there == 1.0,
        "{x} {y} {z} {there}"
    );
    assert_eq!(floats.get_pixel(0, 0).0, [0.0; 4]);
    let numbers = picture(&folder, "p.png").to_rgba16();
    assert_eq!(numbers.get_pixel(16, 16).0[2..], [u16::MAX; 2]);
}

/// Positions as text, and triangles, of an .obj.
fn triangles(text: &str) -> (Vec<&str>, Vec<[usize; 3]>) {
    let vertices = text.lines().filter_map(|line| line.strip_prefix("v ")).collect();
    let corner = |text: &str| text.split('/').next().unwrap().parse::<usize>().unwrap() - 1;
    let faces = text.lines().filter_map(|line| line.strip_prefix("f "));
    let triangle = |face: &str| {
        face.split_whitespace()
            .map(corner)
            .collect::<Vec<_>>()
            .try_into()
            .unwrap()
    };
    (vertices, faces.map(triangle).collect())
}

#[test]
fn exports_of_closed_models_are_watertight_in_every_bit() {
    let folder = Folder::new("watertight");
    for arguments in [
        "cube.obj --no-cull --eye 3,2,1.5 --look-at 0,0,0 --size 200x150",
        "two.ron --no-cull --size 120x90",
        "cube.obj --uniform 2",
    ] {
        folder.succeed(&format!("export {arguments} -o out.obj"));
        let text = folder.read("out.obj");
        let (vertices, triangles) = triangles(&text);
        let mut edges: Vec<(&str, &str)> = triangles
            .iter()
            .flat_map(|[a, b, c]| [(*a, *b), (*b, *c), (*c, *a)])
            .map(|(a, b)| (vertices[a], vertices[b]))
            .collect();
        edges.sort_unstable();
        assert!(edges.windows(2).all(|pair| pair[0] != pair[1]), "{arguments}");
        assert!(
            edges.iter().all(|(a, b)| edges.binary_search(&(*b, *a)).is_ok()),
            "{arguments}"
        );
        let mut distinct = vertices.clone();
        distinct.sort_unstable();
        distinct.dedup();
        assert_eq!(distinct.len(), vertices.len(), "{arguments}: every point once");
    }
}

#[test]
fn exports_hold_what_is_drawn() {
    let folder = Folder::new("export");
    let report = folder.succeed_with_json("export cube.obj -o u.ply --uniform 1 --base-grid 0 --json");
    assert_eq!(
        (report["triangles"].as_u64(), report["vertices"].as_u64()),
        (Some(96), Some(50))
    );
    let view = "--size 100x80 --eye 0,0,5 --look-at 0,0,0";
    let seen = folder.succeed_with_json(&format!("export cube.obj -o seen.obj {view} --json"));
    let drawn = folder.succeed_with_json(&format!("render cube.obj -o seen.png {view} --json"));
    assert_eq!(seen["triangles"], drawn["triangles"]);
    folder.succeed(&format!("export cube.obj -o n.obj {view} --normals"));
    assert!(folder.read("n.obj").contains("vn "));
    folder.succeed("export cube.obj -o s.stl --uniform 0");
    assert_eq!(folder.read_bytes("s.stl").len(), 84 + 50 * 24 * 16);
    folder.refuse("export cube.obj -o x.fbx", &["x.fbx", ".ply"]);
    folder.refuse("export cube.obj -o x.obj --uniform 30", &["30", "29"]);
    folder.refuse("export cube.obj -o x.obj --uniform 12", &["402653184", "level 9"]);
    folder.refuse("export cube.obj -o x.stl --uniform 1 --normals", &["x.stl"]);
}

impl Folder {
    fn read_bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(Path::new(&self.0).join(name)).unwrap()
    }
}

#[test]
fn eval_appends_columns_on_both_devices() {
    let folder = Folder::new("eval");
    folder.write("in.csv", "id,face,u,v\na,1,0.5,0.25\n\nb,0,0,1\n");
    for device in ["gpu", "cpu"] {
        folder.succeed(&format!("eval cube.obj --at in.csv -o {device}.csv --on {device}"));
        let text = folder.read(&format!("{device}.csv"));
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[0], "id,face,u,v,x,y,z,du_x,du_y,du_z,dv_x,dv_y,dv_z,n_x,n_y,n_z");
        assert_eq!(lines[1], "a,1,0.5,0.25,0,-0.5,1,2,0,0,0,2,0,0,0,1");
        assert!(lines[2].starts_with("b,0,0,1,-1,-1,-1,") && lines.len() == 3, "{text}");
    }
    folder.write("objects.csv", "object,face,u,v\nleft,1,0.5,0.5\nright,1,0.5,0.5\n");
    folder.succeed("eval two.ron --at objects.csv -o objects_out.csv");
    let text = folder.read("objects_out.csv");
    assert!(
        text.lines()
            .nth(2)
            .unwrap()
            .starts_with("right,1,0.5,0.5,2,0,0.5,1,0,0,"),
        "{text}"
    );
    folder.write("map.csv", "surface,s,t\n0,0.125,0.5\n");
    folder.succeed("eval hills.ron --at map.csv -o map_gpu.csv");
    assert!(
        folder
            .read("map_gpu.csv")
            .lines()
            .nth(1)
            .unwrap()
            .starts_with("0,0.125,0.5,1250,")
    );
}

#[test]
fn heights_by_eval_are_those_of_the_file() {
    let folder = Folder::new("heights");
    let (width, height) = (9, 5);
    folder.write("map.png", png(width, height));
    let mut points = "surface,s,t\n".to_owned();
    let mut expected = Vec::new();
    for (x, y) in [(0, 0), (8, 0), (3, 1), (4, 4), (0, 4), (7, 2)] {
        // Row 0 is at v = 1.
        points += &format!(
            "0,{},{}\n",
            f64::from(x) / f64::from(width - 1),
            1.0 - f64::from(y) / f64::from(height - 1)
        );
        expected.push(f64::from(x * 700 + y * 900));
    }
    folder.write("points.csv", points);
    folder.succeed("eval map.png --at points.csv -o out.csv");
    let text = folder.read("out.csv");
    for (line, expected) in text.lines().skip(1).zip(expected) {
        let y: f64 = line.split(',').nth(4).unwrap().parse().unwrap();
        assert!((y - expected).abs() <= 0.5, "{line}: {expected}");
    }
}

#[test]
fn bad_points_are_refused_with_file_and_line() {
    let folder = Folder::new("bad-points");
    for (points, parts) in [
        ("face,u,v\n0,0.5,0.5\n0,nan,0\n", &["in.csv:3", "u"][..]),
        ("face,u,v\n9,0,0\n", &["in.csv:2", "face 9"]),
        ("face,u,v\n-1,0,0\n", &["in.csv:2", "face"]),
        ("face,u,v\n0,1.5,0\n", &["in.csv:2", "1.5"]),
        ("face,u,v\n0,1\n", &["in.csv:2", "3"]),
        ("face,u\n0,0\n", &["in.csv:1", "`v`", "face,u,v or surface,s,t"]),
        ("surface,s,t\n0,0,0\n", &["in.csv:2", "mesh", "face,u,v"]),
        ("", &["in.csv", "empty"]),
    ] {
        folder.write("in.csv", points);
        folder.refuse("eval cube.obj --at in.csv -o out.csv --on cpu", parts);
    }
    folder.write("in.csv", "face,u,v\n0,0,0\n");
    folder.refuse("eval two.ron --at in.csv -o out.csv", &["left, right", "--object"]);
    folder.refuse(
        "eval two.ron --at in.csv -o out.csv --object nobody",
        &["nobody", "left, right"],
    );
    folder.refuse("eval cube.obj --at nothing.csv -o out.csv", &["nothing.csv"]);
}

#[test]
fn check_finds_nothing_wrong_also_when_starved() {
    let folder = Folder::new("check");
    for arguments in [
        "two.ron --step 0.05",
        "two.ron --step 0.1 --capacity 120 --pixels 2",
        "hills.ron --step 0.5 --pixels 40",
    ] {
        let report = folder.succeed_with_json(&format!("check {arguments} --size 160x120 --json"));
        assert_eq!(report["findings"], 0, "{report}");
        assert_eq!(report["frames"], report["checked"]);
        let starved = report["starved_frames"].as_array().unwrap().len();
        assert_eq!(starved > 0, arguments.contains("120 --pixels"), "{report}");
    }
    let few = folder.succeed_with_json("check two.ron --step 0.05 --every 4 --size 64x48 --json");
    assert_eq!((few["frames"].as_u64(), few["checked"].as_u64()), (Some(7), Some(3)));
}

#[test]
fn check_finds_the_cracks_of_leaves_that_do_not_look_at_each_other() {
    let folder = Folder::new("check-fails");
    let output = folder.run("check two.ron --step 0.05 --size 320x240 --no-neighbours");
    let text = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{text}");
    assert!(text.contains("T-junction") && text.contains("keys"), "{text}");
}

#[test]
fn bench_reports_every_pass() {
    let folder = Folder::new("bench");
    folder.succeed("bench two.ron hills.ron --out run.json --frames 4 --warm-up 2 --size 80x60");
    let report: Value = serde_json::from_str(&folder.read("run.json")).unwrap();
    assert!(report["device"].is_string() && report["software"].is_boolean());
    let [two, hills] = [0, 1].map(|i| &report["scenes"][i]);
    assert_eq!(
        (two["name"].as_str(), hills["name"].as_str(), two["frames"].as_u64()),
        (Some("two"), Some("hills"), Some(4))
    );
    assert!(two["leaves"]["median"].as_f64().unwrap() >= 48.0 && hills["triangles"]["median"].as_f64().unwrap() > 0.0);
    for (pass, name) in ["update", "draw"].iter().enumerate() {
        let pass = &two["passes"][pass];
        assert_eq!(pass["name"].as_str(), Some(*name));
        assert!(pass["median_ms"].as_f64().unwrap() > 0.0 && pass["cpu_ms"]["median"].as_f64().unwrap() > 0.0);
    }
    folder.succeed("bench cube.obj --out both.json --frames 3 --warm-up 1 --size 80x60 --neighbours both --no-draw");
    let both: Value = serde_json::from_str(&folder.read("both.json")).unwrap();
    assert!(both["scenes"][0]["ratio"]["cpu"].as_f64().unwrap() > 0.0);
}

#[test]
fn quiet_commands_print_nothing_but_results() {
    let folder = Folder::new("quiet");
    let output = folder.run("render cube.obj -o a.png --size 20x20 --quiet");
    assert!(output.stderr.is_empty() && output.status.success());
}
