//! OpenSubdiv's regression shapes and other models that are not part of the project, against tables that OpenSubdiv made of them.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use keyleaf_scene::{ControlMeshOptions, ControlModel, OpenOptions, ShapeName, open, read_control_mesh};
use keyleaf_surface::{BoundaryRule, Creasing};
use serde_json::Value;

/// The folder beside the repository; `None` if it is not there.
fn shared() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared");
    if folder.is_dir() {
        return Some(folder);
    }
    println!("skipped: there is no {}", folder.display());
    None
}

fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    files.retain(|file| file.extension().is_some_and(|e| e == ending));
    files.sort();
    files
}

fn list<'a>(table: &'a Value, name: &str) -> &'a [Value] {
    table[name].as_array().map_or(&[], Vec::as_slice)
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

/// The edges (or vertices) of a table's list, the smaller vertex first, with their sharpness in thousandths.
fn sharp(rows: impl Iterator<Item = Vec<f64>>) -> BTreeSet<Vec<u64>> {
    let row = |row: Vec<f64>| {
        let (sharpness, vertices) = row.split_last().unwrap();
        let mut key: Vec<u64> = vertices.iter().map(|&v| v as u64).collect();
        key.sort_unstable();
        key.push((sharpness * 1000.0).round() as u64);
        key
    };
    rows.map(row).collect()
}

/// A table has no creases at boundaries, and calls what is not manifold sharp: these are no tags of the file.
fn compare_sharpness(name: &str, model: &ControlModel, table: &Value) {
    let control = &model.control;
    let topology = control.mesh.topology().unwrap();
    let is_inside = |vertices: [u32; 2]| {
        let ends_match = |face: u32, root: u32, corners: &[u32]| {
            let (a, b) = (corners[root as usize], corners[(root as usize + 1) % corners.len()]);
            ([a, b] == vertices || [b, a] == vertices) && topology.twin(face, root).is_some()
        };
        let of_face = |(face, corners): (usize, &[u32])| {
            (0..corners.len() as u32).any(|root| ends_match(face as u32, root, corners))
        };
        control.mesh.faces.iter().enumerate().any(of_face)
    };
    let creases = control.creases.iter().filter(|crease| is_inside(crease.vertices));
    let creases = creases.map(|c| vec![f64::from(c.vertices[0]), f64::from(c.vertices[1]), c.sharpness]);
    assert_eq!(
        sharp(creases),
        sharp(list(table, "creases").iter().map(numbers)),
        "{name}: creases"
    );
    let rules = table["levels"][0]["rule"].as_str().unwrap().as_bytes();
    let tagged = list(table, "corners")
        .iter()
        .map(numbers)
        .filter(|corner| rules[corner[0] as usize] != b'n');
    let corners = control.corners.iter().map(|c| vec![f64::from(c.vertex), c.sharpness]);
    assert_eq!(sharp(corners), sharp(tagged), "{name}: corners");
}

/// Compares a model with its table.
fn compare(name: &str, model: &ControlModel, table: &Value) {
    let control = &model.control;
    let positions: Vec<Vec<f64>> = list(table, "verts").iter().map(numbers).collect();
    assert_eq!(control.mesh.positions.len(), positions.len(), "{name}");
    for (own, other) in control.mesh.positions.iter().zip(&positions) {
        // The tables were made from f32.
        let same = |(a, b): (f64, &f64)| (a - b).abs() <= f64::from(f32::EPSILON) * a.abs();
        assert!(
            own.to_array().into_iter().zip(other).all(same),
            "{name}: {own} {other:?}"
        );
    }
    let faces: Vec<Vec<u32>> = control.mesh.faces.iter().map(<[u32]>::to_vec).collect();
    let others: Vec<Vec<u32>> = list(table, "faces")
        .iter()
        .map(|face| numbers(face).iter().map(|&v| v as u32).collect())
        .collect();
    assert_eq!(faces, others, "{name}");
    compare_sharpness(name, model, table);
    let boundary = match control.boundary {
        BoundaryRule::None => "none",
        BoundaryRule::Edges => "edge_only",
        BoundaryRule::EdgesAndCorners => "edge_and_corner",
    };
    assert_eq!(Some(boundary), table["boundary"].as_str(), "{name}");
    let creasing = match control.creasing {
        Creasing::Uniform => "uniform",
        Creasing::Chaikin => "chaikin",
    };
    assert_eq!(Some(creasing), table["creasing"].as_str(), "{name}");
}

