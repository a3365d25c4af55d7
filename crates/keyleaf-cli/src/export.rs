//! `keyleaf export`: the very triangles that are drawn.

use crate::arguments::{SceneArguments, ViewArguments};
use crate::output::{self, thousands};
use crate::{Outcome, progress, session};
use anyhow::{bail, ensure};
use clap::Args;
use keyleaf::Morph;
use keyleaf::headless::Headless;
use keyleaf::key::{MAX_LEVEL, Place};
use keyleaf::layout::MAX_CAPACITY;
use keyleaf_stage::mesh::{Extent, Mesh};
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
        // The surface, not what a view makes of it.
        loaded
            .objects
            .iter_mut()
            .for_each(|object| object.settings.morph = Morph::None);
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
    let extent = match arguments.no_cull || arguments.uniform.is_some() {
        true => Extent::Whole,
        false => Extent::Seen,
    };
    let bar = progress::bar(0, "evaluating", quiet);
    let mesh = Mesh::of(&gpu, &stage, extent, |done, all| {
        bar.set_length(all);
        bar.set_position(done);
    })?;
    bar.finish_and_clear();
    mesh.write(&arguments.output, arguments.normals)?;
    let seconds = start.elapsed().as_secs_f64();
    let (leaves, vertices, triangles) = (mesh.leaves, mesh.positions.len(), mesh.triangles.len());
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
