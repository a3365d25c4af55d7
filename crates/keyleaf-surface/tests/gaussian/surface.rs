//! Gaussian-product surfaces: against tables made by independent code, plain subdivision, and themselves.

use crate::models::Random;
use crate::oracle_tables::{oracle, rows};
use crate::oracles::{NAMES, read};
use crate::products::{any_point, meshes, plain, product, scheme_of, settings, shipped};
use glam::DVec3;
use keyleaf_key::{ONE, RootPoint};
use keyleaf_surface::gaussian::{Conditioning, CovarianceMesh, GaussianProduct, Symmetric3};
use keyleaf_surface::{BoundaryRule, SubdivisionError, SubdivisionScheme, Surface};

fn size(surface: &dyn Surface) -> f64 {
    let (low, high) = surface.bounding_box();
    low.distance(high)
}

#[test]
fn limits_and_their_normals_are_those_of_the_tables() {
    for name in NAMES {
        let Some(table) = oracle(&format!("gps/{name}.json")) else {
            return;
        };
        let (scheme, mesh) = read(&table);
        let surface = product(&mesh, scheme_of(scheme), 12);
        let size = size(&surface);
        let (mut worst, mut drawn_worst, mut angle) = (0.0f64, 0.0f64, 0.0f64);
        for row in rows(&table["limit"]["rows"]) {
            let at = surface
                .face_coord(row[0] as u32, row[1] / 4.0, row[2] / 4.0)
                .expect("in the face");
            let (frame, drawn) = (surface.frame(at), surface.drawn(at));
            worst = worst.max(frame.position.distance(DVec3::from_slice(&row[3..6])) / size);
            drawn_worst = drawn_worst.max(drawn.position.distance(frame.position) / size);
            let normal = DVec3::from_slice(&row[6..]);
            if normal.is_finite() {
                for own in [frame.normal, drawn.normal] {
                    assert!((own.length() - 1.0).abs() < 1e-12);
                    angle = angle.max(own.distance(normal));
                }
            }
        }
        println!("{name}: {worst:.1e} of the extent, drawn {drawn_worst:.1e}, normals {angle:.1e}");
        assert!(worst < 1e-10 && drawn_worst < 1e-10 && angle < 1e-4, "{name}");
    }
}

#[test]
fn equal_round_covariances_are_plain_subdivision() {
    for (name, scheme, mesh) in meshes() {
        let round = CovarianceMesh::isotropic(mesh.control().clone(), 0.2).expect("a mesh");
        let (surface, plain) = (product(&round, scheme, 5), plain(&round, scheme, 5));
        assert!((surface.terminal_error() - plain.terminal_error()).abs() < 0.5 * plain.terminal_error() + 1e-12);
        let mut random = Random(5);
        for _ in 0..100 {
            let at = any_point(&surface, &mut random);
            for (own, plain) in [
                (surface.frame(at), plain.frame(at)),
                (surface.drawn(at), plain.drawn(at)),
            ] {
                assert!(own.position.distance(plain.position) < 1e-13, "{name}: {at:?}");
                assert!(
                    own.normal.distance(plain.normal) < 1e-6,
                    "{name}: {at:?} {own:?} {plain:?}"
                );
                let scale = 1.0 + plain.du.length() + plain.dv.length();
                assert!(
                    (own.du - plain.du).length() + (own.dv - plain.dv).length() < 1e-9 * scale,
                    "{name}: {at:?}"
                );
            }
        }
    }
}

#[test]
fn a_common_factor_of_all_covariances_changes_nothing() {
    for (name, scheme, mesh) in meshes() {
        let own = product(&mesh, scheme, 4);
        for factor in [1e-60, 1e-12, 1e60] {
            let scaled = product(&mesh.scaled(factor).expect("in range"), scheme, 4);
            let mut random = Random(6);
            for _ in 0..40 {
                let at = any_point(&own, &mut random);
                for (a, b) in [(own.frame(at), scaled.frame(at)), (own.drawn(at), scaled.drawn(at))] {
                    let off = a.position.distance(b.position);
                    assert!(off < 1e-10, "{name} times {factor:e}: {off:e}");
                }
            }
            let origin = DVec3::ZERO;
            assert!(
                scaled.tables(origin).a.iter().all(|x| x.is_finite()),
                "{name} times {factor:e}"
            );
        }
    }
}

#[test]
fn what_is_drawn_is_the_limit_surface_within_the_estimated_error() {
    for (name, scheme, mesh) in meshes() {
        for isolation in [3, 8] {
            let surface = product(&mesh, scheme, isolation);
            let room = surface.terminal_error() + 1e-10;
            let (mut random, mut worst) = (Random(7), 0.0f64);
            for _ in 0..150 {
                let at = any_point(&surface, &mut random);
                worst = worst.max(surface.drawn(at).position.distance(surface.point(at)) / room);
            }
            println!("{name} at {isolation}: {worst:.2} of {room:.1e}");
            assert!(worst <= 1.0, "{name} at {isolation}");
        }
    }
}

#[test]
fn both_sides_of_an_edge_give_the_same_bits() {
    for (name, scheme, mesh) in meshes() {
        let surface = product(&mesh, scheme, 4);
        let topology = surface.topology();
        let mut random = Random(8);
        for root in topology.roots() {
            let Some(twin) = topology.twin(root.face, root.root) else {
                continue;
            };
            for x in [0, ONE / 2, ONE, (random.unit() * f64::from(ONE)) as u32] {
                let at = |face, root, x| RootPoint {
                    face,
                    root,
                    x,
                    y: ONE - x,
                };
                let (own, other) = (at(root.face, root.root, x), at(twin.face, twin.root, ONE - x));
                assert_eq!(surface.point(own), surface.point(other), "{name}");
                assert_eq!(surface.drawn(own).position, surface.drawn(other).position, "{name}");
                // Patches of both sides meet but for what their terminal patches are off.
                let gap = surface
                    .approximate(own)
                    .position
                    .distance(surface.approximate(other).position);
                assert!(gap <= 2.0 * surface.terminal_error() + 1e-11, "{name}: {gap:e}");
            }
        }
    }
}

