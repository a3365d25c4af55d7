//! What `render` draws.

use super::Folder;

fn picture(folder: &Folder, name: &str) -> image::DynamicImage {
    image::open(folder.0.join(name)).unwrap()
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
