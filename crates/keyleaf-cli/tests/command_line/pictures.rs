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

/// What an evaluator computes for vertices is tested elsewhere; here it is what the draw makes of it, idle lanes included.
#[test]
fn every_way_to_compute_basis_functions_draws_the_same_picture() {
    let folder = Folder::new("basis-pictures");
    let scenes = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    std::fs::copy(scenes.join("torus.obj"), folder.0.join("torus.obj")).unwrap();
    let text = std::fs::read_to_string(scenes.join("torus.ron")).unwrap();
    let drawn = |basis: &str| {
        let of_basis = format!("\"torus.obj\", basis: Some({basis})");
        folder.write("basis.ron", text.replace("\"torus.obj\"", &of_basis));
        folder.succeed(&format!(
            "render basis.ron -o {basis}.png --size 160x120 --pixels 24 --base-grid 1"
        ));
        picture(&folder, &format!("{basis}.png")).to_rgb8()
    };
    let expected = drawn("Triangular");
    for basis in ["DeBoor", "Stair", "Extraction", "Power"] {
        let made = drawn(basis);
        let differences = made.pixels().zip(expected.pixels()).map(|(a, b)| {
            let channels = a.0.iter().zip(b.0);
            channels.map(|(a, b)| u32::from(a.abs_diff(b))).max().unwrap_or(0)
        });
        let different = differences.filter(|difference| *difference > 8).count();
        assert!(different <= 20, "{basis}: {different} pixels of 19200 differ");
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
