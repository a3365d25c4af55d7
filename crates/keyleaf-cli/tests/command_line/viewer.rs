//! The viewer, driven by scripts in a window on a display in memory. Any error of the device ends a script with code 2.

use super::Folder;
use super::display::Display;
use super::scenes::shipped;
use glam::DVec3;
use serde_json::Value;
use std::path::Path;

/// Runs the viewer on a scene with some steps; the reports `1.json`, `2.json`, … that they write.
fn drive(folder: &Folder, scene: &str, size: &str, steps: &str) -> Vec<Value> {
    folder.write("script.ron", format!("[{steps}, Quit]"));
    let display = Display::start();
    let arguments = format!("view {scene} --size {size} --script script.ron");
    let output = folder.run_in(&arguments, &[("DISPLAY", &display.name), ("WAYLAND_DISPLAY", "")]);
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{errors}");
    let report = |n: u32| folder.0.join(format!("{n}.json"));
    let all = (1..).map(report).take_while(|file| file.exists());
    all.map(|file| serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap())
        .collect()
}

fn vector(value: &Value) -> DVec3 {
    let all: Vec<f64> = value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    DVec3::from_slice(&all)
}

fn distance(report: &Value) -> f64 {
    vector(&report["eye"]).distance(vector(&report["pivot"]))
}

#[test]
fn viewer_opens_every_shipped_scene_one_after_the_other() {
    let folder = Folder::new("viewer-scenes");
    let scenes = shipped();
    assert!(scenes.len() > 3);
    let steps = scenes.iter().zip(1..).map(|(scene, n)| {
        let scene = scene.display().to_string();
        format!("Drop({scene:?}), Frames(6), Report(\"{n}.json\")")
    });
    let steps: Vec<String> = steps.collect();
    let reports = drive(&folder, "two.ron", "160x120", &steps.join(", "));
    assert_eq!(reports.len(), scenes.len());
    for (report, scene) in reports.iter().zip(&scenes) {
        let name = scene.file_name().unwrap().to_string_lossy().into_owned();
        assert_eq!(report["file"], name.as_str(), "{report}");
        assert_eq!(report["message"], Value::Null, "{name}");
        assert!(
            report["leaves"].as_u64().unwrap() > 0 && report["lost"] == 0,
            "{report}"
        );
    }
}

#[test]
fn viewer_cameras_follow_pointer_and_keys() {
    let folder = Folder::new("viewer-cameras");
    let steps = r#"
        Settle, Report("1.json"),
        Drag(from: (0.5, 0.5), to: (0.8, 0.3)), Settle, Report("2.json"),
        Wheel(3.0), Settle, Report("3.json"),
        Drag(from: (0.5, 0.5), to: (0.4, 0.6), button: Right), Settle, Report("4.json"),
        Key("F"), Settle, Report("5.json"),
        DoubleClick(0.5, 0.5), Settle, Report("6.json"),
        Key("G"), Hold("W", 10), Settle, Report("7.json"),
        Drag(from: (0.5, 0.5), to: (0.6, 0.5)), Settle, Report("8.json")"#;
    let reports = drive(&folder, "cube.obj", "240x160", steps);
    let [start, turned, near, moved, framed, pivoted, flown, looked] = &reports[..] else {
        panic!("{} reports", reports.len())
    };
    let eye = |report: &Value| vector(&report["eye"]);
    assert!(eye(start).distance(eye(turned)) > 0.1, "a drag turns");
    assert!(
        (distance(start) - distance(turned)).abs() < 1e-9 * distance(start),
        "and keeps the distance"
    );
    assert!(distance(near) < 0.9 * distance(turned), "the wheel comes nearer");
    assert_ne!(near["pivot"], moved["pivot"], "the right button moves sideways");
    assert_ne!(framed["eye"], moved["eye"]);
    assert!(
        distance(pivoted) < distance(framed),
        "the pivot is on the surface, which is before the middle"
    );
    assert!(
        distance(flown) > 0.0 && eye(flown).distance(eye(pivoted)) > 0.01,
        "W flies"
    );
    assert_eq!(flown["eye"], looked["eye"], "a drag in flight turns in place");
    assert_ne!(flown["pivot"], looked["pivot"]);
}

