//! Gaussian-product subdivision of whole meshes against tables made by independent code, where the folder that holds them is there.

use crate::models::{Random, cube, mesh};
use crate::oracle_tables::{oracle, rows};
use crate::refine::{Limit, Refined, Scheme};
use glam::{DMat3, DVec3};
use keyleaf_surface::ControlMesh;
use keyleaf_surface::gaussian::{Conditioning, CovarianceMesh, Dual, DualFrame, DualJet, MeanJet, Symmetric3};
use serde_json::Value;

pub const NAMES: [&str; 7] = [
    "cone_concave_warren",
    "cone_cylinder_warren",
    "cone_plateau_loop",
    "cone_plateau_warren",
    "cone_pointy_warren",
    "cube_iso_equal",
    "grid4x4_boundary",
];

pub fn read(table: &Value) -> (Scheme, CovarianceMesh) {
    let scheme = match (table["scheme"].as_str(), table["loop_weights"].as_str()) {
        (Some("cc"), _) => Scheme::CatmullClark,
        (_, Some("warren")) => Scheme::Warren,
        _ => Scheme::Loop,
    };
    let positions = rows(&table["verts"]).iter().map(|v| DVec3::from_slice(v)).collect();
    let faces: Vec<Vec<u32>> = rows(&table["faces"])
        .iter()
        .map(|f| f.iter().map(|&v| v as u32).collect())
        .collect();
    let six = |c: &Vec<f64>| Symmetric3::from_array([c[0], c[1], c[2], c[3], c[4], c[5]]);
    let covariances: Vec<Symmetric3> = rows(&table["cov6_xx_xy_xz_yy_yz_zz"]).iter().map(six).collect();
    let control = ControlMesh::from(mesh(positions, &faces));
    let (mesh, changed) = CovarianceMesh::new(control, &covariances, Conditioning::Floor).expect("a mesh");
    assert!(changed.is_empty());
    (scheme, mesh)
}

fn gaussians(mesh: &CovarianceMesh) -> Vec<(DVec3, keyleaf_surface::gaussian::Covariance)> {
    let count = mesh.covariances().len() as u32;
    (0..count).filter_map(|vertex| mesh.gaussian(vertex)).collect()
}

/// The mesh in dual space.
fn dual_mesh(scheme: Scheme, mesh: &CovarianceMesh, frame: &DualFrame) -> Refined<9> {
    let points = gaussians(mesh)
        .iter()
        .map(|(mean, covariance)| Dual::of(*mean, covariance, frame).to_array())
        .collect();
    let faces: Vec<Vec<u32>> = mesh.control().mesh.faces.iter().map(<[u32]>::to_vec).collect();
    Refined::new(scheme, false, points, &faces)
}

fn mean(point: [f64; 9], frame: &DualFrame) -> DVec3 {
    frame.point(Dual::from_array(point).mean().expect("definite"))
}

fn jet(limit: &Limit<9>, frame: &DualFrame) -> MeanJet {
    let [u, v] = limit.tangents.map(Dual::from_array);
    let zero = Dual::default();
    let jet = DualJet {
        terms: [Dual::from_array(limit.value), u, v, zero, zero, zero],
    };
    jet.mean().expect("definite").in_object_space(frame)
}

#[test]
fn levels_and_limits_agree_with_the_tables() {
    let mut worst = [0.0f64; 2];
    let (mut points, mut normals) = (0, 0);
    for name in NAMES {
        let Some(table) = oracle(&format!("gps/{name}.json")) else {
            return;
        };
        let (scheme, mesh) = read(&table);
        for frame in [
            DualFrame::scaled(&gaussians(&mesh)),
            DualFrame::whitened(&gaussians(&mesh)),
        ] {
            let mut refined = dual_mesh(scheme, &mesh, &frame);
            for (level, own) in table["levels"].as_array().expect("levels").iter().enumerate() {
                if level > 0 {
                    refined = refined.refine();
                }
                let at = refined.by_parameter();
                for row in rows(&own["pts"]) {
                    let vertex = at[&(row[0] as usize, row[1] as u32, row[2] as u32)];
                    let error = mean(refined.points[vertex], &frame).distance(DVec3::from_slice(&row[3..]));
                    worst[0] = worst[0].max(error);
                    assert!(error < 2e-12, "{name}, level {level}: {row:?} {error:e}");
                    points += 1;
                }
            }
            let refined = dual_mesh(scheme, &mesh, &frame).refine().refine();
            let (at, limits) = (refined.by_parameter(), refined.limits());
            for row in rows(&table["limit"]["rows"]) {
                let jet = jet(&limits[at[&(row[0] as usize, row[1] as u32, row[2] as u32)]], &frame);
                let error = jet.mean.distance(DVec3::from_slice(&row[3..6]));
                worst[0] = worst[0].max(error);
                assert!(error < 2e-12, "{name}: {row:?} {error:e}");
                let normal = DVec3::from_slice(&row[6..]);
                if normal.is_finite() {
                    let error = jet.frame(DVec3::Z).normal.distance(normal);
                    worst[1] = worst[1].max(error);
                    assert!(error < 1e-9, "{name}: {row:?} {error:e} {jet:?}");
                    normals += 1;
                }
            }
        }
    }
    println!(
        "{points} points of levels, {normals} normals; largest error {:.1e}, of normals {:.1e}",
        worst[0], worst[1]
    );
}

