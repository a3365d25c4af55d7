//! Gaussian products whose control mesh and covariances move: what the GPU finds of a pose, against the surface made of it in f64.

use crate::meshes;
use crate::posing::{double_cone, errors, moving};
use crate::random::Random;
use crate::snapshot::findings;
use crate::watertight::{check, draw};
use crate::world::{World, random_view, settings};
use glam::DVec3;
use keyleaf::surface::gaussian::{Conditioning, CovarianceMesh, GaussianProduct, GaussianSettings, Symmetric3};
use keyleaf::surface::{ControlMesh, LoopWeights, PolygonMesh, SubdivisionScheme, Surface};
use keyleaf::{Metric, modules};
use std::sync::Arc;

/// Covariances whose axes lie anyhow, with standard deviations between 1 and the root of a condition.
fn covariances(count: usize, condition: f64, random: &mut Random) -> Vec<[f64; 6]> {
    let covariance = |_| {
        let towards = random.point((DVec3::NEG_ONE, DVec3::ONE)).normalize();
        let other = random.point((DVec3::NEG_ONE, DVec3::ONE)).normalize();
        let side = towards.cross(other).normalize();
        let axes = [towards, side, towards.cross(side)];
        let variances = [1.0, condition.powf(random.unit()), condition];
        let matrix = axes
            .iter()
            .zip(variances)
            .fold(Symmetric3::default(), |sum, (&axis, variance)| {
                sum + Symmetric3::outer(axis) * variance
            });
        (matrix * (1.0 / condition)).to_array()
    };
    (0..count).map(covariance).collect()
}

fn covariance_mesh(mesh: PolygonMesh, covariances: &[[f64; 6]]) -> CovarianceMesh {
    let matrices: Vec<Symmetric3> = covariances.iter().map(|&c| Symmetric3::from_array(c)).collect();
    let made = CovarianceMesh::new(ControlMesh::from(mesh), &matrices, Conditioning::Floor);
    made.expect("a covariance mesh").0
}

#[test]
fn posed_gaussian_products_are_drawn_as_they_are_in_f64() {
    let mut random = Random(11);
    let quads = SubdivisionScheme::CatmullClark;
    let triangles = SubdivisionScheme::Loop(LoopWeights::Loop);
    for (name, mesh, scheme) in [
        ("house", meshes::house(), quads),
        ("open mesh", meshes::open(), quads),
        ("torus", meshes::torus(7, 5), quads),
        ("tetrahedron", meshes::tetrahedron(), triangles),
        ("double cone", double_cone(11), triangles),
    ] {
        for condition in [1.0, 1e2, 1e4, 1e6] {
            let count = mesh.positions.len();
            let shape = GaussianSettings {
                scheme,
                isolation: 6,
                ..GaussianSettings::default()
            };
            let at_rest = covariance_mesh(mesh.clone(), &covariances(count, condition, &mut random));
            let mut surface = GaussianProduct::new(&at_rest, shape).expect("a surface");
            let far = random.point((DVec3::splat(-4.0), DVec3::splat(4.0)));
            let moved = |&p: &DVec3| p + far + random.point((DVec3::splat(-0.1), DVec3::splat(0.1)));
            let means: Vec<DVec3> = mesh.positions.iter().map(moved).collect();
            let pose = covariances(count, condition, &mut random);
            let mut posed_mesh = mesh.clone();
            posed_mesh.positions = means.clone();
            let posed = covariance_mesh(posed_mesh, &pose);
            let posed = surface.posed(&means, posed.covariances()).expect("as many vertices");
            surface.allow_for(std::slice::from_ref(&posed));

            let shared: Arc<dyn Surface> = Arc::new(surface);
            let mut world = World::new(&shared, moving());
            world
                .quadtree
                .set_covariance_cage(means, &pose)
                .expect("as many vertices");
            let view = random_view(&mut random, &posed);
            let snapshot = world.passes(&view, 6);
            let case = format!("{name}, condition {condition:.0e}");
            assert_eq!(findings(shared.topology(), &snapshot), [], "{case}");
            check(shared.topology(), &draw(&world, &snapshot), &case);
            let [position, normal] = errors(&world, &snapshot, &posed);

            println!("{case}: positions within {position:.1} eps, normals within {normal:.1e} rad");
            // At the last condition speeds reach 1e5 times the size.
            let limit = if condition < 1e6 { 1e-3 } else { 0.05 };
            assert!(position < 100.0 && normal < limit, "{case}: {position} {normal}");
        }
    }
}

