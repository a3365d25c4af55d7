//! Scene files: what is read, what is written, what is refused and where.

use super::*;
use glam::DVec3;

/// Every kind of field, on lines that the tests name.
const FULL: &str = r#"// a comment with ( and "
Scene(
    surfaces: [
        Surface(
            name: "cow",
            source: Mesh("models/cow.obj"),
            surface: Displaced(height: Noise(amplitude: 0.02, wavelength: 0.3)),
            transform: (translation: (1, 2, 3), rotation: (0, 90, 0), scale: 2.5),
            material: (base_colour: (0.8, 0.5, 0.3), texture: "cow.png"),
            settings: (metric: Distance(factor: 0.1), max_level: 9),
        ),
        (
            name: "map", /* another */ source: HeightField(path: "map.png", spacing: (90, 92.6), void_value: -9999),
            material: (colouring: Terrain(slopes: (20, 40))),
        ),
        (name: "ground", source: Terrain(height: 500, octaves: 12)),
    ],
    settings: (
        metric: Edge(pixels: 4),
        base_grid: 3,
        capacity: 100000,
        settle: 2,
        target_leaves: 50000,
        max_level: Some(20),
        guard_band: (margin: 0.5, coarsen: 4),
        culling: Off,
    ),
    light: (azimuth: 200, elevation: 20),
    effects: [Sky, Fog(distance: 3000), Wireframe, LevelTint],
    cameras: [(name: "front", eye: (0, 1, 5), look_at: (0, 1, 0), fov: 40, near: 0.01)],
    paths: [
        (
            name: "round",
            keys: [
                (time: 0, eye: (0, 1, 5), look_at: (0, 1, 0)),
                (time: 2, eye: (5, 1, 0), look_at: (0, 1, 0), fov: 60, ease: Smooth),
                (time: 3, eye: (0, 9, 0), look_at: (0, 1, 0), cut: true),
            ],
            looped: true,
        ),
    ],
)
"#;

fn read(text: &str) -> Result<Scene, String> {
    Scene::from_ron(text, Path::new("s.ron")).map_err(|e| e.to_string())
}

/// The error of a full scene with one replacement.
fn broken(from: &str, to: &str) -> String {
    assert!(FULL.contains(from), "{from}");
    read(&FULL.replacen(from, to, 1)).unwrap_err()
}

#[test]
fn every_field_is_read_and_written_back() {
    let scene = read(FULL).unwrap();
    assert_eq!(scene.settings.metric, Metric::Edge { pixels: 4.0 });
    assert_eq!(
        scene.settings.with(&scene.surfaces[0].settings).metric,
        Metric::Distance { factor: 0.1 }
    );
    assert_eq!(scene.settings.with(&scene.surfaces[0].settings).deepest_level(), 9);
    assert_eq!(scene.effects.len(), 4);
    assert!(scene.paths[0].keys[2].cut && scene.paths[0].looped);
    let text = scene.to_ron().unwrap();
    assert_eq!(read(&text).unwrap(), scene, "{text}");
}

#[test]
fn little_is_needed() {
    let scene = read("(surfaces: [(name: \"a\", source: Terrain())])").unwrap();
    assert_eq!(scene.effects, [Effect::Sky]);
    assert_eq!(scene.settings, Settings::default());
    assert_eq!(scene.settings.deepest_level(), 29);
    assert_eq!(read(&scene.to_ron().unwrap()).unwrap(), scene);
    assert!(read("(surfaces: [(name: \"a\", source: Terrain(), material: (colouring: Terrain()))])").is_ok());
}

