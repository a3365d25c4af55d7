//! The control meshes of the folder `scenes/`: what each is there to show, it has.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use glam::DVec3;
use keyleaf_scene::scene::{Motion, Track};
use keyleaf_scene::{CageMotion, ControlMeshOptions, ControlModel, CovarianceSource, Scene, read_control_mesh};
use keyleaf_surface::gaussian::{Conditioning, CovarianceMesh, Symmetric3};

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(name)
}

fn read(name: &str) -> ControlModel {
    let model =
        read_control_mesh(&path(name), &ControlMeshOptions::default()).unwrap_or_else(|error| panic!("{error}"));
    assert!(model.notes.is_empty(), "{name}: {:?}", model.notes);
    model
}

/// Open edges of a mesh.
fn open_edges(model: &ControlModel) -> usize {
    let mesh = &model.control.mesh;
    let topology = mesh.topology().unwrap();
    let open = |(face, corners): (usize, &[u32])| {
        let is_open = |&root: &u32| topology.twin(face as u32, root).is_none();
        (0..corners.len() as u32).filter(is_open).count()
    };
    mesh.faces.iter().enumerate().map(open).sum()
}

#[test]
fn stars_have_poles_of_valence_3_to_12() {
    let model = read("valences.obj");
    assert_eq!(open_edges(&model), 0);
    let mut valences = BTreeMap::new();
    model
        .control
        .mesh
        .faces
        .iter()
        .flatten()
        .for_each(|&v| *valences.entry(v).or_insert(0u32) += 1);
    let found: BTreeSet<u32> = valences.into_values().collect();
    assert!((3..=12).all(|valence| found.contains(&valence)), "{found:?}");
}

#[test]
fn the_wheel_has_creases_of_four_kinds() {
    let model = read("gear.obj");
    assert_eq!(open_edges(&model), 0);
    let found: BTreeSet<u32> = model
        .control
        .creases
        .iter()
        .map(|c| (10.0 * c.sharpness) as u32)
        .collect();
    assert_eq!(found.into_iter().collect::<Vec<_>>(), [15, 20, 30, 100]);
}

#[test]
fn the_petal_is_open_and_the_starfish_has_only_triangles() {
    assert_eq!(open_edges(&read("petal.obj")), 2 * (8 + 4));
    let starfish = read("starfish.obj");
    assert_eq!(open_edges(&starfish), 0);
    assert!(starfish.control.mesh.faces.iter().all(|face| face.len() == 3));
}

#[test]
fn covariances_are_positive_definite_and_as_many_as_vertices() {
    for name in ["cube", "wirecube", "cylinder", "anvil"] {
        let options = ControlMeshOptions {
            covariances: CovarianceSource::Model,
            ..ControlMeshOptions::default()
        };
        let model = read_control_mesh(&path(&format!("gauss_{name}.obj")), &options).unwrap();
        assert_eq!(open_edges(&model), 0, "{name}");
        let matrices: Vec<Symmetric3> = model
            .covariances
            .unwrap()
            .into_iter()
            .map(Symmetric3::from_array)
            .collect();
        let mesh = CovarianceMesh::new(model.control, &matrices, Conditioning::Strict);
        let (mesh, changed) = mesh.unwrap_or_else(|error| panic!("{name}: {error}"));
        let worst = mesh.covariances().iter().map(|c| c.condition()).fold(0.0, f64::max);
        println!("{name}: condition up to {worst:.0}");
        assert!(changed.is_empty() && worst < 1e4, "{name}: {worst}");
    }
}

/// The figure of figure.ron.
fn figure() -> CageMotion {
    let scene = Scene::read(&path("figure.ron")).unwrap();
    let Motion::Keys(tracks) = &scene.surfaces[0].motion else {
        panic!("the figure does not move");
    };
    let mut motion = CageMotion::new(read("figure.obj").control.mesh.positions);
    motion.add_groups(tracks).unwrap();
    for track in tracks {
        if let Track::Blend(blend) = track {
            motion
                .add_blend(blend, &read(&blend.path).control.mesh.positions)
                .unwrap();
        }
    }
    motion
}

#[test]
fn the_figure_walks_in_a_loop_with_its_soles_near_the_ground() {
    let motion = figure();
    let (rest, period) = (motion.pose(0.0), motion.duration());
    let same = |a: &DVec3, b: &DVec3| a.distance(*b) < 1e-9;
    assert!(rest.iter().zip(&motion.pose(period)).all(|(a, b)| same(a, b)));
    let steps = 48;
    let mut before = rest;
    for step in 1..=steps {
        let posed = motion.pose(period * f64::from(step) / f64::from(steps));
        let lowest = posed.iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
        assert!((-0.3..0.3).contains(&lowest), "{step}: {lowest}");
        let fastest = posed
            .iter()
            .zip(&before)
            .map(|(a, b)| a.distance(*b))
            .fold(0.0, f64::max);
        assert!(fastest < 0.35, "{step}: a vertex jumps by {fastest}");
        before = posed;
    }
}