fn cube() -> (GaussianProduct, Vec<DVec3>, Vec<[f64; 6]>) {
    let mesh = meshes::cube();
    let covariances = covariances(8, 1e2, &mut Random(2));
    let positions = mesh.positions.clone();
    let surface = GaussianProduct::new(&covariance_mesh(mesh, &covariances), GaussianSettings::default());
    (surface.expect("a surface"), positions, covariances)
}

#[test]
fn poses_of_covariances_that_do_not_fit_are_refused() {
    let (surface, means, covariances) = cube();
    let shared: Arc<dyn Surface> = Arc::new(surface);
    let mut world = World::new(&shared, moving());
    let message = |world: &mut World, covariances: &[[f64; 6]]| {
        let refused = world.quadtree.set_covariance_cage(means.clone(), covariances);
        refused.expect_err("refused").to_string()
    };
    let said = message(&mut world, &covariances[1..]);
    assert!(said.contains("7 covariances") && said.contains("8 vertices"), "{said}");
    for (entry, value) in [(0, f64::NAN), (0, -9.0), (3, f64::INFINITY)] {
        let mut broken = covariances.clone();
        broken[5] = [1e-3, 0.0, 0.0, -1.0, 0.0, -1.0];
        broken[5][entry] = value;
        let said = message(&mut world, &broken);
        assert!(said.contains("vertex 5"), "{said}");
    }
    let without = world.quadtree.set_cage(means.clone()).expect_err("refused").to_string();
    assert!(without.contains("covariances"), "{without}");
    let mut still = World::new(&shared, settings(Metric::Edge { pixels: 40.0 }));
    assert!(message(&mut still, &covariances).contains("moving"));
}

#[test]
fn a_gaussian_product_at_rest_has_no_pass_that_poses_it() {
    let (surface, ..) = cube();
    let shared: Arc<dyn Surface> = Arc::new(surface);
    for (settings, is_posed) in [(settings(Metric::Edge { pixels: 40.0 }), false), (moving(), true)] {
        let world = World::new(&shared, settings);
        let kind = keyleaf::Quadtree::kind(shared.as_ref(), world.quadtree.settings());
        assert_eq!(modules(&kind).iter().any(|module| module.name == "pose"), is_posed);
        assert_eq!(world.quadtree.is_posed_on_gpu(), is_posed);
    }
}

/// Disks that turn and flatten while their cube leans, in frames that do not settle.
#[test]
fn a_moving_gaussian_product_is_drawn_without_a_gap_in_every_frame() {
    let (mut surface, rest, _) = cube();
    let pose = |time: f64| -> (Vec<DVec3>, Vec<[f64; 6]>) {
        let means = rest.iter().map(|&p| p + DVec3::X * (time * p.y)).collect();
        let disk = |k: u32| {
            let turn = DVec3::new((time + f64::from(k)).cos(), (time + f64::from(k)).sin(), 0.3).normalize();
            (Symmetric3::IDENTITY - Symmetric3::outer(turn) * (1.0 - (-2.0 * time).exp())).to_array()
        };
        (means, (0..8).map(disk).collect())
    };
    for frame in 0..8 {
        let (means, covariances) = pose(f64::from(frame) / 2.0);
        let mut mesh = meshes::cube();
        mesh.positions.clone_from(&means);
        let posed = covariance_mesh(mesh, &covariances);
        let posed = surface.posed(&means, posed.covariances()).expect("as many vertices");
        surface.allow_for(std::slice::from_ref(&posed));
    }
    let shared: Arc<dyn Surface> = Arc::new(surface);
    let mut world = World::new(&shared, moving());
    let mut random = Random(3);
    for frame in 0..8 {
        let (means, covariances) = pose(f64::from(frame) / 2.0);
        world
            .quadtree
            .set_covariance_cage(means, &covariances)
            .expect("as many vertices");
        let snapshot = world.pass(&random_view(&mut random, shared.as_ref()));
        let case = format!("frame {frame}");
        assert_eq!(findings(shared.topology(), &snapshot), [], "{case}");
        check(shared.topology(), &draw(&world, &snapshot), &case);
    }
}
