//! `eval` on the GPU against tables of exact numbers, where the folder that holds them is there.

use crate::Folder;
use glam::DVec3;
use serde_json::Value;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// 2^-24.
pub const EPSILON: f64 = 1.0 / 16_777_216.0;

pub fn shared(name: &str) -> Option<PathBuf> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared").join(name);
    if file.exists() {
        return Some(file);
    }
    println!("skipped: there is no {}", file.display());
    None
}

pub fn table(name: &str) -> Option<Value> {
    let text = std::fs::read_to_string(shared(&format!("oracles/{name}.json"))?).unwrap();
    Some(serde_json::from_str(&text).unwrap())
}

pub fn floats(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

fn rows(table: &Value) -> Vec<Vec<f64>> {
    table["rows"].as_array().unwrap().iter().map(floats).collect()
}

/// The twelve numbers that `eval` appends to every row of a table.
pub fn evaluate(folder: &Folder, model: &str, header: &str, points: impl Iterator<Item = String>) -> Vec<Vec<f64>> {
    let mut csv = format!("{header}\n");
    points.for_each(|point| writeln!(csv, "{point}").unwrap());
    folder.write("at.csv", csv);
    let output = folder.run(&format!("eval {model} --at at.csv -o out.csv --quiet"));
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let numbers = |line: &str| line.split(',').skip(3).map(|n| n.parse().unwrap()).collect();
    folder.read("out.csv").lines().skip(1).map(numbers).collect()
}

/// Positions to 16 eps M, normals to 1e-4 rad where the tangents are not parallel, and where they are but have a limit from inside.
/// `row`: P, Du, Dv, N, and 1 where that is a limit.
fn compare(what: &str, found: &[f64], row: &[f64], largest: f64) {
    let [position, du, dv, normal] = [0, 3, 6, 9].map(|k| DVec3::from_slice(&row[k..]));
    let [own_position, own_normal] = [0, 9].map(|k| DVec3::from_slice(&found[k..]));
    let error = (own_position - position).abs().max_element();
    assert!(
        error <= 16.0 * EPSILON * largest,
        "{what}: {own_position} for {position}, {:.1} eps M",
        error / (EPSILON * largest)
    );
    assert!((own_normal.length() - 1.0).abs() < 1e-6, "{what}: {own_normal}");
    let is_limit = row[12] == 1.0;
    if is_limit || du.cross(dv).length() >= 1e-3 * du.length() * dv.length() && du.length() * dv.length() > 0.0 {
        let angle = own_normal.distance(normal.normalize());
        assert!(angle <= 1e-4, "{what}: {own_normal} for {normal}, {angle} rad");
    }
}

#[test]
fn the_tea_set_is_evaluated_on_the_gpu_as_exactly_as_f32_allows() {
    for name in ["teapot", "teacup", "teaspoon"] {
        let (Some(table), Some(model)) = (table(&format!("bezier/{name}")), shared(&format!("data/teaset/{name}")))
        else {
            return;
        };
        let folder = Folder::new(&format!("oracle-{name}"));
        let grid = table["grid"].as_f64().unwrap();
        let vertices = table["verts"].as_array().unwrap();
        let largest = vertices
            .iter()
            .flat_map(floats)
            .fold(0.0f64, |most, x| most.max(x.abs()));
        let rows = rows(&table);
        let points = rows
            .iter()
            .map(|row| format!("{},{},{}", row[0], row[1] / grid, row[2] / grid));
        let found = evaluate(&folder, &model.to_string_lossy(), "face,u,v", points);
        assert_eq!(found.len(), rows.len());
        for (row, found) in rows.iter().zip(&found) {
            compare(&format!("{name} {:?}", &row[..3]), found, &row[3..], largest);
        }
    }
}

#[test]
fn nurbs_are_evaluated_on_the_gpu_by_their_own_parameters() {
    let names = [
        "cone_pole",
        "cylinder_r1_h2",
        "deg11_bilinear",
        "deg33_uniform_unclamped",
        "deg4_mult4_C-1like_C0",
        "sphere",
        "torus_R2_r0.5",
    ];
    for name in names {
        let Some(table) = table(&format!("nurbs/{name}")) else {
            return;
        };
        let folder = Folder::new(&format!("oracle-{name}"));
        let list = |key: &str| floats(&table[key]).iter().map(|x| format!(" {x}")).collect::<String>();
        let [nu, nv] = ["nu", "nv"].map(|key| table[key].as_u64().unwrap() as usize);
        let (mut model, mut indices, mut largest) = (String::new(), String::new(), 0.0f64);
        for (k, (i, j)) in (1..).zip((0..nv).flat_map(|j| (0..nu).map(move |i| (i, j)))) {
            let c = floats(&table["ctrl"][i][j]);
            largest = c[..3].iter().fold(largest, |most, x| most.max(x.abs()));
            writeln!(model, "v {} {} {} {}", c[0], c[1], c[2], c[3]).unwrap();
            write!(indices, " {k}").unwrap();
        }
        let [p, q] = [0, 1].map(|k| floats(&table["degree"])[k] as usize);
        let domain = |knots: &str, degree: usize| {
            let knots = floats(&table[knots]);
            format!("{} {}", knots[degree], knots[knots.len() - 1 - degree])
        };
        let (u, v) = (domain("knots_u", p), domain("knots_v", q));
        writeln!(model, "cstype rat bspline\ndeg {p} {q}\nsurf {u} {v}{indices}").unwrap();
        writeln!(model, "parm u{}\nparm v{}\nend", list("knots_u"), list("knots_v")).unwrap();
        folder.write("surface.obj", model);
        let rows = rows(&table);
        let points = rows.iter().map(|row| format!("0,{},{}", row[0], row[1]));
        let found = evaluate(&folder, "surface.obj", "surface,s,t", points);
        assert_eq!(found.len(), rows.len());
        for (row, found) in rows.iter().zip(&found) {
            compare(&format!("{name} {:?}", &row[..2]), found, &row[2..], largest);
        }
    }
}

#[test]
fn real_models_of_patches_are_checked_and_their_closed_parts_are_watertight() {
    let folder = Folder::new("patch-models");
    for name in [
        "teaset/teapot",
        "teaset/teaspoon",
        "nurbs/v2_Speeder.obj",
        "nurbs/v5_teapot.obj",
    ] {
        let Some(model) = shared(&format!("data/{name}")) else {
            return;
        };
        let model = model.to_string_lossy();
        let output = folder.run(&format!("check {model} --step 2 --pixels 24 --size 320x200 --quiet"));
        let text = String::from_utf8_lossy(&output.stdout);
        assert!(
            output.status.success() && text.contains(" 0 findings"),
            "{name}: {text}"
        );
    }
}
