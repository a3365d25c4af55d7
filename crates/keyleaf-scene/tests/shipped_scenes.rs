//! The scenes of the folder `scenes`: every one opens, and its camera path tries what is hard.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use glam::DVec3;
use keyleaf_key::{ONE, RootPoint};
use keyleaf_scene::scene::Metric;
use keyleaf_scene::{OpenOptions, OpenedScene, OpenedSurface, View, open};

/// Seconds a frame.
const STEP: f64 = 1.0 / 30.0;
/// Least height of an eye over the ground, metres.
const CLEARANCE: f64 = 1.0;

fn scenes() -> Vec<(PathBuf, OpenedScene)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let files = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> = files
        .filter(|file| file.extension().is_some_and(|e| e == "ron"))
        .collect();
    files.sort();
    files.into_iter().map(|file| (file.clone(), opened(&file))).collect()
}

fn opened(file: &Path) -> OpenedScene {
    open(file, &OpenOptions::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// Whether a surface is a height map or a terrain, not a mesh.
fn is_ground(surface: &OpenedSurface) -> bool {
    ["height_field", "terrain"]
        .iter()
        .any(|kind| surface.surface.shader().contains(kind))
}

/// Height of an eye over the ground, or its distance from the ground's box where it is beside it; `None` for meshes.
fn height_over(surface: &OpenedSurface, eye: DVec3) -> Option<f64> {
    if !is_ground(surface) {
        return None;
    }
    let in_object = surface.world_from_object.inverse().transform_point3(eye);
    let (low, high) = surface.surface.bounding_box();
    let (u, v) = (
        (in_object.x - low.x) / (high.x - low.x),
        (high.z - in_object.z) / (high.z - low.z),
    );
    match surface.surface.face_coord(0, u, v) {
        Ok(at) => Some(eye.y - surface.world_from_object.transform_point3(surface.surface.point(at)).y),
        Err(_) => Some(in_object.distance(in_object.clamp(low, high))),
    }
}

/// From this many roots on, fewer points a root.
const MANY_ROOTS: u32 = 500;

/// Points all over a mesh.
fn samples(surface: &OpenedSurface) -> Vec<DVec3> {
    let topology = surface.surface.topology();
    let side: u32 = if topology.half_edge_count() < MANY_ROOTS { 8 } else { 2 };
    let mut points = Vec::new();
    for place in topology.roots() {
        for (i, j) in (0..=side).flat_map(|i| (0..=side - i).map(move |j| (i, j))) {
            let at = RootPoint {
                face: place.face,
                root: place.root,
                x: i * (ONE / side),
                y: j * (ONE / side),
            };
            points.push(surface.world_from_object.transform_point3(surface.surface.point(at)));
        }
    }
    points
}

/// How near an eye is to what is drawn.
fn nearness(scene: &OpenedScene, meshes: &[DVec3], eye: DVec3) -> f64 {
    let over = scene.surfaces.iter().filter_map(|s| height_over(s, eye));
    let to_meshes = meshes.iter().map(|p| p.distance(eye));
    over.chain(to_meshes).fold(f64::INFINITY, f64::min)
}

#[test]
fn every_scene_has_cameras_and_a_path_with_a_fly_in_a_fast_turn_and_a_cut() {
    let scenes = scenes();
    assert!(scenes.len() >= 21, "only {} scenes", scenes.len());
    for (file, scene) in &scenes {
        let name = file.display();
        assert!(
            (2..=3).contains(&scene.scene.cameras.len()),
            "{name}: {} cameras",
            scene.scene.cameras.len()
        );
        let path = scene.path(None).unwrap();
        assert!((3.0..=6.0).contains(&path.duration()), "{name}: {} s", path.duration());
        let frames: Vec<_> = path.frames(STEP).collect();

        let first_cut = frames
            .iter()
            .position(|f| f.cut)
            .unwrap_or_else(|| panic!("{name}: no cut"));
        let meshes: Vec<DVec3> = scene
            .surfaces
            .iter()
            .filter(|s| height_over(s, DVec3::ZERO).is_none())
            .flat_map(samples)
            .collect();
        let near: Vec<f64> = frames[..first_cut]
            .iter()
            .map(|f| nearness(scene, &meshes, f.view.eye))
            .collect();
        let nearest = near.iter().copied().fold(f64::INFINITY, f64::min);
        assert!(
            near[0] > 10.0 * nearest,
            "{name}: no fly-in, from {} to {nearest}",
            near[0]
        );

        let turns = |pair: &[keyleaf_scene::Frame]| {
            let [from, .., to] = pair else { return false };
            pair[1..].iter().all(|f| !f.cut) && from.view.direction().dot(to.view.direction()) < 0.0
        };
        assert!(
            frames.windows(7).any(turns),
            "{name}: no turn of 90 degrees within 0.2 s"
        );
    }
}

#[test]
fn no_camera_is_below_the_ground() {
    for (file, scene) in scenes() {
        let paths = scene
            .scene
            .paths
            .iter()
            .flat_map(|path| path.frames(STEP).map(|frame| frame.view.eye));
        let cameras = scene.scene.cameras.iter().map(|camera| View::from(camera).eye);
        for eye in paths.chain(cameras) {
            for surface in &scene.surfaces {
                let over = height_over(surface, eye).unwrap_or(f64::INFINITY);
                assert!(
                    over >= CLEARANCE,
                    "{}: {eye} is {over} m over {}",
                    file.display(),
                    surface.name
                );
            }
        }
    }
}

#[test]
fn the_scenes_show_every_kind_of_surface_and_metric() {
    let scenes = scenes();
    let surfaces = || scenes.iter().flat_map(|(_, scene)| &scene.surfaces);
    let shaders: BTreeSet<&str> = surfaces().map(|s| s.surface.shader()).collect();
    for kind in [
        "mesh",
        "displaced_noise",
        "displaced_texture",
        "height_field",
        "terrain",
        "bezier_cubic",
        "nurbs",
        "nurbs_cubic",
        "gaussian_catmull_clark",
    ] {
        assert!(
            shaders.contains(format!("surfaces/{kind}.wgsl").as_str()),
            "{kind} is in no scene"
        );
    }
    assert!(surfaces().any(|s| matches!(s.settings.metric, Metric::Edge { .. })));
    assert!(surfaces().any(|s| matches!(s.settings.metric, Metric::Distance { .. })));
}

/// What importers said of a scene, one note a line.
fn notes(scene: &OpenedScene) -> String {
    scene.notes.iter().map(|note| format!("{note}\n")).collect()
}

#[test]
fn closed_scenes_of_patches_have_no_open_boundaries_and_the_poles_they_should() {
    let scenes = scenes();
    let check = |name: &str, poles: usize, open: usize| {
        let file = format!("{name}.ron");
        let (_, scene) = scenes.iter().find(|(f, _)| f.ends_with(&file)).unwrap();
        let notes = notes(scene);
        let said = |text: &str, number: usize| match number {
            0 => assert!(!notes.contains(text), "{file}: {notes}"),
            _ => assert!(notes.contains(&format!("{text}: {number}\n")), "{file}: {notes}"),
        };
        said("no other has the same curve with the same knots", open);
        said("points into which boundaries collapse (poles)", poles);
        assert!(!notes.contains("warning"), "{file}: {notes}");
    };
    check("goblet", 2, 0);
    check("torus", 0, 0);
    check("pot", 6, 0);
    // The outer sides of three by three panels.
    check("panels", 0, 12);
    check("quintic", 0, 4);
    check("crease", 0, 4);
}

#[test]
fn the_torus_is_round_and_the_goblet_faces_outwards() {
    let scenes = scenes();
    let surface = |name: &str| {
        let (_, scene) = scenes.iter().find(|(f, _)| f.ends_with(name)).unwrap();
        scene.surfaces[0].surface.clone()
    };
    let torus = surface("torus.ron");
    let goblet = surface("goblet.ron");
    for k in 0..200 {
        let (s, t) = (4.0 * f64::from(k) / 199.0, f64::from(k * 7 % 40) / 10.0);
        let p = torus.point(torus.own_coord(0, s, t).unwrap().at);
        let to_tube = DVec3::new(p.x.hypot(p.z) - 2.0, p.y, 0.0);
        assert!((to_tube.length() - 0.55).abs() < 1e-12, "{p}");
        let frame = goblet.frame(goblet.own_coord(0, s, 6.0).unwrap().at);
        assert!(frame.normal.dot(DVec3::new(frame.position.x, 0.0, frame.position.z)) > 0.0);
    }
}

#[test]
fn the_quintic_is_the_polynomial_that_it_says() {
    let scenes = scenes();
    let (_, scene) = scenes.iter().find(|(f, _)| f.ends_with("quintic.ron")).unwrap();
    let surface = &scene.surfaces[0].surface;
    for k in 0..=20 {
        let (u, v) = (f64::from(k) / 20.0, f64::from(k * 7 % 21) / 20.0);
        let p = surface.point(surface.own_coord(0, u, v).unwrap().at);
        let (x, z) = (p.x / 3.0, p.z / 3.0);
        let y = 0.4 * (x.powi(5) - 10.0 * x.powi(3) * z * z + 5.0 * x * z.powi(4));
        assert!((p.y - y).abs() < 1e-12, "{p}: {y}");
    }
}

#[test]
fn the_crease_is_sharp_in_the_middle_and_fades_at_its_ends() {
    let scenes = scenes();
    let (_, scene) = scenes.iter().find(|(f, _)| f.ends_with("crease.ron")).unwrap();
    let surface = &scene.surfaces[0].surface;
    let bend = |v: f64| {
        let normal = |u: f64| surface.frame(surface.own_coord(0, u, v).unwrap().at).normal;
        normal(1.0 - 1e-9).angle_between(normal(1.0)).to_degrees()
    };
    assert!(bend(1.5) > 60.0, "{}", bend(1.5));
    assert!(bend(0.0) < 1e-3 && bend(3.0) < 1e-3, "{} {}", bend(0.0), bend(3.0));
}
