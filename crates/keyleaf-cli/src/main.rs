//! The program `keyleaf`: terrain, meshes and curved surfaces, refined on the GPU every frame.
//!
//! One command a file; `arguments` has what several of them take, `session` the way from a scene to a stage on a device.
//!
//! Exit codes: 0, or 1 if what was checked failed, or 2 for bad use and bad input, with one message on stderr. A file is written
//! whole or not at all.

mod accuracy;
mod arguments;
mod bench;
mod check;
mod compare;
mod csv;
mod difference;
mod eval;
mod export;
mod info;
mod output;
mod plan;
mod progress;
mod record;
mod render;
mod session;
mod timing;
mod variant;
mod view;

use clap::{Parser, Subcommand};
use std::process::ExitCode;
use std::time::Instant;

/// Terrain, meshes and curved surfaces, refined on the GPU every frame.
///
/// SCENE is a scene file (.ron), or a model (.obj, .gltf, .glb, .ply, .stl) or height map (.png, .tif, .exr, .r16) directly.
///
/// Exit codes: 0; 1 if what was checked failed; 2 for bad use or bad input.
#[derive(Parser)]
#[command(name = "keyleaf", version, arg_required_else_help = true, max_term_width = 100)]
#[command(after_help = "Example: keyleaf render scenes/terrain_real.ron -o terrain.png")]
struct Program {
    #[command(subcommand)]
    command: Command,
    /// Print no notes and no progress, only results and errors
    #[arg(long, short, global = true, display_order = 900)]
    quiet: bool,
}

#[derive(Subcommand)]
enum Command {
    View(view::Arguments),
    Render(render::Arguments),
    Export(export::Arguments),
    Eval(eval::Arguments),
    Check(check::Arguments),
    Bench(bench::Arguments),
    Compare(compare::Arguments),
    Accuracy(accuracy::Arguments),
    Plan(plan::Arguments),
    Info(info::Arguments),
}

/// How a command ended that was not stopped by an error.
enum Outcome {
    /// All is well.
    Done,
    /// What was checked failed.
    Failed,
}

fn main() -> ExitCode {
    let started = Instant::now();
    let Program { command, quiet } = Program::parse();
    let outcome = match command {
        Command::View(arguments) => view::run(&arguments, started),
        Command::Render(arguments) => render::run(&arguments, quiet),
        Command::Export(arguments) => export::run(&arguments, quiet),
        Command::Eval(arguments) => eval::run(&arguments, quiet),
        Command::Check(arguments) => check::run(&arguments, quiet),
        Command::Bench(arguments) => bench::run(&arguments, quiet),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Accuracy(arguments) => accuracy::run(&arguments, quiet),
        Command::Plan(arguments) => plan::run(&arguments, quiet),
        Command::Info(arguments) => info::run(&arguments),
    };
    match outcome {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::Failed) => ExitCode::from(1),
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::from(2)
        }
    }
}
