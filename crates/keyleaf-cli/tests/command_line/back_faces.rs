//! What is left out of the picture because it is seen from behind.

use crate::Folder;
use crate::oracles::shared;
use serde_json::Value;

/// A picture and the number of visible leaves.
fn picture(folder: &Folder, scene: &str, options: &str) -> (Vec<u8>, u64) {
    let output = folder.run(&format!(
        "render {scene} -o picture.png --size 320x240 --json --quiet {options}"
    ));
    assert!(
        output.status.success(),
        "{scene} {options}: {}",
        String::from_utf8_lossy(&output.stderr)
    );
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    (folder.read_bytes("picture.png"), report["visible"].as_u64().unwrap())
}

#[test]
fn conservative_culling_of_faces_changes_no_pixel_and_draws_less() {
    let folder = Folder::new("back-faces");
    for scene in ["goblet", "torus", "pot", "panels"] {
        let scene = format!("{}/../../scenes/{scene}.ron", env!("CARGO_MANIFEST_DIR"));
        let with = |how: &str| picture(&folder, &scene, &format!("--pixels 4 --back-faces {how}"));
        let (hidden, all) = with("hidden");
        let (conservative, kept) = with("conservative");
        assert_eq!(hidden, conservative, "{scene}");
        let (leaves, facing) = with("leaves");
        assert_eq!(hidden, leaves, "{scene}");
        assert!(facing < kept, "{scene}: {facing} of {kept} leaves");
        assert!(kept < all, "{scene}: {kept} of {all} leaves");
        let ((_, light), (_, strong)) = (with("light"), with("strong"));
        println!("{scene}: {all} leaves, conservative {kept}, leaves {facing}, strong {strong}, light {light}");
        assert!(light < all && strong < all);
        let plan = |how: &str| {
            let output = folder.run(&format!("plan {scene} --json --quiet --back-faces {how}"));
            serde_json::from_slice::<Value>(&output.stdout).unwrap()["surfaces"][0].clone()
        };
        assert_eq!(plan("strong")["approximate"], true);
        assert_eq!(plan("conservative")["approximate"], false);
        let has_cull = |how: &str| plan(how).to_string().contains("cull_faces");
        assert_eq!(["drawn", "hidden", "light"].map(has_cull), [false, false, true]);
    }
}

/// Pixels in which two pictures differ, and the greatest difference of a channel.
fn differences(a: &[u8], b: &[u8]) -> (usize, u8) {
    let [a, b] = [a, b].map(|png| image::load_from_memory(png).unwrap().into_rgb8());
    assert_eq!(a.dimensions(), b.dimensions());
    let pixels = a.pixels().zip(b.pixels());
    let off = pixels.map(|(a, b)| (0..3).map(|k| a.0[k].abs_diff(b.0[k])).max().unwrap());
    off.filter(|&off| off > 0)
        .fold((0, 0), |(count, most), off| (count + 1, most.max(off)))
}

/// Sheets, of which nothing need be left out, and models of others. Where surfaces lie along each other and are not joined, the order of
/// leaves decides samples at equal depth: a pixel of the head varies by one level from run to run, with any setting.
#[test]
fn conservative_culling_of_faces_changes_no_pixel_of_other_models() {
    let folder = Folder::new("back-faces-of-others");
    let scenes = ["crease", "quintic"].map(|name| format!("{}/../../scenes/{name}.ron", env!("CARGO_MANIFEST_DIR")));
    let models = [
        "teaset/teapot",
        "teaset/teacup",
        "teaset/teaspoon",
        "nurbs/v2_Speeder.obj",
        "nurbs/v2_UntrimmedSurfaces.obj",
        "nurbs/v2_HumanHead1.obj",
        "nurbs/v5_teapot.obj",
    ];
    let models = models.iter().filter_map(|name| shared(&format!("data/{name}")));
    for model in scenes.into_iter().chain(models.map(|path| path.display().to_string())) {
        let with = |how: &str| {
            let options = format!("--pixels 16 --ignore-trims --back-faces {how}");
            picture(&folder, &model, &options)
        };
        let ((hidden, all), (conservative, kept)) = (with("hidden"), with("conservative"));
        println!("{model}: {all} leaves, conservative {kept}");
        let (pixels, most) = differences(&hidden, &conservative);
        assert!(pixels <= 4 && most <= 2, "{model}: {pixels} pixels, by {most}");
    }
}

/// A flat patch whose control squares all face away at their corners, while a part of it faces the eye (`sqc_counterexample.json`,
/// where that is there).
#[test]
fn strong_culling_as_printed_loses_what_conservative_culling_keeps() {
    let file =
        std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/oracles/nurbs/sqc_counterexample.json");
    let Ok(text) = std::fs::read_to_string(&file) else {
        println!("skipped: there is no {}", file.display());
        return;
    };
    let table: Value = serde_json::from_str(&text).unwrap();
    let folder = Folder::new("counterexample");
    let mut patch = String::from("1\n3 3\n");
    for row in table["ctrl_xy"].as_array().unwrap() {
        for point in row.as_array().unwrap() {
            patch += &format!("{} {} 0\n", point[0], point[1]);
        }
    }
    folder.write("patch.bpt", patch);
    let with = |how: &str| {
        picture(
            &folder,
            "patch.bpt",
            &format!("--eye 2,-2,40 --look-at 2,-2,0 --fov 10 --pixels 8 --back-faces {how}"),
        )
    };
    let (hidden, all) = with("hidden");
    let (conservative, kept) = with("conservative");
    let (strong, left) = with("strong");
    assert_eq!((hidden == conservative, kept), (true, all));
    assert_eq!(left, 0, "every square faces away");
    assert_ne!(hidden, strong, "a part of the patch faces the eye");
}

#[test]
fn faces_are_culled_of_patches_only() {
    let folder = Folder::new("no-net");
    let output = folder.run("render cube.obj -o cube.png --back-faces conservative");
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(
        message.contains("back_faces") && message.contains("only Bézier and NURBS surfaces"),
        "{message}"
    );
    assert!(!folder.files().contains(&"cube.png".to_owned()));
    assert!(
        folder
            .run("render cube.obj -o cube.png --size 64x64 --back-faces hidden")
            .status
            .success()
    );
}
