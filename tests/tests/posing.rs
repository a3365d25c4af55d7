//! Surfaces whose control mesh moves: what the GPU finds of a pose, against the same surface made of that pose in f64.

use crate::gpu::gpu;
use crate::meshes;
use crate::random::Random;
use crate::snapshot::findings;
use crate::watertight::{check, draw};
use crate::world::{World, random_view, settings};
use glam::DVec3;
use keyleaf::read_back::Snapshot;
use keyleaf::surface::{
    ControlMesh, Corner, CornerAttributes, CornerNormals, Crease, LimitSamples, LoopWeights, PolygonMesh, Subdivision,
    SubdivisionScheme, SubdivisionSettings, Surface, SurfaceTables, TrianglePatches,
};
use keyleaf::{Metric, Quadtree, Settings, View, modules};
use std::sync::Arc;

/// 2⁻²⁴: half a unit in the last place of an f32 in 1..2.
const EPSILON: f64 = 1.0 / 16_777_216.0;

pub fn moving() -> Settings {
    Settings {
        moving: true,
        ..settings(Metric::Edge { pixels: 40.0 })
    }
}

/// A surface that follows from the vertices of its control mesh.
#[derive(Clone)]
enum Moving {
    Subdivision(Arc<Subdivision>),
    Triangles(Arc<TrianglePatches>),
}

impl Moving {
    fn surface(&self) -> Arc<dyn Surface> {
        match self {
            Self::Subdivision(surface) => surface.clone(),
            Self::Triangles(surface) => surface.clone(),
        }
    }

    fn control_positions(&self) -> &[DVec3] {
        match self {
            Self::Subdivision(surface) => surface.control_positions(),
            Self::Triangles(surface) => surface.control_positions(),
        }
    }

    fn posed(&self, positions: &[DVec3]) -> Self {
        match self {
            Self::Subdivision(surface) => {
                Self::Subdivision(Arc::new(surface.posed(positions).expect("finite positions")))
            }
            Self::Triangles(surface) => Self::Triangles(Arc::new(surface.posed(positions).expect("finite positions"))),
        }
    }

    /// Whether an entry of table A is a position, and not a normal.
    fn is_position(&self, tables: &SurfaceTables, entry: usize) -> bool {
        match self {
            Self::Subdivision(_) => {
                let first_normal = u32::from_le_bytes(tables.params[4..8].try_into().expect("four bytes"));
                entry < first_normal as usize
            }
            Self::Triangles(surface) => {
                let entries = tables.a.len() / 4 / surface.topology().face_count() as usize;
                entry % entries < entries - 7
            }
        }
    }

    /// How many roundings of the largest coordinate a control point may be off.
    fn roundings(&self) -> f64 {
        match self {
            Self::Subdivision(_) => 8.0,
            // An edge has twice a middle less the mean of its ends.
            Self::Triangles(_) => 16.0,
        }
    }

    /// The words of a record of table B, and which of them are bounds.
    fn bounds(&self) -> (usize, std::ops::Range<usize>) {
        match self {
            Self::Subdivision(_) => (8, 2..5),
            Self::Triangles(_) => (4, 2..4),
        }
    }
}

