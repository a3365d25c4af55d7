//! Subdivision surfaces and QAS as the GPU draws and exports them, against tables of exact numbers, where those are there.

use crate::Folder;
use crate::oracles::{EPSILON, evaluate, floats, table};
use glam::DVec3;
use serde_json::Value;
use std::collections::HashMap;
use std::fmt::Write;

const CATMULL_CLARK: [&str; 10] = [
    "cube",
    "cube_creases0",
    "cube_corner1",
    "chaikin0",
    "dart_edgeonly",
    "edgecorner",
    "nonquads",
    "tent_creases0",
    "xord_boundary",
    "xord_interior",
];
const LOOP: [&str; 7] = [
    "icosahedron",
    "tetrahedron",
    "chaikin0",
    "cube_creases0",
    "icos_semisharp",
    "saddle_edgeonly",
    "xord_interior",
];

/// The control mesh of a table as an OBJ with OpenSubdiv's tags.
fn obj(table: &Value) -> String {
    let mut text = String::new();
    let list = |name: &str| table[name].as_array().cloned().unwrap_or_default();
    for vertex in list("verts").iter().map(floats) {
        writeln!(text, "v {} {} {}", vertex[0], vertex[1], vertex[2]).unwrap();
    }
    for face in list("faces").iter().map(floats) {
        let corners: String = face.iter().map(|v| format!(" {}", v + 1.0)).collect();
        writeln!(text, "f{corners}").unwrap();
    }
    for crease in list("creases").iter().map(floats) {
        writeln!(text, "t crease 2/1/0 {} {} {}", crease[0], crease[1], crease[2]).unwrap();
    }
    for corner in list("corners").iter().map(floats) {
        writeln!(text, "t corner 1/1/0 {} {}", corner[0], corner[1]).unwrap();
    }
    let rule = ["none", "edge_and_corner", "edge_only"]
        .iter()
        .position(|&rule| table["boundary"] == rule);
    writeln!(text, "t interpolateboundary 1/0/0 {}", rule.unwrap()).unwrap();
    if table["creasing"] == "chaikin" {
        writeln!(text, "t creasemethod 0/0/1 chaikin").unwrap();
    }
    text
}

fn largest(table: &Value) -> f64 {
    let vertices = table["verts"].as_array().unwrap();
    vertices
        .iter()
        .flat_map(floats)
        .fold(0.0, |most, x| f64::max(most, x.abs()))
}

/// Positions with their normals of an exported OBJ, by cells of a grid.
struct Vertices {
    cell: f64,
    at: HashMap<[i64; 3], Vec<(DVec3, DVec3)>>,
}

impl Vertices {
    fn read(text: &str, cell: f64) -> Self {
        let of = |kind: &str| -> Vec<DVec3> {
            let lines = text.lines().filter_map(|line| line.strip_prefix(kind));
            lines
                .map(|line| {
                    let numbers: Vec<f64> = line.split_whitespace().map(|n| n.parse().unwrap()).collect();
                    DVec3::from_slice(&numbers)
                })
                .collect()
        };
        let (positions, normals) = (of("v "), of("vn "));
        assert_eq!(positions.len(), normals.len(), "a normal a vertex");
        let mut vertices = Self {
            cell,
            at: HashMap::new(),
        };
        for (position, normal) in positions.into_iter().zip(normals) {
            let place = vertices.place(position);
            vertices.at.entry(place).or_default().push((position, normal));
        }
        vertices
    }

    fn place(&self, position: DVec3) -> [i64; 3] {
        (position / self.cell).floor().to_array().map(|x| x as i64)
    }

    /// The vertex nearest to a point, if one is closer than a cell.
    fn nearest(&self, point: DVec3) -> Option<(DVec3, DVec3)> {
        let [x, y, z] = self.place(point);
        let cells = (0..27).map(|k| [x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1]);
        let near = cells.filter_map(|cell| self.at.get(&cell)).flatten();
        near.copied()
            .min_by(|a, b| a.0.distance(point).total_cmp(&b.0.distance(point)))
    }
}

/// How many faces each vertex of a level has.
fn faces_by_vertex(level: &Value) -> HashMap<usize, u32> {
    let mut counts = HashMap::new();
    for face in level["faces"].as_array().unwrap().iter().map(floats) {
        face.iter().for_each(|&v| *counts.entry(v as usize).or_default() += 1);
    }
    counts
}

/// Limits of vertices whose sharpness outlasts the table are those of its last level, not of the surface.
fn outlasts(table: &Value, level: usize) -> bool {
    let sharp = |list: &str, at: usize| {
        let rows = table[list].as_array().cloned().unwrap_or_default();
        rows.iter()
            .map(floats)
            .any(|row| row[at] < 10.0 && row[at] > level as f64)
    };
    sharp("creases", 2) || sharp("corners", 1)
}

