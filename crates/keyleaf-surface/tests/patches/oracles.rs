//! Positions, derivatives and normals against tables of exact numbers, where the folder that holds them is there.

use crate::models::{bezier_model, model};
use crate::oracle_tables::{floats, oracle, rows};
use glam::DVec3;
use keyleaf_surface::{NurbsSurface, Patches, Surface, SurfaceFrame};
use serde_json::Value;

/// The patches of a tea set: `c[i][j]` with j in u.
pub fn tea_set(table: &Value) -> Vec<NurbsSurface> {
    let verts: Vec<DVec3> = table["verts"]
        .as_array()
        .expect("verts")
        .iter()
        .map(|v| DVec3::from_slice(&floats(v)))
        .collect();
    let patches = table["patches0"].as_array().expect("patches");
    patches
        .iter()
        .map(|patch| {
            let points = floats(patch).iter().map(|&index| verts[index as usize]).collect();
            NurbsSurface::bezier([3, 3], points, vec![1.0; 16]).expect("a patch")
        })
        .collect()
}

/// A NURBS surface of a table: `ctrl[u][v]`.
pub fn nurbs(table: &Value) -> NurbsSurface {
    let degree = floats(&table["degree"]);
    let [nu, nv] = ["nu", "nv"].map(|name| table[name].as_u64().expect("a count") as usize);
    let controls = (0..nv).flat_map(|j| (0..nu).map(move |i| (i, j)));
    let controls: Vec<Vec<f64>> = controls.map(|(i, j)| floats(&table["ctrl"][i][j])).collect();
    NurbsSurface::new(
        [degree[0] as u32, degree[1] as u32],
        [floats(&table["knots_u"]), floats(&table["knots_v"])],
        controls.iter().map(|c| DVec3::from_slice(c)).collect(),
        controls.iter().map(|c| c[3]).collect(),
    )
    .expect("a surface")
}

/// Compares a frame with P, Du, Dv, N and whether Du × Dv vanishes.
fn compare(what: &str, frame: &SurfaceFrame, row: &[f64], largest: f64) {
    let [position, du, dv, normal] = [0, 3, 6, 9].map(|k| DVec3::from_slice(&row[k..]));
    assert!(
        frame.position.distance(position) <= 1e-12 * largest,
        "{what}: {frame:?} {row:?}"
    );
    for (own, exact) in [(frame.du, du), (frame.dv, dv)] {
        assert!(
            own.distance(exact) <= 1e-11 * (largest + exact.length()),
            "{what}: {own} {exact}"
        );
    }
    let angle = frame.normal.cross(normal.normalize()).length();
    assert!(
        angle <= 1e-6 && frame.normal.dot(normal) > 0.0,
        "{what}: {} {normal}",
        frame.normal
    );
}

fn largest(surface: &NurbsSurface) -> f64 {
    surface
        .points()
        .iter()
        .map(|p| p.abs().max_element())
        .fold(0.0, f64::max)
}

/// The frame at own parameters through faces and roots, turned back into the surface's own terms.
fn frame_of_model(model: &Patches, surface: u32, s: f64, t: f64) -> SurfaceFrame {
    let own = model.own_coord(surface, s, t).expect("in the domain");
    let frame = model.frame(own.at);
    let [du, dv] = if own.transposed {
        [frame.dv, frame.du]
    } else {
        [frame.du, frame.dv]
    };
    SurfaceFrame {
        position: frame.position,
        du: du * own.rates[0],
        dv: dv * own.rates[1],
        normal: if own.transposed { -frame.normal } else { frame.normal },
    }
}

#[test]
fn the_tea_set_agrees_with_exact_rationals() {
    let mut compared = 0;
    for name in ["teapot", "teacup", "teaspoon"] {
        let Some(table) = oracle(&format!("bezier/{name}.json")) else {
            return;
        };
        let surfaces = tea_set(&table);
        let grid = table["grid"].as_f64().expect("a grid");
        let model = bezier_model(surfaces.clone());
        for row in rows(&table["rows"]) {
            let (patch, u, v) = (row[0] as usize, row[1] / grid, row[2] / grid);
            let what = format!("{name}, patch {patch} at ({u}, {v})");
            let frame = surfaces[patch].frame(u, v).expect("in the square");
            compare(&what, &frame, &row[3..], largest(&surfaces[patch]));
            // Thirds are no multiples of 2⁻³¹.
            if grid == 4.0 {
                let frame = frame_of_model(&model, patch as u32, u, v);
                compare(&what, &frame, &row[3..], largest(&surfaces[patch]));
            }
            compared += 1;
        }
    }
    assert_eq!(compared, 800 + 650 + 256);
}

#[test]
fn nurbs_agree_with_forty_digits() {
    let names = [
        "cone_pole",
        "cylinder_r1_h2",
        "deg11_bilinear",
        "deg33_uniform_unclamped",
        "deg4_mult4_C-1like_C0",
        "sphere",
        "torus_R2_r0.5",
    ];
    let mut compared = 0;
    for name in names {
        let Some(table) = oracle(&format!("nurbs/{name}.json")) else {
            return;
        };
        let surface = nurbs(&table);
        let model = model(vec![surface.clone()]);
        for row in rows(&table["rows"]) {
            let what = format!("{name} at ({}, {})", row[0], row[1]);
            let frame = surface.frame(row[0], row[1]).expect("in the domain");
            compare(&what, &frame, &row[2..], largest(&surface));
            let own = model.own_coord(0, row[0], row[1]).expect("in the domain");
            let local = model.frame(own.at);
            // A parameter is rounded to 2⁻³¹ of its span.
            let room = 1e-9 * (largest(&surface) + local.du.length() + local.dv.length());
            let frame = frame_of_model(&model, 0, row[0], row[1]);
            assert!(
                frame.position.distance(DVec3::from_slice(&row[2..])) < room,
                "{what}: {frame:?}"
            );
            compared += 1;
        }
    }
    assert_eq!(compared, 85 + 85 + 81 + 81 + 117 + 153 + 81);
}

#[test]
fn a_planar_patch_whose_control_quads_face_away_faces_the_eye() {
    let Some(table) = oracle("nurbs/sqc_counterexample.json") else {
        return;
    };
    let mut points = Vec::new();
    for j in 0..4 {
        for i in 0..4 {
            let xy = floats(&table["ctrl_xy"][j][i]);
            points.push(DVec3::new(xy[0], xy[1], 0.0));
        }
    }
    let patch = NurbsSurface::bezier([3, 3], points, vec![1.0; 16]).expect("a patch");
    let at = floats(&table["uv"]);
    let frame = patch.frame(at[0], at[1]).expect("in the square");
    let exact = table["nz"].as_f64().expect("a number");
    assert!(
        (frame.du.cross(frame.dv).z - exact).abs() < 1e-9 && frame.normal.z == 1.0,
        "{frame:?}"
    );
}