#[test]
fn unknown_names_tell_line_column_and_what_was_expected() {
    let error = broken("base_grid: 3", "base_gird: 3");
    assert!(
        error.starts_with("s.ron:20:9: settings: unknown field `base_gird`, expected one of `metric`, `base_grid`"),
        "{error}"
    );
    let error = broken("fov: 60", "fow: 60");
    assert!(
        error.starts_with("s.ron:36:63: paths[0].keys[1]: unknown field `fow`, expected one of"),
        "{error}"
    );
    let error = broken("Edge(pixels: 4)", "Edges(pixels: 4)");
    assert!(
        error.starts_with("s.ron:19:")
            && error.contains("settings.metric: unknown choice `Edges`, expected one of `Edge`, `Distance`"),
        "{error}"
    );
    let error = broken("path: \"map.png\", ", "");
    assert!(
        error.contains("missing field `path`") && error.starts_with("s.ron:13:"),
        "{error}"
    );
    let error = broken("amplitude: 0.02, ", "");
    assert!(
        error.starts_with("s.ron:7:") && error.contains("surfaces[0].surface.height: missing field"),
        "{error}"
    );
    let error = broken("name: \"front\", ", "");
    assert!(error.contains("cameras[0]: missing field `name`"), "{error}");
}

#[test]
fn wrong_types_and_broken_text_tell_the_field() {
    let error = broken("base_grid: 3", "base_grid: \"three\"");
    assert!(
        error.starts_with("s.ron:20:") && error.contains("settings.base_grid: "),
        "{error}"
    );
    let error = broken("base_grid: 3", "base_grid: -3");
    assert!(
        error.starts_with("s.ron:20:") && error.contains("settings.base_grid: "),
        "{error}"
    );
    let error = broken("eye: (5, 1, 0)", "eye: (5, 1)");
    assert!(
        error.starts_with("s.ron:36:") && error.contains("paths[0].keys[1].eye: "),
        "{error}"
    );
    assert!(broken("capacity: 100000", "capacity 100000").starts_with("s.ron:21:"));
    assert!(broken("cut: true", "cut: yes").contains("paths[0].keys[2].cut: "));
    assert!(read("").unwrap_err().starts_with("s.ron:1:1"));
    assert!(read(&FULL[..FULL.len() - 3]).unwrap_err().starts_with("s.ron:4"));
}

#[test]
fn values_out_of_range_tell_line_and_field() {
    let cases = [
        (
            "Edge(pixels: 4)",
            "Edge(pixels: -4)",
            "s.ron:19:30: settings.metric.pixels: -4 is not allowed; expected a number above 0",
        ),
        (
            "Edge(pixels: 4)",
            "Edge(pixels: NaN)",
            "s.ron:19:30: settings.metric.pixels: NaN",
        ),
        ("factor: 0.1", "factor: 0", "surfaces[0].settings.metric.factor: 0"),
        (
            "base_grid: 3",
            "base_grid: 7",
            "s.ron:20:20: settings.base_grid: 7 is not allowed; expected a number from 0 to 6",
        ),
        ("capacity: 100000", "capacity: 0", "s.ron:21:19: settings.capacity: 0"),
        ("settle: 2", "settle: 0", "settings.settle"),
        (
            "Edge(pixels: 4)",
            "Deviation(pixels: 4), morph: Geomorph",
            "settings.metric: vertices morph by metrics that halve from level to level; expected Edge",
        ),
        (
            "target_leaves: 50000",
            "target_leaves: 500000",
            "settings.target_leaves: 500000",
        ),
        (
            "Some(20)",
            "29",
            "s.ron:24:20: settings.max_level: 29 is not allowed; expected a number from 0 to 28",
        ),
        ("coarsen: 4", "coarsen: 0.5", "settings.guard_band.coarsen"),
        (
            "fov: 40",
            "fov: 180",
            "s.ron:30:72: cameras[0].fov: 180 is not allowed; expected a number above 0 and below 180",
        ),
        ("near: 0.01", "near: 0", "cameras[0].near"),
        (
            "look_at: (0, 1, 0), fov: 40",
            "look_at: (0, 1, 5), fov: 40",
            "cameras[0].look_at: it is the same point as eye",
        ),
        (
            "time: 2",
            "time: 3",
            "paths[0].keys[2].time: 3 is not later than the key before, 3",
        ),
        ("time: 2", "time: inf", "paths[0].keys[1].time: inf"),
        ("scale: 2.5", "scale: 0", "surfaces[0].transform.scale"),
        ("(1, 2, 3)", "(1, NaN, 3)", "surfaces[0].transform.translation: NaN"),
        (
            "base_colour: (0.8",
            "base_colour: (1.8",
            "surfaces[0].material.base_colour: 1.8",
        ),
        (
            "slopes: (20, 40)",
            "slopes: (40, 20)",
            "surfaces[1].material.colouring.slopes",
        ),
        ("octaves: 12", "octaves: 90", "surfaces[2].source.octaves: 90"),
        (
            "wavelength: 0.3",
            "wavelength: -1",
            "surfaces[0].surface.height.wavelength: -1",
        ),
        (
            "\"map\"",
            "\"cow\"",
            "s.ron:13:19: surfaces[1].name: the name `cow` is there twice",
        ),
        ("distance: 3000", "distance: 0", "effects[1].distance"),
        ("LevelTint", "Sky", "s.ron:29:52: effects[3]: the effect is there twice"),
        ("elevation: 20", "elevation: 91", "light.elevation"),
    ];
    for (from, to, expected) in cases {
        let error = broken(from, to);
        assert!(error.contains(expected), "{to}: {error}");
    }
    let error = broken(
        "surface: Displaced",
        "surface: Flat, settings: (), material: (), transform: (), name: \"b\", source: Terrain(), surface: Displaced",
    );
    assert!(error.contains("there twice") || error.contains("field"), "{error}");
}