#[test]
fn equal_round_covariances_are_plain_subdivision() {
    let Some(grid) = oracle("gps/grid4x4_boundary.json") else {
        return;
    };
    let Some(cone) = oracle("gps/cone_plateau_loop.json") else {
        return;
    };
    let [(_, grid), (_, cone)] = [read(&grid), read(&cone)];
    let cube = ControlMesh::from(cube());
    for (scheme, control) in [
        (Scheme::CatmullClark, grid.control()),
        (Scheme::CatmullClark, &cube),
        (Scheme::Loop, cone.control()),
        (Scheme::Warren, cone.control()),
    ] {
        let mesh = CovarianceMesh::isotropic(control.clone(), 0.3).expect("a mesh");
        let frame = DualFrame::scaled(&gaussians(&mesh));
        let points = control.mesh.positions.iter().map(|p| p.to_array()).collect();
        let faces: Vec<Vec<u32>> = control.mesh.faces.iter().map(<[u32]>::to_vec).collect();
        let plain = Refined::<3>::new(scheme, false, points, &faces).refine().refine();
        let product = dual_mesh(scheme, &mesh, &frame).refine().refine();
        let (limits, other) = (product.limits(), product.by_parameter());
        let plain_limits = plain.limits();
        for (parameter, vertex) in plain.by_parameter() {
            let (limit, jet) = (plain_limits[vertex], jet(&limits[other[&parameter]], &frame));
            assert!(jet.mean.distance(DVec3::from_array(limit.value)) < 5e-15);
            // A smooth corner with one quad has no mask for its tangents.
            if !limit.tangents[1][0].is_finite() {
                continue;
            }
            for (own, plain) in jet.first.into_iter().zip(limit.tangents) {
                assert!(
                    own.distance(DVec3::from_array(plain)) < 1e-13,
                    "{own} {plain:?} {scheme:?}"
                );
            }
        }
    }
}

#[test]
fn scale_translation_and_rotation_commute_with_products() {
    let Some(table) = oracle("gps/grid4x4_boundary.json") else {
        return;
    };
    let (scheme, mesh) = read(&table);
    let points = |mesh: &CovarianceMesh| -> Vec<DVec3> {
        let frame = DualFrame::scaled(&gaussians(mesh));
        let refined = dual_mesh(scheme, mesh, &frame).refine().refine();
        let mut at: Vec<_> = refined.by_parameter().into_iter().collect();
        at.sort();
        at.into_iter()
            .map(|(_, vertex)| mean(refined.points[vertex], &frame))
            .collect()
    };
    let own = points(&mesh);
    for factor in [1e-12, 1e12, 1e-60, 1e60] {
        let scaled = points(&mesh.scaled(factor).expect("in range"));
        let largest = own.iter().zip(scaled).map(|(a, b)| a.distance(b)).fold(0.0, f64::max);
        assert!(largest < 1e-13, "{factor}: {largest}");
    }
    let turn: DMat3 = Random(3).rotation(2.0);
    let shift = DVec3::new(1e6, -3e5, 7.0);
    let mut control = mesh.control().clone();
    control.mesh.positions.iter_mut().for_each(|p| *p = turn * *p + shift);
    let turned: Vec<Symmetric3> = mesh
        .covariances()
        .iter()
        .map(|c| c.matrix().congruent(turn.transpose()))
        .collect();
    let (moved, _) = CovarianceMesh::new(control, &turned, Conditioning::Strict).expect("a mesh");
    for (a, b) in own.iter().zip(points(&moved)) {
        // Half a unit of 1e6 in f64.
        assert!((turn * *a + shift).distance(b) < 1e-9, "{a} {b}");
    }
}
