//! Surfaces whose control mesh moves: what the GPU finds of a pose, against the same surface made of that pose in f64.

use crate::gpu::gpu;
use crate::meshes;
use crate::random::Random;
use crate::snapshot::findings;
use crate::watertight::{check, draw};
use crate::world::{World, random_view, settings};
use glam::DVec3;
use keyleaf::surface::{
    ControlMesh, Corner, Crease, LoopWeights, PolygonMesh, Subdivision, SubdivisionScheme, SubdivisionSettings,
    Surface, SurfaceTables,
};
use keyleaf::{Metric, Quadtree, Settings, View};
use keyleaf_key::Topology;
use std::sync::Arc;

/// 2⁻²⁴: half a unit in the last place of an f32 in 1..2.
const EPSILON: f64 = 1.0 / 16_777_216.0;

fn moving() -> Settings {
    Settings {
        moving: true,
        ..settings(Metric::Edge { pixels: 40.0 })
    }
}

/// Both schemes; faces with 3, 4, 5 and 7 corners, boundaries, creases and corners.
fn surfaces() -> Vec<(&'static str, Subdivision)> {
    let make = |mesh: PolygonMesh, scheme, sharp: bool| {
        let mut control = ControlMesh::from(mesh);
        if sharp {
            let face = control.mesh.faces.iter().next().expect("a face");
            let [a, b] = [face[0], face[1]];
            control.creases.push(Crease {
                vertices: [a, b],
                sharpness: 2.5,
            });
            control.corners.push(Corner {
                vertex: a,
                sharpness: 10.0,
            });
        }
        Subdivision::new(&control, SubdivisionSettings { scheme, isolation: 5 }).expect("a subdivision surface")
    };
    let (quads, triangles) = (
        SubdivisionScheme::CatmullClark,
        SubdivisionScheme::Loop(LoopWeights::Loop),
    );
    vec![
        ("house", make(meshes::house(), quads, false)),
        ("sharp house", make(meshes::house(), quads, true)),
        ("open mesh", make(meshes::open(), quads, false)),
        ("torus", make(meshes::torus(7, 5), quads, false)),
        ("random mesh", make(meshes::random(3), quads, false)),
        ("tetrahedron", make(meshes::tetrahedron(), triangles, false)),
        ("sharp tetrahedron", make(meshes::tetrahedron(), triangles, true)),
    ]
}

/// Every vertex of the control mesh moved a little, and all of them far away.
fn pose(surface: &Subdivision, random: &mut Random) -> Vec<DVec3> {
    let (low, high) = surface.bounding_box();
    let size = (high - low).length();
    let far = random.point((DVec3::splat(-size), DVec3::splat(size)));
    let control = surface.control_positions();
    let moved = |&position: &DVec3| position + far + 0.1 * random.point((DVec3::splat(-size), DVec3::splat(size)));
    control.iter().map(moved).collect()
}

/// The entry of the first normal.
fn first_normal(tables: &SurfaceTables) -> usize {
    u32::from_le_bytes(tables.params[4..8].try_into().expect("four bytes")) as usize
}

/// Compares control points, normals and bounds of the GPU with those of the surface made of the pose.
fn compare(name: &str, topology: &Topology, quadtree: &Quadtree, posed: &Subdivision) {
    let (a, b) = quadtree
        .read_surface(&gpu().device, &gpu().queue)
        .expect("the device works");
    let tables = posed.tables(quadtree.origin());
    let normals = first_normal(&tables);
    let entries = |all: &[f32]| -> Vec<DVec3> {
        let entry = |e: &[f32]| DVec3::new(e[0].into(), e[1].into(), e[2].into());
        all.chunks_exact(4).map(entry).collect()
    };
    let (found, truth) = (entries(&a), entries(&tables.a));
    assert_eq!((found.len(), b.len()), (truth.len(), tables.b.len()), "{name}");
    let largest = truth[..normals]
        .iter()
        .map(|p| p.abs().max_element())
        .fold(0.0, f64::max);
    let mut worst = [0f64; 2];
    for (k, (found, truth)) in found.iter().zip(&truth).enumerate() {
        let off = found.distance(*truth);
        let which = usize::from(k >= normals);
        worst[which] = worst[which].max(off / if which == 0 { EPSILON * largest } else { 1.0 });
    }
    for root in topology.roots() {
        let record = 8 * topology.half_edge_index(root.face, root.root) as usize;
        let words = record + 2..record + 5;
        for (found, truth) in b[words.clone()].iter().zip(&tables.b[words]) {
            let [found, truth] = [found, truth].map(|word| f32::from_bits(*word));
            assert!(
                found >= truth * (1.0 - 1e-6) && found <= truth * 1.0001 + 1e-3 * (EPSILON * largest) as f32,
                "{name}: {root:?}: {found} {truth}"
            );
        }
    }
    println!(
        "{name}: control points within {:.2} eps, normals within {:.1e}",
        worst[0], worst[1]
    );
    assert!(worst[0] < 8.0 && worst[1] < 1e-3, "{name}: {worst:?}");
}

