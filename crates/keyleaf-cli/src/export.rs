//! `keyleaf export`: the very triangles that are drawn.

use crate::arguments::{SceneArguments, ViewArguments};
use crate::collapse::collapse;
use crate::output::{self, thousands};
use crate::{Outcome, progress, session};
use anyhow::{bail, ensure};
use clap::Args;
use glam::{DAffine3, DMat3, DVec3};
use keyleaf::headless::Headless;
use keyleaf::inspect::Inspector;
use keyleaf::key::{MAX_LEVEL, Place, Topology};
use keyleaf::layout::MAX_CAPACITY;
use keyleaf::{BaseGrid, Quadtree};
use keyleaf_scene::{ExportMesh, write_mesh};
use keyleaf_stage::check::{Welder, grid_point};
use keyleaf_stage::{Loaded, Show, Stage, StageLook};
use serde_json::json;
use std::path::PathBuf;
use std::time::Instant;

/// Write the triangles that are drawn for a view to a model
///
/// Positions are world space, printed so that every f32 keeps its bits. Vertices that are the same point of the surface are written
/// once, so that a closed surface gives a closed mesh: with --no-cull or --uniform every edge is used once in each direction. Triangles
/// with equal corners, as at the poles of patches, are left out.
#[derive(Args)]
#[command(after_help = "Examples:
  keyleaf export scenes/fox.ron -o fox.obj
  keyleaf export cube.obj -o fine.stl --uniform 3 --base-grid 0
  keyleaf export scenes/terrain_real.ron -o view.ply --camera start --no-cull --normals")]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    #[command(flatten)]
    view: ViewArguments,
    /// The model: .obj, .ply or .stl
    #[arg(long, short, value_name = "FILE")]
    output: PathBuf,
    /// All of the surface, also what the view does not see
    #[arg(long)]
    no_cull: bool,
    /// Every leaf at level N, whatever the view
    #[arg(long, value_name = "N", conflicts_with_all = ["no_cull", "camera", "eye", "frames"])]
    uniform: Option<u32>,
    /// Write unit normals; at a vertex with several, their mean
    #[arg(long)]
    normals: bool,
    /// Frames to refine for [default: until nothing changes]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    frames: Option<u32>,
    /// Print a report as JSON
    #[arg(long)]
    json: bool,
}

