//! The vertices that are drawn, as the GPU computes them: one position a site, bit by bit, and every edge matched by its reverse.

use crate::random::Random;
use crate::snapshot::{drawn_slots, findings};
use crate::world::{World, random_view, settings};
use crate::{meshes, surfaces};
use glam::Vec3;
use keyleaf::key::{Place, RootPoint, Site, Topology};
use keyleaf::read_back::Snapshot;
use keyleaf::surface::{Mesh, Surface};
use keyleaf::{BaseGrid, Metric, Settings};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Where the vertices of the base grid of a drawn leaf are. Twin of `grid.wgsl`.
fn grid_points(leaf: &Place, is_pair: bool, grid: &BaseGrid, k: u32) -> Vec<RootPoint> {
    let (unit, step) = (leaf.unit(), leaf.unit() >> k);
    let at = |vertex: &u32| {
        let (i, j) = (vertex & 0xffff, vertex >> 16);
        if is_pair && leaf.level == 0 && i < j {
            let before = Place::of_root(leaf.face, (leaf.root + 3) % 4);
            before.at((j - i) * step, unit - (i + j) * step)
        } else if is_pair {
            leaf.at(unit.wrapping_sub((i + j) * step), (i * step).wrapping_sub(j * step))
        } else {
            leaf.at(i * step, j * step)
        }
    };
    grid.vertices.iter().map(at).collect()
}

/// What is drawn: the site and the position of every vertex of every leaf, and the triangles.
pub struct Drawn {
    pub vertices: Vec<(Site, RootPoint, [f32; 3], [f32; 3])>,
    pub triangles: Vec<[usize; 3]>,
}

pub fn draw(world: &World, snapshot: &Snapshot) -> Drawn {
    let topology = world.surface.topology();
    let k = world.quadtree.settings().base_grid;
    let grid = BaseGrid::of(world.quadtree.settings());
    let slots = drawn_slots(snapshot);
    let emitted = world.emit(&slots);
    let mut drawn = Drawn {
        vertices: Vec::new(),
        triangles: Vec::new(),
    };
    for slot in slots.iter().map(|slot| *slot as usize) {
        let first = drawn.vertices.len();
        for at in grid_points(&snapshot.leaves[slot].place(), snapshot.is_pair(slot), &grid, k) {
            let i = drawn.vertices.len();
            drawn
                .vertices
                .push((Site::of(topology, at), at, emitted.positions[i], emitted.normals[i]));
        }
        drawn.triangles.extend(
            grid.indices
                .chunks(3)
                .map(|t| [t[0], t[1], t[2]].map(|v| first + usize::from(v))),
        );
    }
    assert_eq!(drawn.vertices.len(), emitted.positions.len());
    drawn
}

fn bits(position: [f32; 3]) -> [u32; 3] {
    position.map(f32::to_bits)
}

/// One bit pattern a site; finite; unit normals; each directed edge once, and its reverse once but on boundaries.
pub fn check(topology: &Topology, drawn: &Drawn, case: &str) {
    let mut position_of: HashMap<Site, [u32; 3]> = HashMap::new();
    for (site, at, position, normal) in &drawn.vertices {
        assert!(
            position
                .iter()
                .all(|x| x.is_finite() && x.to_bits() != (-0.0f32).to_bits()),
            "{case}: {position:?} at {at:?}"
        );
        assert!(
            (Vec3::from(*normal).length() - 1.0).abs() < 1e-5,
            "{case}: normal {normal:?} at {at:?}"
        );
        let known = *position_of.entry(*site).or_insert(bits(*position));
        assert_eq!(
            known,
            bits(*position),
            "{case}: {site:?} has two positions, the second at {at:?}"
        );
    }
    let mut edges: HashMap<[Site; 2], u32> = HashMap::new();
    let mut boundary = Vec::new();
    for triangle in &drawn.triangles {
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            let edge = [triangle[a], triangle[b]];
            let ends = edge.map(|v| drawn.vertices[v].0);
            assert_ne!(ends[0], ends[1], "{case}: a triangle without area");
            *edges.entry(ends).or_default() += 1;
            let [from, to] = edge.map(|v| drawn.vertices[v].1);
            if from.runs_along_boundary(to, topology) {
                boundary.push(ends);
            }
        }
    }
    for (ends, count) in &edges {
        assert_eq!(*count, 1, "{case}: {ends:?}");
    }
    for [a, b] in boundary {
        assert!(!edges.contains_key(&[b, a]), "{case}: both sides of a boundary");
        edges.insert([b, a], 1);
    }
    for [a, b] in edges.keys() {
        assert!(
            edges.contains_key(&[*b, *a]),
            "{case}: no triangle on the other side of {a:?} {b:?}"
        );
    }
}

