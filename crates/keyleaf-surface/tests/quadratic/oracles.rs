//! QAS against tables made in f64 by independent code, where the folder that holds them is there.

use crate::emulation::Emulation;
use crate::oracle_tables::{oracle, rows};
use crate::refine::{Refined, Scheme};
use glam::DVec3;
use keyleaf_surface::{
    BoundaryRule, ControlMesh, CornerAttributes, LimitSamples, LoopWeights, PolygonMesh, Surface, TrianglePatches,
};
use serde_json::Value;

const NAMES: [&str; 5] = ["cube", "pole8", "saddle_edgeonly", "tetrahedron", "triangle_edgecorner"];

fn control_mesh(table: &Value) -> ControlMesh {
    let faces = rows(&table["faces"]);
    let triangles = faces
        .iter()
        .map(|face| face.iter().map(|&v| v as u32).collect::<Vec<_>>());
    let mesh = PolygonMesh {
        positions: rows(&table["verts"]).iter().map(|v| DVec3::from_slice(v)).collect(),
        faces: triangles.collect(),
        corners: CornerAttributes::default(),
    };
    let boundary = match table["boundary"].as_str() {
        Some("edge_and_corner") => BoundaryRule::EdgesAndCorners,
        _ => BoundaryRule::Edges,
    };
    ControlMesh {
        boundary,
        ..ControlMesh::from(mesh)
    }
}

fn refined(control: &ControlMesh) -> Refined<3> {
    let points = control.mesh.positions.iter().map(|p| p.to_array()).collect();
    let faces: Vec<Vec<u32>> = control.mesh.faces.iter().map(<[u32]>::to_vec).collect();
    Refined::new(
        Scheme::Loop,
        control.boundary == BoundaryRule::EdgesAndCorners,
        points,
        &faces,
    )
}

#[test]
fn qas_agrees_with_the_tables_in_f64_and_in_f32() {
    let (mut compared, mut worst) = (0, 0.0f64);
    for name in NAMES {
        let Some(table) = oracle(&format!("qas/{name}.json")) else {
            return;
        };
        let surface = TrianglePatches::of_loop(&control_mesh(&table), LoopWeights::Loop).expect("a surface");
        let emulation = Emulation::new(&surface, DVec3::ZERO);
        let largest = surface
            .bounding_box()
            .0
            .abs()
            .max(surface.bounding_box().1.abs())
            .max_element();
        for row in rows(&table["rows"]) {
            let at = surface
                .face_coord(row[0] as u32, row[1] / 4.0, row[2] / 4.0)
                .expect("in the triangle");
            let [position, normal] = [3, 6].map(|k| DVec3::from_slice(&row[k..]));
            let frame = surface.frame(at);
            assert!(frame.position.distance(position) <= 1e-12, "{name} {row:?}: {frame:?}");
            assert!(frame.normal.distance(normal) <= 1e-12, "{name} {row:?}: {frame:?}");
            let error = emulation.point(at).distance(frame.position) / largest * 2f64.powi(24);
            assert!(error <= 16.0, "{name}: {error}");
            worst = worst.max(error);
            compared += 1;
        }
    }
    println!("largest error in f32: {worst:.2} * 2^-24 * M");
    assert_eq!(compared, 360 + 360 + 60 + 60 + 735);
}

/// At the vertices and the edge middles the surface is Loop's: positions and normals of a brute-force refinement.
#[test]
fn samples_are_limits_of_the_refined_mesh_for_both_weights() {
    for name in NAMES {
        let Some(table) = oracle(&format!("qas/{name}.json")) else {
            return;
        };
        let control = control_mesh(&table);
        for (weights, scheme) in [(LoopWeights::Loop, Scheme::Loop), (LoopWeights::Warren, Scheme::Warren)] {
            let samples = LimitSamples::of_loop(&control, weights).expect("samples");
            let fine = Refined {
                scheme,
                ..refined(&control)
            }
            .refine();
            let (limits, at) = (fine.limits(), fine.by_parameter());
            for face in 0..control.mesh.faces.len() {
                for (k, (i, j)) in [(0, 0), (2, 0), (0, 2)].into_iter().enumerate() {
                    let sample = samples.corners[3 * face + k];
                    assert!(
                        sample
                            .position
                            .distance(DVec3::from_array(limits[at[&(face, i, j)]].value))
                            < 1e-14
                    );
                }
                for (k, (i, j)) in [(1, 0), (1, 1), (0, 1)].into_iter().enumerate() {
                    let (sample, limit) = (samples.edges[3 * face + k], limits[at[&(face, i, j)]]);
                    let [along, across] = limit.tangents.map(DVec3::from_array);
                    assert!(sample.position.distance(DVec3::from_array(limit.value)) < 1e-14);
                    assert!(
                        sample.normal.distance(along.cross(across).normalize()) < 1e-13,
                        "{name} {sample:?}"
                    );
                }
            }
        }
    }
}

/// The distance to the limit surface at equal parameters, as the tables state it.
#[test]
fn the_distance_to_the_limit_is_that_of_the_tables() {
    for name in NAMES {
        let Some(table) = oracle(&format!("qas/{name}.json")) else {
            return;
        };
        let control = control_mesh(&table);
        let surface = TrianglePatches::of_loop(&control, LoopWeights::Loop).expect("a surface");
        let positions = || control.mesh.positions.iter().copied();
        let diagonal = positions()
            .fold(DVec3::NEG_INFINITY, DVec3::max)
            .distance(positions().fold(DVec3::INFINITY, DVec3::min));
        // At the vertices of the second step.
        let fine = refined(&control).refine().refine();
        let (limits, n) = (fine.limits(), 4.0);
        let (mut squares, mut largest, mut count) = (0.0f64, 0.0f64, 0.0);
        for ((face, i, j), vertex) in fine.by_parameter() {
            let at = surface
                .face_coord(face as u32, f64::from(i) / n, f64::from(j) / n)
                .expect("in the triangle");
            let distance = surface.point(at).distance(DVec3::from_array(limits[vertex].value)) / diagonal;
            squares += distance * distance;
            largest = largest.max(distance);
            count += 1.0;
        }
        let rms = (squares / count).sqrt();
        let [rms_of_table, max_of_table] =
            ["rms", "max"].map(|k| table[format!("{k}_to_limit_over_bbdiag")].as_f64().expect("a number"));
        assert!((rms / rms_of_table - 1.0).abs() < 1e-9, "{name}: {rms} {rms_of_table}");
        assert!(
            (largest / max_of_table - 1.0).abs() < 1e-9,
            "{name}: {largest} {max_of_table}"
        );
    }
}