/// What is written.
#[derive(Default)]
struct Triangles {
    positions: Vec<[f32; 3]>,
    normals: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

/// Leaves whose vertices are asked for at once.
const PIECE: usize = 1 << 15;

/// Runs the command.
pub fn run(arguments: &Arguments, quiet: bool) -> anyhow::Result<Outcome> {
    let start = Instant::now();
    let format = output::extension(&arguments.output);
    let file = arguments.output.display();
    ensure!(
        ["obj", "ply", "stl"].contains(&format.as_str()),
        "{file}: unknown model type '{format}'; expected .obj, .ply or .stl"
    );
    ensure!(
        !arguments.normals || format != "stl",
        "{file}: .stl has no normals of vertices; expected .obj or .ply"
    );
    output::ensure_writable(&arguments.output)?;
    let mut loaded = arguments.scene.load(quiet)?;
    loaded.pose(arguments.view.time)?;
    if let Some(level) = arguments.uniform {
        make_room(&mut loaded, level)?;
    }
    let gpu = session::device()?;
    let mut stage = session::stage(
        &gpu,
        &loaded,
        StageLook {
            show: Show::Level,
            ..StageLook::default()
        },
    )?;
    match arguments.uniform {
        Some(level) => set_uniform(&gpu, &mut stage, level)?,
        None => {
            let (_, view) = arguments.view.view(&loaded)?;
            session::settle(&gpu, &mut stage, &view, arguments.frames, quiet)?;
        }
    }
    let mut all = Triangles::default();
    let mut leaves = 0;
    for object in &stage.objects {
        leaves += add(&gpu, &object.quadtree, arguments, &mut all, quiet)?;
    }
    collapse(&mut all.positions, &mut all.normals, &mut all.triangles);
    let unit = |n: &DVec3| n.try_normalize().unwrap_or(DVec3::Y).as_vec3().to_array();
    let normals: Vec<[f32; 3]> = all.normals.iter().map(unit).collect();
    let mesh = ExportMesh {
        positions: &all.positions,
        normals: arguments.normals.then_some(&normals),
        triangles: &all.triangles,
    };
    write_mesh(&arguments.output, &mesh)?;
    let seconds = start.elapsed().as_secs_f64();
    let (vertices, triangles) = (all.positions.len(), all.triangles.len());
    if arguments.json {
        output::print_json(&json!({
            "file": arguments.output, "leaves": leaves, "vertices": vertices, "triangles": triangles, "seconds": seconds,
        }))?;
    } else {
        let [leaves, vertices, triangles] = [leaves, vertices, triangles].map(|n| thousands(n as u64));
        output::print(&format!(
            "{file}: {leaves} leaves, {vertices} vertices, {triangles} triangles, {seconds:.1} s"
        ))?;
    }
    Ok(Outcome::Done)
}

/// Raises the capacities so that all nodes of a level fit, if they can.
fn make_room(loaded: &mut Loaded, level: u32) -> anyhow::Result<()> {
    for object in &mut loaded.objects {
        let deepest = MAX_LEVEL - object.settings.base_grid;
        ensure!(
            level <= deepest,
            "level {level} is too deep: with base grid {} at most {deepest}",
            object.settings.base_grid
        );
        let leaves = u128::from(object.surface.topology().half_edge_count()) << (2 * level);
        if leaves > MAX_CAPACITY.into() {
            let least = object.surface.topology().half_edge_count();
            let fits = (0..level)
                .rev()
                .find(|l| u128::from(least) << (2 * l) <= MAX_CAPACITY.into())
                .unwrap_or(0);
            bail!(
                "surface {}: {least} roots at level {level} are {leaves} leaves, more than the {MAX_CAPACITY} that a quadtree holds: \
                 expected at most level {fits}",
                object.name
            );
        }
        object.settings.capacity = leaves as u32;
        object.settings.max_level = object.settings.max_level.max(level);
    }
    Ok(())
}

fn set_uniform(gpu: &Headless, stage: &mut Stage, level: u32) -> anyhow::Result<()> {
    for object in &mut stage.objects {
        let mut leaves: Vec<Place> = object.quadtree.surface().topology().roots().collect();
        for _ in 0..level {
            leaves = leaves.into_iter().flat_map(Place::children).collect();
        }
        object.quadtree.set_leaves(&gpu.queue, &leaves)?;
    }
    // The writes are carried out with the next submission, and the buffers are read by one.
    gpu.queue.submit([]);
    Ok(())
}

/// Adds the triangles of a quadtree; the number of leaves that they belong to.
fn add(
    gpu: &Headless,
    quadtree: &Quadtree,
    arguments: &Arguments,
    all: &mut Triangles,
    quiet: bool,
) -> anyhow::Result<usize> {
    let inspector = Inspector::new(
        &gpu.device,
        &Quadtree::kind(quadtree.surface().as_ref(), quadtree.settings()),
    )?;
    let snapshot = quadtree.read_back(&gpu.device, &gpu.queue)?;
    let all_slots = || {
        let odd = |slot: u32| {
            snapshot.leaves[slot as usize]
                .place()
                .digit()
                .is_some_and(|digit| digit & 1 == 1)
        };
        (0..snapshot.leaves.len() as u32)
            .filter(|&slot| !(odd(slot) && snapshot.is_pair(slot as usize)))
            .collect()
    };
    let whole = arguments.no_cull || arguments.uniform.is_some();
    let mut slots: Vec<u32> = if whole { all_slots() } else { snapshot.visible.clone() };
    // The order of slots depends on the device's scheduling; that of the file must not.
    slots.sort_by_key(|&slot| snapshot.leaves[slot as usize].place());
    let k = quadtree.settings().base_grid;
    let grid = BaseGrid::new(k);
    let placed = Placed::new(quadtree);
    let topology: &Topology = quadtree.surface().topology();
    let first = all.positions.len();
    let points = slots.len() as u64 * grid.vertices.len() as u64 + first as u64;
    ensure!(
        u32::try_from(points).is_ok(),
        "{points} vertices are more than a model can hold: expected fewer leaves"
    );
    let mut welder = Welder::with_capacity(slots.len() * grid.vertices.len() / 2);
    let bar = progress::bar(slots.len() as u64, "evaluating", quiet);
    for piece in slots.chunks(PIECE) {
        let emitted = inspector.emit(&gpu.device, &gpu.queue, quadtree, piece)?;
        for (i, &slot) in piece.iter().enumerate() {
            let (place, is_pair) = (snapshot.leaves[slot as usize].place(), snapshot.is_pair(slot as usize));
            let indices: Vec<u32> = grid
                .vertices
                .iter()
                .enumerate()
                .map(|(j, v)| {
                    let at = i * grid.vertices.len() + j;
                    let point = grid_point(place, is_pair, [v & 0xffff, v >> 16], k);
                    let (number, is_new) = welder.index(topology, point);
                    if is_new {
                        all.positions.push(placed.position(emitted.positions[at]));
                        all.normals.push(DVec3::ZERO);
                    }
                    let index = first + number as usize;
                    all.normals[index] += placed.normal(emitted.normals[at]);
                    index as u32
                })
                .collect();
            let corners = grid
                .indices
                .as_chunks::<3>()
                .0
                .iter()
                .map(|t| t.map(|v| indices[usize::from(v)]));
            // An object that is mirrored keeps its outside.
            all.triangles
                .extend(corners.map(|[a, b, c]| if placed.is_mirrored { [a, c, b] } else { [a, b, c] }));
        }
        bar.inc(piece.len() as u64);
    }
    bar.finish_and_clear();
    Ok(slots.len())
}

/// From emitted vertices to the world: a function of their bits alone, so that equal points stay equal.
struct Placed {
    origin: DVec3,
    world_from_object: DAffine3,
    normals: DMat3,
    is_mirrored: bool,
}

impl Placed {
    fn new(quadtree: &Quadtree) -> Self {
        let linear = quadtree.world_from_object().matrix3;
        let is_mirrored = linear.determinant() < 0.0;
        Self {
            origin: quadtree.origin(),
            world_from_object: *quadtree.world_from_object(),
            normals: linear.inverse().transpose() * if is_mirrored { -1.0 } else { 1.0 },
            is_mirrored,
        }
    }

    fn position(&self, p: [f32; 3]) -> [f32; 3] {
        let object = DVec3::from(p.map(f64::from)) + self.origin;
        // Adding zero turns -0 into +0.
        self.world_from_object
            .transform_point3(object)
            .as_vec3()
            .to_array()
            .map(|c| c + 0.0)
    }

    fn normal(&self, n: [f32; 3]) -> DVec3 {
        (self.normals * DVec3::from(n.map(f64::from))).normalize_or_zero()
    }
}
