//! Closed parts of models of patches: their triangles, as they are drawn and exported, match edge by edge in the bits of their positions.

use crate::random::Random;
use crate::watertight::{Drawn, draw};
use crate::world::{World, random_view, settings};
use keyleaf::surface::{PatchKind, PatchSettings, Patches, Surface};
use keyleaf::{Metric, Settings};
use keyleaf_key::{HalfEdge, Topology};
use keyleaf_scene::{PatchFileOptions, read_patches};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The part of the model that each face belongs to: the least face that edges connect it with.
fn parts(topology: &Topology) -> Vec<u32> {
    let mut part: Vec<u32> = (0..topology.face_count()).collect();
    loop {
        let before = part.clone();
        for root in topology.roots() {
            if let Some(twin) = topology.twin(root.face, root.root) {
                let least = part[root.face as usize].min(part[twin.face as usize]);
                part[root.face as usize] = least;
                part[twin.face as usize] = least;
            }
        }
        if part == before {
            return part;
        }
    }
}

/// Whether a half-edge has no other side, and is no pole either.
fn is_open(surface: &Patches, HalfEdge { face, root }: HalfEdge) -> bool {
    let point = |u, v| surface.face_coord(face, u, v).map(|at| surface.point(at));
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let [a, b] = [root, (root + 1) % 4].map(|corner| corners[corner as usize]);
    let ends = [a, b, [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0]].map(|[u, v]| point(u, v).expect("in the square"));
    let is_pole = ends[0] == ends[1] && ends[1] == ends[2];
    surface.topology().twin(face, root).is_none() && !is_pole
}

/// How many edges of the part's triangles are not matched by their reverse.
fn unmatched(drawn: &Drawn, part: &[u32], which: u32) -> usize {
    let mut edges: HashMap<[[u32; 3]; 2], i32> = HashMap::new();
    for triangle in &drawn.triangles {
        if part[drawn.vertices[triangle[0]].1.face as usize] != which {
            continue;
        }
        let corners = triangle.map(|v| drawn.vertices[v].2.map(f32::to_bits));
        if corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0] {
            continue; // at a pole
        }
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            let (a, b) = (corners[a], corners[b]);
            *edges.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { -1 };
        }
    }
    edges.values().filter(|balance| **balance != 0).count()
}

fn files() -> Option<Vec<PathBuf>> {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data");
    let mut all: Vec<PathBuf> = std::fs::read_dir(data.join("nurbs"))
        .ok()?
        .flatten()
        .map(|e| e.path())
        .collect();
    all.sort();
    all.extend(["teapot", "teacup", "teaspoon"].map(|name| data.join("teaset").join(name)));
    Some(all)
}

#[test]
fn closed_parts_of_models_are_watertight_bit_by_bit() {
    let Some(files) = files() else {
        println!("skipped: no folder ../shared/data beside the repository");
        return;
    };
    let mut closed_parts = 0;
    for file in files {
        let name = file
            .file_name()
            .map(|n| n.to_string_lossy().into_owned())
            .unwrap_or_default();
        let model = read_patches(&file, &PatchFileOptions { ignore_trims: true }).expect("a model of patches");
        let kind = if model.is_bezier {
            PatchKind::Bezier
        } else {
            PatchSettings::default().kind
        };
        let settings_of = PatchSettings {
            kind,
            ..PatchSettings::default()
        };
        let patches = Patches::new(model.surfaces, settings_of).expect("surfaces that can be joined");
        let part = parts(patches.topology());
        let mut is_closed: HashMap<u32, bool> = HashMap::new();
        for root in patches.topology().roots() {
            let half_edge = HalfEdge {
                face: root.face,
                root: root.root,
            };
            *is_closed.entry(part[root.face as usize]).or_insert(true) &= !is_open(&patches, half_edge);
        }
        let closed: Vec<u32> = is_closed.iter().filter(|(_, is)| **is).map(|(part, _)| *part).collect();
        println!("{name}: {} parts, {} closed", is_closed.len(), closed.len());
        closed_parts += closed.len();
        if closed.is_empty() {
            continue;
        }
        let surface: Arc<dyn Surface> = Arc::new(patches);
        let roots = surface.topology().half_edge_count();
        let settings = Settings {
            base_grid: 1,
            max_level: 30,
            capacity: roots + 4000,
            cull: false,
            ..settings(Metric::Edge { pixels: 20.0 })
        };
        let mut world = World::new(&surface, settings);
        let mut random = Random(roots.into());
        for passes in [9, 2] {
            let snapshot = world.passes(&random_view(&mut random, surface.as_ref()), passes);
            let drawn = draw(&world, &snapshot);
            for which in &closed {
                assert_eq!(unmatched(&drawn, &part, *which), 0, "{name}, the part of face {which}");
            }
        }
    }
    assert!(closed_parts > 0, "no model has a closed part");
}