#[test]
fn every_shape_of_opensubdiv_has_the_vertices_faces_and_tags_that_opensubdiv_reads() {
    let Some(shared) = shared() else { return };
    let (mut compared, mut refused) = (0, Vec::new());
    for file in files(&shared.join("data/subd/osd_shapes"), "obj") {
        let stem = file.file_stem().unwrap().to_string_lossy().into_owned();
        let (folder, name) = match stem.split_once('_').unwrap() {
            ("catmark", name) => ("cc", name),
            (folder, name) => (folder, name),
        };
        match read_control_mesh(&file, &ControlMeshOptions::default()) {
            Ok(model) => {
                let table = shared.join(format!("oracles/{folder}/{name}.json"));
                let Ok(text) = std::fs::read_to_string(&table) else {
                    println!("{stem}: no table");
                    continue;
                };
                compare(&stem, &model, &serde_json::from_str(&text).unwrap());
                compared += 1;
            }
            Err(error) => {
                let error = error.to_string();
                let is_named = error.contains("used by") || error.contains("are the same vertex");
                assert!(is_named && error.contains("(in the file: line "), "{error}");
                refused.push(stem);
            }
        }
    }
    println!("{compared} shapes agree; refused: {refused:?}");
    assert!(compared >= 40, "{compared}");
    for stem in &refused {
        assert!(
            stem.contains("nonman_edges") || stem.contains("val2") || stem.contains("fan"),
            "{stem}"
        );
    }
}

/// Without a rule for boundaries a face at a boundary is control data: 4 of the 36 faces of OpenSubdiv's shape for that rule are drawn.
#[test]
fn opening_a_shape_without_a_rule_for_boundaries_tells_how_many_faces_are_left_out() {
    let Some(shared) = shared() else { return };
    let options = OpenOptions {
        shape: Some(ShapeName::CatmullClark),
        ..OpenOptions::default()
    };
    let file = shared.join("data/subd/osd_shapes/catmark_edgenone.obj");
    let opened = open(&file, &options).unwrap();
    let surface = &opened.surfaces[0].surface;
    assert_eq!(surface.topology().face_count(), 4);
    let drawn: Vec<u32> = (0..36)
        .filter(|&face| surface.face_coord(face, 0.5, 0.5).is_ok())
        .collect();
    assert_eq!(drawn, [4, 13, 22, 31]);
    let is_told = |text: &str| text.contains("not drawn, since the boundary rule is none: 32 of 36");
    let note = opened.notes.iter().find(|note| is_told(&note.text)).expect("a note");
    assert_eq!(note.file, file);
}

#[test]
fn spot_and_the_models_of_gaussian_products_are_read() {
    let Some(shared) = shared() else { return };
    let read = |path: &str| read_control_mesh(&shared.join(path), &ControlMeshOptions::default()).unwrap();
    let text = std::fs::read_to_string(shared.join("oracles/cc/spot_control.json")).unwrap();
    compare(
        "spot",
        &read("data/subd/spot_control_mesh.obj"),
        &serde_json::from_str(&text).unwrap(),
    );
    let count = |model: &ControlModel| (model.control.mesh.positions.len(), model.control.mesh.faces.len());
    assert_eq!(count(&read("data/gps/tweety.off")), (192, 380));
    let cone = read("data/gps/cone.off");
    let text = std::fs::read_to_string(shared.join("oracles/gps/cone_pointy_warren.json")).unwrap();
    let table: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(count(&cone), (list(&table, "verts").len(), list(&table, "faces").len()));
}

/// The text of a covariance file, as a program would write it.
fn covariance_text(covariances: &[Value]) -> String {
    let line = |row: &Value| numbers(row).iter().map(f64::to_string).collect::<Vec<_>>().join(" ") + "\n";
    let lines: String = covariances.iter().map(line).collect();
    format!("covariances {}\n{lines}", covariances.len())
}

#[test]
fn covariances_of_every_table_read_back_bit_by_bit() {
    let Some(shared) = shared() else { return };
    for file in files(&shared.join("oracles/gps"), "json") {
        let table: Value = serde_json::from_str(&std::fs::read_to_string(&file).unwrap()).unwrap();
        let covariances = list(&table, "cov6_xx_xy_xz_yy_yz_zz");
        let name = file.file_stem().unwrap().to_string_lossy().into_owned();
        let path = std::env::temp_dir().join(format!("keyleaf-{name}-{}.cov", std::process::id()));
        std::fs::write(&path, covariance_text(covariances)).unwrap();
        let read = keyleaf_scene::read_covariances(&path, covariances.len()).unwrap();
        std::fs::remove_file(&path).unwrap();
        for (own, other) in read.iter().zip(covariances) {
            assert_eq!(own.to_vec(), numbers(other), "{name}");
        }
    }
}