#[test]
fn viewer_freezes_and_switches_looks() {
    let folder = Folder::new("viewer-looks");
    let toggles: String = ["1", "2", "3", "4", "5", "6", "7", "8", "0", "1", "M", "I", "T"]
        .map(|key| format!("Key(\"{key}\"), Settle,"))
        .concat();
    let steps = format!(
        r#"Settle, Report("1.json"), {toggles} Report("2.json"),
        Key("Z"), Drag(from: (0.5, 0.5), to: (0.1, 0.5)), Wheel(6.0), Settle, Report("3.json"),
        Click(0.5, 0.5), Frames(2), Report("4.json"), Key("Escape"),
        Key("Z"), Settle, Report("5.json"),
        Export("seen.obj")"#
    );
    let reports = drive(&folder, "cube.obj", "520x300", &steps);
    let count = |n: usize| (&reports[n]["leaves"], &reports[n]["visible"]);
    assert_eq!(count(0), count(1), "looks change no leaf");
    assert_eq!((&reports[2]["frozen"], count(2)), (&Value::Bool(true), count(1)));
    assert!(reports[3]["picked"].is_string(), "{}", reports[3]);
    assert_ne!(count(4), count(1), "nearer, and refined again");
    assert!(folder.read("seen.obj").lines().any(|line| line.starts_with("f ")));
}

#[test]
fn viewer_keeps_the_last_good_scene_and_survives_sizes_and_a_lost_device() {
    let folder = Folder::new("viewer-errors");
    folder.write(
        "broken.ron",
        "(surfaces: [(name: \"x\", source: Mesh(\"nothing.obj\"))])",
    );
    folder.write("no.xyz", "");
    let steps = r#"
        Settle, Report("1.json"),
        Drop("broken.ron"), Settle, Report("2.json"),
        Drop("no.xyz"), Settle, Report("3.json"),
        Drop("cube.obj"), Settle, Report("4.json"),
        Resize(1, 1), Settle, Frames(3), Resize(300, 180), Settle, Report("5.json"),
        Occlude(true), Frames(2), Occlude(false),
        LoseDevice, Frames(3), Settle, Report("6.json"), Screenshot("after.png")"#;
    let reports = drive(&folder, "two.ron", "300x180", steps);
    let message = |n: usize| reports[n]["message"].as_str().unwrap_or_default().to_owned();
    assert!(message(1).contains("nothing.obj"), "{}", message(1));
    assert!(message(2).contains("unknown file type 'xyz'"), "{}", message(2));
    for n in [0, 1, 2] {
        assert_eq!(
            (&reports[n]["file"], &reports[n]["leaves"]),
            (&Value::from("two.ron"), &reports[0]["leaves"])
        );
    }
    assert_eq!(
        (reports[3]["file"].as_str(), message(3)),
        (Some("cube.obj"), String::new())
    );
    assert_eq!(reports[3]["leaves"], reports[4]["leaves"], "the size is as before");
    assert_eq!(reports[3]["leaves"], reports[5]["leaves"], "the device is back");
    assert_eq!(reports[5]["refused"].as_array().map(Vec::len), Some(0));
    let picture = image::open(folder.0.join("after.png")).unwrap().to_rgb8();
    assert_eq!(picture.dimensions(), (300, 180));
    let first = picture.get_pixel(0, 0);
    assert!(picture.pixels().any(|p| p != first), "something is drawn");
}

#[test]
fn viewer_records_and_replays_paths() {
    let folder = Folder::new("viewer-paths");
    let steps = r#"
        Settle, Report("1.json"),
        Key("R"), Drag(from: (0.5, 0.5), to: (0.7, 0.5), moves: 30), Key("R"), Settle, Report("2.json"),
        Key("F"), Settle, Key("Space"), Settle, Report("3.json")"#;
    let reports = drive(&folder, "two.ron", "200x150", steps);
    assert_eq!(
        reports[1]["paths"].as_u64(),
        reports[0]["paths"].as_u64().map(|n| n + 1),
        "the recorded path is there"
    );
    let (end, replayed) = (vector(&reports[1]["eye"]), vector(&reports[2]["eye"]));
    assert!(end.distance(vector(&reports[0]["eye"])) > 0.1);
    assert!(end.distance(replayed) < 1e-6 * end.length(), "{end} {replayed}");
}