#[test]
fn derivatives_are_those_of_the_positions() {
    for (name, scheme, mesh) in meshes() {
        let surface = product(&mesh, scheme, 6);
        let step = 1.0 / f64::from(1 << 16);
        for face in 0..surface.topology().face_count().min(6) {
            if scheme == SubdivisionScheme::CatmullClark && surface.topology().corner_count(face) != 4 {
                continue;
            }
            let at = |u: f64, v: f64| surface.face_coord(face, u, v).expect("in the face");
            for (u, v) in [(0.3, 0.4), (0.2, 0.61), (0.55, 0.15)] {
                let frame = surface.frame(at(u, v));
                let difference = |a: RootPoint, b: RootPoint| (surface.point(b) - surface.point(a)) / (2.0 * step);
                let du = difference(at(u - step, v), at(u + step, v));
                let dv = difference(at(u, v - step), at(u, v + step));
                let scale = 1.0 + du.length() + dv.length();
                assert!(
                    frame.du.distance(du) + frame.dv.distance(dv) < 2e-3 * scale,
                    "{name}: {frame:?} {du} {dv}"
                );
                let drawn = surface.drawn(at(u, v));
                assert!(
                    frame.du.distance(drawn.du) + frame.dv.distance(drawn.dv) < 1e-6 * scale,
                    "{name}"
                );
            }
        }
    }
}

#[test]
fn covariances_that_are_none_are_regularised_and_make_a_surface() {
    let Some((_, scheme, mesh)) = meshes().into_iter().next() else {
        return;
    };
    let mut matrices: Vec<Symmetric3> = mesh.covariances().iter().map(|c| c.matrix()).collect();
    matrices[0] = Symmetric3::diagonal([1.0, 1.0, 0.0]);
    matrices[1] = Symmetric3::diagonal([1.0, -1e-3, 1e-12]);
    let (mesh, changed) = CovarianceMesh::new(mesh.control().clone(), &matrices, Conditioning::Floor).expect("a mesh");
    assert_eq!(changed, [0, 1]);
    let surface = product(&mesh, scheme, 8);
    let mut random = Random(9);
    for _ in 0..200 {
        let at = any_point(&surface, &mut random);
        let (frame, drawn) = (surface.frame(at), surface.drawn(at));
        for f in [frame, drawn] {
            assert!(f.position.is_finite() && f.du.is_finite() && f.dv.is_finite());
            assert!((f.normal.length() - 1.0).abs() < 1e-12);
        }
        assert!(frame.position.distance(drawn.position) < 1e-6 + surface.terminal_error());
    }
}

#[test]
fn faces_that_are_not_drawn_are_named_and_bad_settings_refused() {
    let Some(table) = oracle("gps/grid4x4_boundary.json") else {
        return;
    };
    let (scheme, mesh) = read(&table);
    let mut control = mesh.control().clone();
    control.boundary = BoundaryRule::None;
    let matrices: Vec<Symmetric3> = mesh.covariances().iter().map(|c| c.matrix()).collect();
    let (inner, _) = CovarianceMesh::new(control, &matrices, Conditioning::Floor).expect("a mesh");
    let surface = product(&inner, scheme_of(scheme), 3);
    assert_eq!(surface.drawn_faces(), [4]);
    assert!(surface.face_coord(0, 0.5, 0.5).is_err() && surface.face_coord(4, 0.5, 0.5).is_ok());
    let error = |settings| GaussianProduct::new(&mesh, settings).expect_err("no surface");
    assert!(matches!(
        error(settings(SubdivisionScheme::CatmullClark, 17)),
        SubdivisionError::Setting(_)
    ));
    let triangles = SubdivisionScheme::Loop(keyleaf_surface::LoopWeights::Loop);
    assert!(matches!(
        error(settings(triangles, 3)),
        SubdivisionError::NoTriangle { .. }
    ));
}

#[test]
fn shipped_models_have_normals_that_point_outwards() {
    let Some(cube) = shipped("gauss_cube") else { return };
    let surface = product(&cube, SubdivisionScheme::CatmullClark, 8);
    let mut random = Random(10);
    for _ in 0..300 {
        let at = any_point(&surface, &mut random);
        for frame in [surface.frame(at), surface.drawn(at)] {
            assert!(frame.normal.dot(frame.position) > 0.0, "{frame:?}");
        }
    }
}

#[test]
#[ignore = "prints times; run alone, in release"]
fn time_of_making() {
    for name in ["gauss_cube", "gauss_wirecube", "gauss_cylinder", "gauss_anvil"] {
        let Some(mesh) = shipped(name) else { continue };
        let start = std::time::Instant::now();
        let runs = 20;
        for _ in 0..runs {
            std::hint::black_box(product(&mesh, SubdivisionScheme::CatmullClark, 8));
        }
        let surface = product(&mesh, SubdivisionScheme::CatmullClark, 8);
        let each = start.elapsed() / runs;
        let faces = surface.topology().face_count();
        let floats = surface.tables(DVec3::ZERO).a.len();
        println!("{name}: {faces} faces, {} patches, {each:.2?}", floats / (39 * 4));
    }
}