#[test]
fn empty_lists_are_refused() {
    assert!(
        read("(surfaces: [])")
            .unwrap_err()
            .contains("1:12: surfaces: a scene needs at least one surface")
    );
    let error = read("(surfaces: [(name: \"a\", source: Terrain())],\n paths: [(name: \"p\", keys: [])])").unwrap_err();
    assert_eq!(error, "s.ron:2:28: paths[0].keys: a camera path needs at least one key");
    assert!(
        read("(surfaces: [(name: \" \", source: Terrain())])")
            .unwrap_err()
            .contains("the name is empty")
    );
    let moved = "(surfaces: [(name: \"a\", source: Terrain(), surface: Displaced(height: Noise(amplitude: 1, wavelength: 1)))])";
    assert!(read(moved).unwrap_err().contains("only a Mesh can be Displaced"));
}

#[test]
fn damaged_scenes_never_panic() {
    for length in (0..FULL.len()).filter(|&l| FULL.is_char_boundary(l)) {
        let _ = read(&FULL[..length]);
    }
    let mut state = 7u64;
    let mut random = |below: usize| {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 33) as usize % below
    };
    for _ in 0..3000 {
        let mut bytes = FULL.as_bytes().to_vec();
        let at = random(bytes.len());
        bytes[at] = b"()[]\",:'/*r#-9\\ "[random(16)];
        let _ = read(&String::from_utf8_lossy(&bytes));
    }
    let _ = read(&"[".repeat(5000));
    let _ = read(&"(a:".repeat(5000));
}

#[test]
fn rotations_are_about_fixed_axes_in_order() {
    let transform = Transform {
        rotation: [90.0, 0.0, 90.0],
        translation: [0.0, 0.0, 1.0],
        scale: 2.0,
    };
    // About X: Y to Z; about Z: Z stays.
    let moved = transform.matrix().transform_point3(DVec3::Y);
    assert!((moved - DVec3::new(0.0, 0.0, 3.0)).length() < 1e-12);
    // About X: X stays; about Z: X to Y.
    let moved = transform.matrix().transform_point3(DVec3::X);
    assert!((moved - DVec3::new(0.0, 2.0, 1.0)).length() < 1e-12);
}

#[test]
fn the_sun_stands_where_azimuth_and_elevation_say() {
    let sun = |azimuth, elevation| {
        Light {
            azimuth,
            elevation,
            ..Light::default()
        }
        .direction()
    };
    assert!((sun(0.0, 0.0) - DVec3::NEG_Z).length() < 1e-12);
    assert!((sun(90.0, 0.0) - DVec3::X).length() < 1e-12);
    assert!((sun(33.0, 90.0) - DVec3::Y).length() < 1e-12);
}