/// Frames of jumps, unsettled ones too, each checked.
fn jumps(name: &str, surface: &Arc<dyn Surface>, k: u32, pixels: f32, seed: u64) -> usize {
    let mut world = World::new(
        surface,
        Settings {
            base_grid: k,
            max_level: 31 - k,
            capacity: 3000,
            ..settings(Metric::Edge { pixels })
        },
    );
    let mut random = Random(seed);
    let mut triangles = 0;
    for jump in 0..3 {
        let view = random_view(&mut random, surface.as_ref());
        let passes = [12, 3, 5][jump];
        let snapshot = world.passes(&view, passes);
        let case = format!("{name}, base grid {k}, jump {jump}");
        assert_eq!(findings(surface.topology(), &snapshot), [], "{case}");
        let drawn = draw(&world, &snapshot);
        check(surface.topology(), &drawn, &case);
        triangles += drawn.triangles.len();
    }
    triangles
}

#[test]
fn every_surface_is_drawn_without_a_gap_bit_by_bit_on_every_base_grid() {
    let mut triangles = 0;
    for (seed, (name, surface)) in (0..).zip(surfaces::all()) {
        for k in 0..4 {
            triangles += jumps(name, &surface, k, 40.0, seed * 10 + u64::from(k));
        }
    }
    println!("{triangles} triangles");
}

#[test]
fn random_meshes_are_drawn_without_a_gap_flat_and_displaced() {
    for seed in 0..8 {
        let mesh = meshes::random(seed);
        let displaced = [
            surfaces::flat(&mesh),
            surfaces::by_noise(&mesh),
            surfaces::by_texture(&mesh),
        ];
        for surface in displaced {
            jumps(&format!("random mesh {seed}"), &surface, (seed % 3) as u32, 50.0, seed);
        }
    }
}

#[test]
fn meshes_far_from_the_origin_and_slivers_are_drawn_without_a_gap() {
    let far = meshes::moved(meshes::house(), glam::DVec3::new(1e6, -2e6, 5e5));
    jumps("far house", &surfaces::flat(&far), 1, 40.0, 3);
    jumps("far house with noise", &surfaces::by_noise(&far), 1, 40.0, 3);
    jumps("sliver", &surfaces::flat(&meshes::sliver()), 1, 40.0, 4);
    jumps("torus", &surfaces::flat(&meshes::torus(7, 5)), 1, 40.0, 5);
}

/// OBJ models beside the repository, if they are there.
fn models() -> Option<Vec<PathBuf>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data/subd");
    let mut all = Vec::new();
    for folder in [folder.clone(), folder.join("osd_shapes")] {
        all.extend(
            std::fs::read_dir(folder)
                .ok()?
                .filter_map(|entry| entry.ok().map(|e| e.path())),
        );
    }
    all.retain(|path| path.extension().is_some_and(|e| e == "obj"));
    all.sort();
    Some(all)
}

#[test]
fn models_are_drawn_without_a_gap() {
    let Some(models) = models() else {
        println!("skipped: no folder ../shared/data/subd beside the repository");
        return;
    };
    let mut drawn = Vec::new();
    for path in &models {
        let name = path
            .file_name()
            .map(|n| n.to_string_lossy().into_owned())
            .unwrap_or_default();
        let model = match keyleaf_scene::read_model(path, &Default::default()) {
            Ok(model) => model,
            Err(error) => {
                println!("{name} is no surface: {error}");
                continue;
            }
        };
        if model.mesh.faces.len() > 2000 {
            continue; // time
        }
        let surface: Arc<dyn Surface> = Arc::new(Mesh::new(&model.mesh).expect("read_model checks"));
        let roots = surface.topology().half_edge_count();
        let settings = Settings {
            base_grid: 1,
            max_level: 30,
            capacity: roots + 2000,
            ..settings(Metric::Edge { pixels: 30.0 })
        };
        let mut world = World::new(&surface, settings);
        let mut random = Random(roots.into());
        for passes in [7, 2] {
            let view = random_view(&mut random, surface.as_ref());
            let snapshot = world.passes(&view, passes);
            assert_eq!(findings(surface.topology(), &snapshot), [], "{name}");
            check(surface.topology(), &draw(&world, &snapshot), &name);
        }
        drawn.push(name);
    }
    println!("{} of {} models: {drawn:?}", drawn.len(), models.len());
    assert!(drawn.len() > 20, "{} of {} models", drawn.len(), models.len());
}