fn exported_limits(folder_name: &str, scheme: &str, names: &[&str]) {
    for name in names {
        let Some(table) = table(&format!("{folder_name}/{name}")) else {
            return;
        };
        let folder = Folder::new(&format!("limit-{folder_name}-{name}"));
        folder.write("model.obj", obj(&table));
        let levels = table["levels"].as_array().unwrap();
        let (last, level) = (levels.last().unwrap(), levels.len() - 1);
        let output = folder.run(&format!(
            "export model.obj --surface {scheme} --uniform {level} --base-grid 0 --normals -o out.obj --quiet"
        ));
        assert!(
            output.status.success(),
            "{name}: {}",
            String::from_utf8_lossy(&output.stderr)
        );
        let bound = 16.0 * EPSILON * largest(&table);
        let vertices = Vertices::read(&folder.read("out.obj"), 1e3 * bound);
        let (limits, normals) = (last["limit"].as_array().unwrap(), last["normal"].as_array().unwrap());
        let (mut worst, mut worst_normal): (f64, f64) = (0.0, 0.0);
        if outlasts(&table, level) {
            println!("{name}: sharper than the table is deep, limits not compared");
            continue;
        }
        let faces_at = faces_by_vertex(last);
        for (vertex, (limit, normal)) in limits.iter().zip(normals).enumerate() {
            let limit = DVec3::from_slice(&floats(limit));
            let Some((position, own)) = vertices.nearest(limit) else {
                panic!("{name}: no vertex near {limit}");
            };
            worst = worst.max((position - limit).abs().max_element());
            // At a smooth corner of one face du and dv are parallel: the normal there is only a unit vector.
            let is_lone = faces_at.get(&vertex) == Some(&1);
            if !normal.is_null() && !is_lone {
                let exact = DVec3::from_slice(&floats(normal));
                worst_normal = worst_normal.max(own.distance(exact));
            }
        }
        println!(
            "{name}: {:.2} eps M, normals {worst_normal:.1e} rad",
            16.0 * worst / bound
        );
        assert!(worst <= bound, "{name}: {worst:e} of {bound:e}");
        assert!(worst_normal <= 1e-4, "{name}: {worst_normal:e} rad");
        samples_agree(&folder, &table, name, scheme);
    }
}

/// Points inside faces; those in terminal patches too.
fn samples_agree(folder: &Folder, table: &Value, name: &str, scheme: &str) {
    let Some(samples) = table["samples"].as_array() else {
        return;
    };
    let samples: Vec<Vec<f64>> = samples.iter().map(floats).collect();
    let points = samples.iter().map(|row| format!("{},{},{}", row[0], row[1], row[2]));
    let found = evaluate(folder, &format!("model.obj --surface {scheme}"), "face,u,v", points);
    let bound = 16.0 * EPSILON * largest(table);
    for (own, row) in found.iter().zip(&samples) {
        let error = (DVec3::from_slice(own) - DVec3::from_slice(&row[3..]))
            .abs()
            .max_element();
        assert!(error <= bound, "{name} at {:?}: {error:e} of {bound:e}", &row[..3]);
    }
}

#[test]
fn catmull_clark_limits_are_exported_as_exactly_as_f32_allows() {
    exported_limits("cc", "catmull-clark", &CATMULL_CLARK);
}

#[test]
fn loop_limits_are_exported_as_exactly_as_f32_allows() {
    exported_limits("loop", "loop", &LOOP);
}

#[test]
fn qas_is_evaluated_as_exactly_as_f32_allows() {
    for name in ["cube", "pole8", "saddle_edgeonly", "tetrahedron", "triangle_edgecorner"] {
        let Some(table) = table(&format!("qas/{name}")) else {
            return;
        };
        let folder = Folder::new(&format!("qas-{name}"));
        folder.write("model.obj", obj(&table));
        let rows: Vec<Vec<f64>> = table["rows"].as_array().unwrap().iter().map(floats).collect();
        let points = rows
            .iter()
            .map(|row| format!("{},{},{}", row[0], row[1] / 4.0, row[2] / 4.0));
        let found = evaluate(&folder, "model.obj --surface qas", "face,u,v", points);
        let bound = 16.0 * EPSILON * largest(&table);
        for (own, row) in found.iter().zip(&rows) {
            let error = (DVec3::from_slice(own) - DVec3::from_slice(&row[3..]))
                .abs()
                .max_element();
            assert!(error <= bound, "{name}: {error:e} of {bound:e}");
            let angle = DVec3::from_slice(&own[9..]).distance(DVec3::from_slice(&row[6..]).normalize());
            assert!(angle <= 1e-4, "{name}: {angle} rad");
        }
    }
}

