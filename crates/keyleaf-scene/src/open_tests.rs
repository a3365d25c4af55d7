//! Opening scenes, models and height maps, and what is refused.

use super::*;
use crate::path::Frame;
use crate::scene::TerrainSource;

const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
    f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// A folder with a cube, a small map of 5x4 samples and a scene.
fn folder(name: &str, scene: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("keyleaf-open-{name}-{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("cube.obj"), CUBE).unwrap();
    let samples: Vec<u8> = (0..20u16).flat_map(|i| (100 + i * i).to_le_bytes()).collect();
    std::fs::write(folder.join("map.r16"), samples).unwrap();
    std::fs::write(folder.join("scene.ron"), scene).unwrap();
    folder
}

fn open_in(folder: &Path, name: &str) -> Result<OpenedScene, String> {
    let options = OpenOptions {
        raw_size: Some([5, 4]),
        ..OpenOptions::default()
    };
    open(&folder.join(name), &options).map_err(|e| e.to_string())
}

fn has_fly_in_turn_and_teleport(path: &CameraPath) {
    let frames: Vec<Frame> = path.frames(1.0 / 30.0).collect();
    assert!(frames.len() > 100 && frames.iter().any(|f| f.cut));
    let fastest = frames
        .windows(2)
        .filter(|w| !w[1].cut)
        .map(|w| w[0].view.direction().angle_between(w[1].view.direction()).to_degrees())
        .fold(0.0, f64::max);
    assert!(fastest > 8.0, "{fastest} degrees a frame");
    assert!(
        frames
            .iter()
            .all(|f| f.view.view_from_world().is_finite() && f.view.near > 0.0)
    );
}

#[test]
fn model_opens_directly_and_its_scene_opens_the_same() {
    let folder = folder("model", "");
    let opened = open_in(&folder, "cube.obj").unwrap();
    assert_eq!(opened.root_count(), 24);
    assert_eq!(opened.surfaces[0].surface.shader(), "surfaces/mesh.wgsl");
    assert_eq!(opened.surfaces[0].material.base_colour, [0.45, 0.45, 0.45, 1.0]);
    let camera = opened.camera(None).unwrap();
    assert!((DVec3::from(camera.look_at) - DVec3::splat(0.5)).length() < 1e-12);
    has_fly_in_turn_and_teleport(opened.path(None).unwrap());
    std::fs::write(folder.join("scene.ron"), opened.scene.to_ron().unwrap()).unwrap();
    let again = open_in(&folder, "scene.ron").unwrap();
    assert_eq!(again.scene, opened.scene);
    assert_eq!(again.root_count(), 24);
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn height_map_opens_directly_with_the_values_of_the_file() {
    let folder = folder("map", "");
    let opened = open_in(&folder, "map.r16").unwrap();
    let surface = &opened.surfaces[0].surface;
    for (i, j) in [(0, 0), (4, 0), (2, 1), (4, 3)] {
        let at = surface.face_coord(0, f64::from(i) / 4.0, f64::from(j) / 3.0).unwrap();
        let index = (3 - j) * 5 + i;
        let height = surface.point(at).y;
        assert!(
            (height - f64::from(100 + index * index)).abs() < 0.01,
            "{i} {j}: {height}"
        );
    }
    assert!(matches!(opened.surfaces[0].colouring, Colouring::Terrain(ref c) if c.heights == Some([100.0, 461.0])));
    let Source::HeightField(source) = &opened.scene.surfaces[0].source else {
        panic!()
    };
    assert!((source.spacing.unwrap()[0] * 4.0 - 6.0 * 361.0).abs() < 1e-9);
    has_fly_in_turn_and_teleport(opened.path(None).unwrap());
    std::fs::write(folder.join("scene.ron"), opened.scene.to_ron().unwrap()).unwrap();
    assert_eq!(open_in(&folder, "scene.ron").unwrap().scene, opened.scene);
    std::fs::remove_dir_all(folder).unwrap();
}

const SCENE: &str = r#"(
    surfaces: [
        (name: "cube", source: Mesh("cube.obj"), transform: (translation: (0, 200, 0)), settings: (max_level: 5),
         surface: Displaced(height: Noise(amplitude: 0.1, wavelength: 0.5))),
        (name: "map", source: HeightField(path: "map.r16", raw_size: (5, 4), spacing: (30, 30)),
         material: (texture: "picture.png")),
        (name: "terrain", source: Terrain(octaves: 6)),
    ],
    settings: (capacity: 32),
    cameras: [(name: "one", eye: (0, 0, 0), look_at: (0, 0, 1)), (name: "two", eye: (0, 0, 0), look_at: (1, 0, 0))],
)"#;

#[test]
fn scene_with_several_surfaces_is_loaded() {
    let folder = folder("scene", SCENE);
    image::RgbImage::new(2, 2).save(folder.join("picture.png")).unwrap();
    let opened = open_in(&folder, "scene.ron").unwrap();
    assert_eq!(opened.root_count(), 24 + 4 + 4);
    assert_eq!(opened.surfaces[0].settings.max_level, Some(5));
    assert_eq!(
        opened.surfaces[0].world_from_object.transform_point3(DVec3::ZERO).y,
        200.0
    );
    assert_eq!(opened.surfaces[1].material.texture.as_ref().unwrap().width, 2);
    assert_eq!(opened.surfaces[1].files.len(), 2);
    assert_eq!(opened.camera(Some("two")).unwrap().name, "two");
    assert!(opened.camera(Some("three")).is_none());
    has_fly_in_turn_and_teleport(opened.path(None).unwrap());
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn references_that_fail_name_the_scene_the_field_and_the_file() {
    let check = |name: &str, from: &str, to: &str, expected: &[&str]| {
        assert!(SCENE.contains(from), "{from}");
        let folder = folder(name, &SCENE.replacen(from, to, 1));
        image::RgbImage::new(2, 2).save(folder.join("picture.png")).unwrap();
        let error = open_in(&folder, "scene.ron").unwrap_err();
        for part in expected {
            assert!(error.contains(part), "{error}");
        }
        std::fs::remove_dir_all(folder).unwrap();
    };
    check(
        "mesh",
        "\"cube.obj\"",
        "\"cow.obj\"",
        &["scene.ron:3:32: surfaces[0].source: ", "cow.obj: cannot be read"],
    );
    check(
        "type",
        "\"cube.obj\"",
        "\"cube.xyz\"",
        &["surfaces[0].source: ", "unknown file type 'xyz'"],
    );
    check(
        "size",
        "raw_size: (5, 4)",
        "raw_size: (5, 5)",
        &["scene.ron:5:", "surfaces[1].source.path: ", "50 bytes, the file has 40"],
    );
    check(
        "picture",
        "picture.png",
        "scene.ron",
        &["scene.ron:6:", "surfaces[1].material.texture: ", "cannot be decoded"],
    );
    check(
        "capacity",
        "capacity: 32",
        "capacity: 23",
        &[
            "scene.ron:9:26: settings.capacity: 23",
            "the surface \"cube\" has 24 roots",
        ],
    );
    let uvs = "Displaced(height: Texture(path: \"picture.png\", amplitude: 1))";
    check(
        "uvs",
        "Displaced(height: Noise(amplitude: 0.1, wavelength: 0.5))",
        uvs,
        &["surfaces[0].surface.height: ", "texture coordinates"],
    );
}

#[test]
fn files_of_no_use_are_refused() {
    let folder = folder("refused", "(surfaces: 3)");
    assert!(
        open_in(&folder, "none.ron")
            .unwrap_err()
            .contains("none.ron: cannot be read")
    );
    assert!(
        open_in(&folder, "none.obj")
            .unwrap_err()
            .contains("none.obj: cannot be read")
    );
    assert!(open_in(&folder, "cube").unwrap_err().contains("unknown file type ''"));
    let error = open_in(&folder, "scene.ron").unwrap_err();
    assert!(
        error.contains("scene.ron:1:12: surfaces: expected opening `["),
        "{error}"
    );
    std::fs::write(folder.join("flat.r16"), [7u8; 40]).unwrap();
    let flat = open_in(&folder, "flat.r16").unwrap();
    assert!(
        flat.scene.paths[0]
            .keys
            .iter()
            .all(|k| k.eye.iter().all(|c| c.is_finite()))
    );
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn scenes_made_in_code_are_checked_too() {
    let text = "(surfaces: [(name: \"a\", source: Terrain())])";
    let mut scene = Scene::from_ron(text, Path::new("s.ron")).unwrap();
    assert!(load_scene(scene.clone(), Path::new("s.ron")).is_ok());
    scene.surfaces[0].source = Source::Terrain(TerrainSource {
        gain: f64::NAN,
        ..TerrainSource::default()
    });
    let error = load_scene(scene, Path::new("s.ron")).unwrap_err().to_string();
    assert!(error.contains("surfaces[0].source.gain: NaN"), "{error}");
}

/// Two bilinear patches that share a boundary, and a third apart from them.
const PATCHES: &str =
    "3\n1 1\n0 0 0\n1 0 0\n0 1 0\n1 1 2\n1 1\n1 0 0\n2 0 0\n1 1 2\n2 1 0\n1 1\n0 5 0\n1 5 0\n0 6 0\n0 6 0\n";

#[test]
fn patches_open_directly() {
    let folder = folder("patches", "");
    std::fs::write(folder.join("sheet.bpt"), PATCHES).unwrap();
    let opened = open_in(&folder, "sheet.bpt").unwrap();
    assert_eq!(opened.surfaces[0].surface.shader(), "surfaces/bezier_cubic.wgsl");
    assert_eq!(opened.surfaces[0].files.len(), 1);
    assert_eq!(opened.surfaces[0].world_from_object, DMat4::IDENTITY);
    let z_up = OpenOptions {
        z_up: true,
        ..OpenOptions::default()
    };
    let upright = open(&folder.join("sheet.bpt"), &z_up).unwrap();
    let up = upright.surfaces[0].world_from_object.transform_vector3(DVec3::Z);
    assert!((up - DVec3::Y).length() < 1e-15);
    let notes = opened
        .notes
        .iter()
        .map(|note| note.text.as_str())
        .collect::<Vec<_>>()
        .join("\n");
    for expected in [
        "pairs of boundaries joined: 1 (1 equal, 0 within",
        "same knots: 9",
        "collapse (poles): 1",
    ] {
        assert!(notes.contains(expected), "{notes}");
    }
    has_fly_in_turn_and_teleport(opened.path(None).unwrap());
    std::fs::write(folder.join("scene.ron"), opened.scene.to_ron().unwrap()).unwrap();
    assert_eq!(open_in(&folder, "scene.ron").unwrap().scene, opened.scene);
    let refused = std::fs::write(folder.join("broken.bpt"), PATCHES.replacen("1 1 2", "1 1 nan", 1));
    refused.unwrap();
    let error = open_in(&folder, "broken.bpt").unwrap_err();
    assert!(error.contains("broken.bpt: line 6: control point is NaN"), "{error}");
    std::fs::remove_dir_all(folder).unwrap();
}

const TRIMMED: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\ncstype bspline\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\n\
    parm u 0 0 1 1\nparm v 0 0 1 1\ntrim 0 1 1\nend\n";

#[test]
fn obj_with_surfaces_opens_as_patches_and_trims_are_ignored_on_request() {
    let folder = folder("surf", "");
    let file = folder.join("a.obj");
    std::fs::write(&file, TRIMMED).unwrap();
    let error = open_in(&folder, "a.obj").unwrap_err();
    assert!(
        error.contains("a.obj: line 10: 'trim': untrimmed surfaces only"),
        "{error}"
    );
    let options = OpenOptions {
        ignore_trims: true,
        ..OpenOptions::default()
    };
    let opened = open(&file, &options).unwrap();
    assert!(matches!(&opened.scene.surfaces[0].source, Source::Patches(p) if p.ignore_trims));
    assert!(opened.notes.iter().any(|note| {
        note.text
            .contains("surfaces whose trimming curves are ignored, drawn whole: 1")
    }));
    assert!(
        open_in(&folder, "cube.obj").unwrap().surfaces[0]
            .surface
            .shader()
            .contains("mesh")
    );
    std::fs::remove_dir_all(folder).unwrap();
}

const PATCH_SCENE: &str = r#"(surfaces: [
    (name: "file", source: Patches(path: "sheet.bpt", basis: Extraction)),
    (name: "strip", source: Nurbs(surfaces: [
        (degree: (1, 1), points: [[(0, 0, 0), (1, 0, 0)], [(0, 1, 0), (1, 1, 0)]]),
        (degree: (1, 1), points: [[(1.00001, 0, 0), (1, 1, 0)], [(2, 0, 0), (2, 1, 0)]]),
    ], tolerance: 1e-4, basis: Stair)),
    (name: "patch", source: Bezier(patches: [[[(0, 0, 0), (1, 0, 0)], [(0, 1, 0), (1, 1, 0)]]])),
])"#;

#[test]
fn scene_with_patches_is_loaded() {
    let folder = folder("patch-scene", PATCH_SCENE);
    std::fs::write(folder.join("sheet.bpt"), PATCHES).unwrap();
    let opened = open_in(&folder, "scene.ron").unwrap();
    let shaders: Vec<_> = opened.surfaces.iter().map(|s| s.surface.shader()).collect();
    assert_eq!(
        shaders,
        [
            "surfaces/nurbs_extraction.wgsl",
            "surfaces/nurbs_stair.wgsl",
            "surfaces/bezier_cubic.wgsl"
        ]
    );
    let said = |part: &str| {
        opened
            .notes
            .iter()
            .any(|note| note.file.ends_with("scene.ron") && note.text.contains(part))
    };
    assert!(said(
        "pairs of boundaries joined: 1 (0 equal, 1 within the tolerance, control points moved by at most "
    ));
    assert!(said("same side up: 1"));
    std::fs::write(folder.join("scene.ron"), PATCH_SCENE.replace("sheet.bpt", "none.bpt")).unwrap();
    let error = open_in(&folder, "scene.ron").unwrap_err();
    assert!(
        error.contains("scene.ron:2:42: surfaces[0].source.path: ") && error.contains("cannot be read"),
        "{error}"
    );
    std::fs::remove_dir_all(folder).unwrap();
}

const LONG_SHEET: &str =
    "Nurbs(even_spans: EVEN, surfaces: [(degree: (1, 1), points: [[(0, 0, 0), (1, 0, 0)], [(0, 8, 0), (1, 8, 0)]])])";

#[test]
fn knot_spans_are_cut_on_request_and_a_note_says_so() {
    let folder = folder("even-spans", "");
    let faces_and_notes = |source: &str| {
        let scene = format!("(surfaces: [(name: \"a\", source: {source})])");
        std::fs::write(folder.join("scene.ron"), scene).unwrap();
        let opened = open_in(&folder, "scene.ron").unwrap();
        let notes: Vec<String> = opened.notes.into_iter().map(|note| note.text).collect();
        (opened.surfaces[0].surface.topology().face_count(), notes.join("\n"))
    };
    let (faces, notes) = faces_and_notes(&LONG_SHEET.replace("EVEN", "false"));
    assert!(faces == 1 && !notes.contains("quads"), "{notes}");
    let (faces, notes) = faces_and_notes(&LONG_SHEET.replace("EVEN", "true"));
    assert_eq!(faces, 8);
    let expected = "knot-span quads: 8, of 1 before knot spans were cut to make them even, in 1 surfaces";
    assert!(notes.contains(expected), "{notes}");

    // Single Bézier patches stay so, unless a basis makes them NURBS surfaces.
    let long = "1\n1 1\n0 0 0\n0 9 0\n1 0 0\n1 9 0\n";
    std::fs::write(folder.join("long.bpt"), long).unwrap();
    let (faces, notes) = faces_and_notes("Patches(path: \"long.bpt\", even_spans: true)");
    assert!(
        faces == 1 && notes.contains("even_spans has no effect on single Bézier patches"),
        "{notes}"
    );
    let (faces, _) = faces_and_notes("Patches(path: \"long.bpt\", basis: Triangular, even_spans: true)");
    assert_eq!(faces, 8);
    let options = OpenOptions {
        even_spans: true,
        ..OpenOptions::default()
    };
    let opened = open(&folder.join("long.bpt"), &options).unwrap();
    assert!(matches!(&opened.scene.surfaces[0].source, Source::Patches(p) if p.even_spans));
    std::fs::remove_dir_all(folder).unwrap();
}