#[test]
fn viewer_counts_as_bench_does() {
    let folder = Folder::new("viewer-counts");
    let scene = r#"(
        surfaces: [(name: "hills", source: Terrain(height: 900, octaves: 8))],
        cameras: [(name: "here", eye: (0, 1500, 0), look_at: (4000, 500, -9000))],
        paths: [(name: "here", keys: [(time: 0, eye: (0, 1500, 0), look_at: (4000, 500, -9000))])],
    )"#;
    folder.write("here.ron", scene);
    let reports = drive(&folder, "here.ron", "600x320", r#"Settle, Report("1.json")"#);
    let report = &reports[0];
    let [width, height] = [0, 1].map(|i| report["picture"][i].as_u64().unwrap());
    let arguments = format!("bench here.ron --out b.json --frames 1 --warm-up 80 --no-draw --size {width}x{height}");
    folder.succeed(&arguments);
    let bench: Value = serde_json::from_str(&folder.read("b.json")).unwrap();
    for count in ["leaves", "visible", "triangles"] {
        let expected = bench["runs"][0][count]["p50"].as_f64();
        assert_eq!(report[count].as_f64(), expected, "{count}");
    }
}

#[test]
fn viewer_looks_as_blessed() {
    let folder = Folder::new("viewer-pictures");
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/fox.ron");
    let names = ["plain", "levels", "error", "window"];
    let steps = r#"
        Settle, Picture("plain.png"),
        Key("2"), Key("1"), Settle, Picture("levels.png"),
        Key("1"), Key("6"), Settle, Picture("error.png"),
        Key("0"), Settle, Screenshot("window.png")"#;
    drive(&folder, &scene.display().to_string(), "320x200", steps);
    let blessed = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/command_line/blessed");
    for name in names {
        let (made, wanted) = (
            folder.0.join(format!("{name}.png")),
            blessed.join(format!("viewer_{name}.png")),
        );
        if std::env::var_os("KEYLEAF_BLESS").is_some() {
            std::fs::create_dir_all(&blessed).unwrap();
            std::fs::copy(&made, &wanted).unwrap();
        }
        let (made, wanted) = (
            image::open(made).unwrap().to_rgb8(),
            image::open(wanted).unwrap().to_rgb8(),
        );
        assert_eq!(made.dimensions(), wanted.dimensions(), "{name}");
        let away = |(a, b): (&image::Rgb<u8>, &image::Rgb<u8>)| {
            a.0.iter()
                .zip(b.0)
                .map(|(a, b)| u32::from(a.abs_diff(b)))
                .max()
                .unwrap_or(0)
        };
        let differences: Vec<u32> = made.pixels().zip(wanted.pixels()).map(away).collect();
        let mean = f64::from(differences.iter().sum::<u32>()) / differences.len() as f64;
        // Drivers round edges differently; a look that is wrong differs all over.
        assert!(
            mean < 4.0,
            "{name}: mean difference {mean:.2} of 255; bless with KEYLEAF_BLESS=1 if it should be so"
        );
    }
}

#[test]
fn viewer_refuses_bad_scripts_and_missing_displays() {
    let folder = Folder::new("viewer-refuses");
    folder.write("bad.ron", "[Settle,\n Jump]");
    let nowhere = [("DISPLAY", ""), ("WAYLAND_DISPLAY", ""), ("WAYLAND_SOCKET", "")];
    for (arguments, part) in [
        ("view two.ron --script bad.ron", "bad.ron:2:"),
        ("view two.ron --script nothing.ron", "nothing.ron"),
        ("view two.ron", "display"),
        ("view two.ron --screenshot nowhere/a.png", "nowhere"),
    ] {
        let output = folder.run_in(arguments, &nowhere);
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{arguments}: {errors}");
        assert!(errors.contains(part), "{arguments}: {errors}");
    }
}