/// A covariance mesh as an OFF with six numbers more a vertex.
fn off(table: &Value) -> String {
    let list = |name: &str| -> Vec<Vec<f64>> { table[name].as_array().unwrap().iter().map(floats).collect() };
    let (vertices, faces) = (list("verts"), list("faces"));
    let words = |numbers: &[f64]| numbers.iter().map(|n| format!(" {n}")).collect::<String>();
    let mut text = format!("OFF\n{} {} 0\n", vertices.len(), faces.len());
    for (vertex, covariance) in vertices.iter().zip(list("cov6_xx_xy_xz_yy_yz_zz")) {
        writeln!(text, "{}{}", words(vertex).trim(), words(&covariance)).unwrap();
    }
    for face in &faces {
        writeln!(text, "{}{}", face.len(), words(face)).unwrap();
    }
    text
}

/// The greatest ratio of eigenvalues of a covariance.
fn condition(table: &Value) -> f64 {
    let of = |c: &[f64]| {
        let [xx, xy, xz, yy, yz, zz] = <[f64; 6]>::try_from(c).unwrap();
        let matrix = glam::DMat3::from_cols_array(&[xx, xy, xz, xy, yy, yz, xz, yz, zz]);
        let norm = |m: glam::DMat3| m.to_cols_array().iter().map(|x| x * x).sum::<f64>().sqrt();
        norm(matrix) * norm(matrix.inverse())
    };
    let all = table["cov6_xx_xy_xz_yy_yz_zz"].as_array().unwrap();
    all.iter().map(|c| of(&floats(c))).fold(1.0, f64::max)
}

#[test]
fn gaussian_products_are_evaluated_as_exactly_as_their_covariances_allow() {
    let names = [
        "cone_concave_warren",
        "cone_cylinder_warren",
        "cone_plateau_loop",
        "cone_plateau_warren",
        "cone_pointy_warren",
        "cube_iso_equal",
        "grid4x4_boundary",
    ];
    for name in names {
        let Some(table) = table(&format!("gps/{name}")) else {
            return;
        };
        let folder = Folder::new(&format!("gps-{name}"));
        folder.write("model.off", off(&table));
        let scheme = match (table["scheme"].as_str(), table["loop_weights"].as_str()) {
            (Some("cc"), _) => "CatmullClark",
            (_, Some("warren")) => "LoopWarren",
            _ => "Loop",
        };
        folder.write(
            "scene.ron",
            format!(
                "Scene(surfaces: [Surface(name: \"gps\", source: Mesh(\"model.off\"), surface: GaussianProduct(scheme: {scheme}, \
                 sharpness: (boundary: Edges)))])"
            ),
        );
        let steps = 2f64.powf(table["limit"]["level"].as_f64().unwrap());
        let rows: Vec<&Vec<Value>> = table["limit"]["rows"]
            .as_array()
            .unwrap()
            .iter()
            .map(|row| row.as_array().unwrap())
            .collect();
        let number = |row: &[Value], k: usize| row[k].as_f64().unwrap_or(f64::NAN);
        let points = rows.iter().map(|row| {
            format!(
                "{},{},{}",
                number(row, 0),
                number(row, 1) / steps,
                number(row, 2) / steps
            )
        });
        let found = evaluate(&folder, "scene.ron", "face,u,v", points);
        let bound = 64.0 * condition(&table) * EPSILON * 2.0 * largest(&table);
        let mut worst: [f64; 2] = [0.0; 2];
        for (own, row) in found.iter().zip(&rows) {
            let vector = |k: usize| DVec3::new(number(row, k), number(row, k + 1), number(row, k + 2));
            worst[0] = worst[0].max(DVec3::from_slice(own).distance(vector(3)));
            let normal = DVec3::from_slice(&own[9..]);
            assert!((normal.length() - 1.0).abs() < 1e-6, "{name}: {normal}");
            if row.len() >= 9 && vector(6).is_finite() {
                worst[1] = worst[1].max(normal.distance(vector(6)));
            }
        }
        println!("{name}: {:.1e} of {bound:.1e}, normals {:.1e} rad", worst[0], worst[1]);
        assert!(worst[0] <= bound, "{name}: {:e} of {bound:e}", worst[0]);
        assert!(worst[1] <= 1e-3, "{name}: normals {:e} rad", worst[1]);
    }
}