#[test]
fn the_gpu_poses_surfaces_as_they_are_made_of_the_pose() {
    let mut random = Random(5);
    for (name, surface) in surfaces() {
        let shared: Arc<dyn Surface> = Arc::new(surface.clone());
        let mut world = World::new(&shared, moving());
        let view = random_view(&mut random, &surface);
        world.passes(&view, 2);
        for _ in 0..2 {
            let positions = pose(&surface, &mut random);
            world.quadtree.set_cage(positions.clone()).expect("as many vertices");
            world.frame(&view);
            let posed = surface.posed(&positions).expect("finite positions");
            compare(name, surface.topology(), &world.quadtree, &posed);
        }
    }
}

#[test]
fn a_moving_surface_is_drawn_without_a_gap_in_every_frame() {
    let mut random = Random(9);
    for (name, surface) in surfaces() {
        let shared: Arc<dyn Surface> = Arc::new(surface.clone());
        for k in [0, 2] {
            let settings = Settings {
                base_grid: k,
                max_level: 20,
                ..moving()
            };
            let mut world = World::new(&shared, settings);
            let [from, to] = [0, 1].map(|_| pose(&surface, &mut random));
            let view = random_view(&mut random, &surface.posed(&from).expect("finite positions"));
            for frame in 0..6u32 {
                let part = f64::from(frame % 4) / 3.0;
                let between = from.iter().zip(&to).map(|(from, to)| from.lerp(*to, part));
                world.quadtree.set_cage(between.collect()).expect("as many vertices");
                let snapshot = world.pass(&view);
                let case = format!("{name}, base grid {k}, frame {frame}");
                assert_eq!(findings(surface.topology(), &snapshot), [], "{case}");
                check(surface.topology(), &draw(&world, &snapshot), &case);
            }
        }
    }
}

#[test]
fn a_pose_settles_to_the_same_leaves_however_it_was_reached() {
    let mut random = Random(2);
    for (name, surface) in surfaces() {
        let shared: Arc<dyn Surface> = Arc::new(surface.clone());
        let [first, last] = [0, 1].map(|_| pose(&surface, &mut random));
        let view: View = random_view(&mut random, &surface.posed(&last).expect("finite positions"));
        let mut settled = Vec::new();
        for before in [None, Some(&first)] {
            let mut world = World::new(&shared, moving());
            if let Some(before) = before {
                world.quadtree.set_cage(before.clone()).expect("as many vertices");
                world.passes(&view, 8);
            }
            world.quadtree.set_cage(last.clone()).expect("as many vertices");
            settled.push(crate::world::places(&world.passes(&view, 60)));
        }
        assert_eq!(settled[0], settled[1], "{name}");
    }
}

#[test]
fn poses_that_do_not_fit_are_refused() {
    let (_, surface) = surfaces().remove(0);
    let vertices = surface.control_positions().to_vec();
    let shared: Arc<dyn Surface> = Arc::new(surface);
    let mut moving = World::new(&shared, moving());
    let message = |world: &mut World, positions| world.quadtree.set_cage(positions).expect_err("refused").to_string();
    assert!(message(&mut moving, vertices[1..].to_vec()).contains("vertices"));
    let mut broken = vertices.clone();
    broken[3].y = f64::NAN;
    assert!(message(&mut moving, broken).contains("vertex 3"));
    let mut still = World::new(&shared, settings(Metric::Edge { pixels: 40.0 }));
    assert!(message(&mut still, vertices).contains("moving"));
}