/// Both schemes; faces with 3, 4, 5 and 7 corners, boundaries, creases and corners.
fn subdivisions() -> Vec<(&'static str, Moving)> {
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
        let surface = Subdivision::new(&control, SubdivisionSettings { scheme, isolation: 5 });
        Moving::Subdivision(Arc::new(surface.expect("a subdivision surface")))
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

/// The faces cut into triangles.
fn triangulated(mesh: PolygonMesh) -> PolygonMesh {
    let fans = mesh.faces.iter().flat_map(|face| {
        let (first, others) = (face[0], &face[1..]);
        others.windows(2).map(move |pair| vec![first, pair[0], pair[1]])
    });
    meshes::mesh(mesh.positions.clone(), fans.collect::<Vec<_>>())
}

/// A double cone: two vertices with many edges.
pub fn double_cone(sides: u32) -> PolygonMesh {
    let around = (0..sides).map(|k| {
        let (sin, cos) = (f64::from(k) / f64::from(sides) * std::f64::consts::TAU).sin_cos();
        DVec3::new(cos, 0.1 * (3.0 * sin).cos(), -sin)
    });
    let positions = around.chain([DVec3::Y, -DVec3::Y]).collect();
    let faces = (0..sides).flat_map(|k| {
        let next = (k + 1) % sides;
        [vec![k, next, sides], vec![next, k, sides + 1]]
    });
    meshes::mesh(positions, faces.collect::<Vec<_>>())
}

/// A normal at every corner: of its face at some, so that edges are hard, and none at others.
fn with_normals(mut mesh: PolygonMesh) -> PolygonMesh {
    let normal = |face: &[u32]| {
        let [p, q, r] = [0, 1, 2].map(|corner| mesh.positions[face[corner] as usize]);
        (q - p).cross(r - p).normalize().as_vec3().to_array()
    };
    let normals = (0..).zip(mesh.faces.iter()).flat_map(|(number, face)| {
        let own = if number % 3 == 0 { [0.0; 3] } else { normal(face) };
        [own; 3]
    });
    let normals = Some(normals.collect());
    mesh.corners = CornerAttributes {
        normals,
        ..CornerAttributes::default()
    };
    mesh
}

/// QAS of both kinds and PN triangles; closed meshes and boundaries, vertices with 3 to 24 edges, vertices where triangles touch only.
fn triangle_patches() -> Vec<(String, Moving)> {
    let meshes = [
        ("tetrahedron", meshes::tetrahedron()),
        ("house", triangulated(meshes::house())),
        ("open mesh", triangulated(meshes::open())),
        ("torus", triangulated(meshes::torus(7, 5))),
        ("random mesh", triangulated(meshes::random(3))),
        ("double cone", double_cone(24)),
    ];
    let mut all = Vec::new();
    for (name, mesh) in meshes {
        let control = ControlMesh::from(mesh.clone());
        let made = [
            ("QAS", TrianglePatches::of_loop(&control, LoopWeights::Warren)),
            ("Butterfly", TrianglePatches::butterfly(&mesh)),
            ("PN", TrianglePatches::point_normal(&mesh, CornerNormals::AngleWeighted)),
            (
                "PN with normals",
                TrianglePatches::point_normal(&with_normals(mesh), CornerNormals::OfMesh),
            ),
        ];
        all.extend(made.map(|(kind, surface)| {
            (
                format!("{kind} of {name}"),
                Moving::Triangles(Arc::new(surface.expect("triangles"))),
            )
        }));
    }
    all
}

fn surfaces() -> Vec<(String, Moving)> {
    let subdivisions = subdivisions()
        .into_iter()
        .map(|(name, surface)| (name.to_owned(), surface));
    subdivisions.chain(triangle_patches()).collect()
}

/// Every vertex of the control mesh moved a little, and all of them far away.
fn pose(surface: &Moving, random: &mut Random) -> Vec<DVec3> {
    let (low, high) = surface.surface().bounding_box();
    let size = (high - low).length();
    let far = random.point((DVec3::splat(-size), DVec3::splat(size)));
    let control = surface.control_positions();
    let moved = |&position: &DVec3| position + far + 0.1 * random.point((DVec3::splat(-size), DVec3::splat(size)));
    control.iter().map(moved).collect()
}

fn entries(all: &[f32]) -> Vec<DVec3> {
    let entry = |e: &[f32]| DVec3::new(e[0].into(), e[1].into(), e[2].into());
    all.chunks_exact(4).map(entry).collect()
}

/// Compares control points, normals and bounds of the GPU with those of the surface made of the pose.
fn compare(name: &str, quadtree: &Quadtree, posed: &Moving) {
    let (a, b) = quadtree
        .read_surface(&gpu().device, &gpu().queue)
        .expect("the device works");
    let surface = posed.surface();
    let tables = surface.tables(quadtree.origin());
    let (found, truth) = (entries(&a), entries(&tables.a));
    assert_eq!((found.len(), b.len()), (truth.len(), tables.b.len()), "{name}");
    let positions = (0..truth.len()).filter(|&k| posed.is_position(&tables, k));
    let largest = positions.map(|k| truth[k].abs().max_element()).fold(0.0, f64::max);
    let mut worst = [0f64; 2];
    for (k, (found, truth)) in found.iter().zip(&truth).enumerate() {
        let off = found.distance(*truth);
        let (which, unit) = if posed.is_position(&tables, k) {
            (0, EPSILON * largest)
        } else {
            (1, 1.0)
        };
        worst[which] = worst[which].max(off / unit);
    }
    let (record, bounds) = posed.bounds();
    let mut loosest = 0f64;
    for half_edge in 0..surface.topology().half_edge_count() as usize {
        for word in bounds.clone().map(|word| record * half_edge + word) {
            let [found, truth] = [&b, &tables.b].map(|words| f64::from(f32::from_bits(words[word])));
            assert!(
                found >= truth * (1.0 - 1e-6) && found <= truth * 1.0001 + 64.0 * EPSILON * largest,
                "{name}: half-edge {half_edge}: {found} {truth}"
            );
            loosest = loosest.max((found - truth) / (EPSILON * largest));
        }
    }
    println!(
        "{name}: control points within {:.2} eps, normals within {:.1e}, bounds up to {loosest:.1} eps larger",
        worst[0], worst[1]
    );
    assert!(worst[0] < posed.roundings() && worst[1] < 1e-3, "{name}: {worst:?}");
}

#[test]
fn the_gpu_poses_surfaces_as_they_are_made_of_the_pose() {
    let mut random = Random(5);
    for (name, surface) in surfaces() {
        let shared = surface.surface();
        let mut world = World::new(&shared, moving());
        let view = random_view(&mut random, shared.as_ref());
        world.passes(&view, 2);
        for _ in 0..2 {
            let positions = pose(&surface, &mut random);
            world.quadtree.set_cage(positions.clone()).expect("as many vertices");
            world.frame(&view);
            compare(&name, &world.quadtree, &surface.posed(&positions));
        }
    }
}

/// How far the drawn vertices are from a surface in f64: positions in roundings of the largest coordinate, normals in radians.
pub fn errors(world: &World, snapshot: &Snapshot, truth: &dyn Surface) -> [f64; 2] {
    let origin = world.quadtree.origin();
    let (low, high) = truth.bounding_box();
    let largest = (low - origin).abs().max((high - origin).abs()).max_element();
    let mut worst = [0f64; 2];
    for (_, at, position, normal) in &draw(world, snapshot).vertices {
        let on = truth.drawn(*at);
        let [position, normal] = [position, normal].map(|v| DVec3::from(v.map(f64::from)));
        worst[0] = worst[0].max(position.distance(on.position - origin) / (EPSILON * largest));
        // Where tangents are all but parallel, or one all but nothing, digits decide the normal.
        let (du, dv) = (on.du.length(), on.dv.length());
        if on.du.cross(on.dv).length() < 1e-3 * du.max(dv).powi(2) {
            continue;
        }
        worst[1] = worst[1].max(normal.angle_between(on.normal));
    }
    worst
}

#[test]
fn posed_triangle_patches_are_drawn_as_they_are_in_f64() {
    let mut random = Random(4);
    for (name, surface) in triangle_patches() {
        let positions = pose(&surface, &mut random);
        let posed = surface.posed(&positions).surface();
        let mut world = World::new(&surface.surface(), moving());
        world.quadtree.set_cage(positions).expect("as many vertices");
        let snapshot = world.passes(&random_view(&mut random, posed.as_ref()), 6);
        let worst = errors(&world, &snapshot, posed.as_ref());
        println!(
            "{name}: positions within {:.2} eps, normals within {:.1e} rad",
            worst[0], worst[1]
        );
        assert!(worst[0] < 16.0 && worst[1] < 1e-4, "{name}: {worst:?}");
    }
}

#[test]
fn collapsed_poses_are_drawn_closed_with_unit_normals() {
    for (name, surface) in triangle_patches() {
        let shared = surface.surface();
        let view = random_view(&mut Random(6), shared.as_ref());
        let mut world = World::new(&shared, moving());
        for scale in [
            DVec3::ZERO,
            DVec3::X,
            DVec3::new(1.0, 0.0, 1.0),
            DVec3::splat(1e-9),
            DVec3::splat(1e9),
        ] {
            let positions = surface.control_positions().iter().map(|&position| position * scale);
            world.quadtree.set_cage(positions.collect()).expect("as many vertices");
            let snapshot = world.passes(&view, 3);
            let case = format!("{name}, scaled by {scale}");
            assert_eq!(findings(shared.topology(), &snapshot), [], "{case}");
            check(shared.topology(), &draw(&world, &snapshot), &case);
        }
    }
}

#[test]
fn what_does_not_move_has_no_pass_and_no_buffer_for_that() {
    for (name, surface) in surfaces() {
        let shared = surface.surface();
        for settings in [settings(Metric::Edge { pixels: 40.0 }), moving()] {
            let world = World::new(&shared, settings);
            let passes = modules(&Quadtree::kind(shared.as_ref(), &settings));
            let has_pass = passes.iter().any(|module| module.name == "pose");
            let has_buffer = world.quadtree.memory().iter().any(|(buffer, _)| *buffer == "pose");
            assert_eq!([has_pass, has_buffer], [settings.moving; 2], "{name}");
        }
    }
}

#[test]
fn what_is_made_of_samples_is_made_anew_for_each_pose() {
    let (_, limit) = subdivisions().pop().expect("surfaces");
    let sampled = |limit: &Moving| -> Arc<dyn Surface> {
        let limit = limit.surface();
        let samples = LimitSamples::of_surface(limit.topology(), |at| limit.frame(at));
        Arc::new(TrianglePatches::quadratic(limit.topology(), &samples).expect("triangles"))
    };
    let mut random = Random(8);
    let mut world = World::new(&sampled(&limit), moving());
    assert!(!world.quadtree.is_posed_on_gpu());
    for _ in 0..3 {
        let posed = sampled(&limit.posed(&pose(&limit, &mut random)));
        world
            .quadtree
            .set_surface(&gpu().queue, posed.clone())
            .expect("the same kind and size");
        world.passes(&random_view(&mut random, posed.as_ref()), 3);
        let (a, b) = world
            .quadtree
            .read_surface(&gpu().device, &gpu().queue)
            .expect("the device works");
        let tables = posed.tables(world.quadtree.origin());
        assert!(a == tables.a && b == tables.b);
    }
}

#[test]
fn a_moving_surface_is_drawn_without_a_gap_in_every_frame() {
    let mut random = Random(9);
    for (name, surface) in surfaces() {
        let shared = surface.surface();
        for k in [0, 2] {
            let settings = Settings {
                base_grid: k,
                max_level: 20,
                ..moving()
            };
            let mut world = World::new(&shared, settings);
            let [from, to] = [0, 1].map(|_| pose(&surface, &mut random));
            let view = random_view(&mut random, surface.posed(&from).surface().as_ref());
            for frame in 0..6u32 {
                let part = f64::from(frame % 4) / 3.0;
                let between = from.iter().zip(&to).map(|(from, to)| from.lerp(*to, part));
                world.quadtree.set_cage(between.collect()).expect("as many vertices");
                let snapshot = world.pass(&view);
                let case = format!("{name}, base grid {k}, frame {frame}");
                assert_eq!(findings(shared.topology(), &snapshot), [], "{case}");
                check(shared.topology(), &draw(&world, &snapshot), &case);
            }
        }
    }
}

#[test]
fn a_pose_settles_to_the_same_leaves_however_it_was_reached() {
    let mut random = Random(2);
    for (name, surface) in surfaces() {
        let shared = surface.surface();
        let [first, last] = [0, 1].map(|_| pose(&surface, &mut random));
        let view: View = random_view(&mut random, surface.posed(&last).surface().as_ref());
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
    let shared = surface.surface();
    let mut moving = World::new(&shared, moving());
    let message = |world: &mut World, positions| world.quadtree.set_cage(positions).expect_err("refused").to_string();
    assert!(message(&mut moving, vertices[1..].to_vec()).contains("vertices"));
    let mut broken = vertices.clone();
    broken[3].y = f64::NAN;
    assert!(message(&mut moving, broken).contains("vertex 3"));
    let mut still = World::new(&shared, settings(Metric::Edge { pixels: 40.0 }));
    assert!(message(&mut still, vertices).contains("moving"));
}
