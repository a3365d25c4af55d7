//! `keyleaf plan`: what a scene needs on the GPU.

use crate::Outcome;
use crate::arguments::SceneArguments;
use crate::output::{self, thousands};
use crate::render::{Channel, OverlayArguments};
use clap::Args;
use keyleaf_report::table;
use keyleaf_stage::plan::{Plan, PlannedModule, PlannedSurface, plan};

/// Print what a scene needs: passes, pipelines, shader files, buffers and their bytes, effects
///
/// Needs no graphics device. What a scene does not name is not in its plan, and not on the GPU.
#[derive(Args)]
#[command(after_help = "Example: keyleaf plan scenes/terrain_real.ron --json")]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// What pictures show
    #[arg(long, value_enum, default_value = "color", value_name = "CHANNEL")]
    channel: Channel,
    #[command(flatten)]
    overlay: OverlayArguments,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub fn run(arguments: &Arguments, quiet: bool) -> anyhow::Result<Outcome> {
    let loaded = arguments.scene.load(quiet)?;
    let plan = plan(&loaded, arguments.channel.look(arguments.overlay))?;
    if arguments.json {
        output::print_json(&plan)?;
    } else {
        output::print(&text(&plan))?;
    }
    Ok(Outcome::Done)
}

fn text(plan: &Plan) -> String {
    let effects = if plan.effects.is_empty() {
        "none".to_owned()
    } else {
        plan.effects.join(", ")
    };
    let mut parts: Vec<String> = plan.surfaces.iter().map(surface).collect();
    if !plan.modules.is_empty() {
        parts.push(format!("for all surfaces\n{}", modules(&plan.modules)));
    }
    parts.push(format!(
        "effects: {effects}\nall buffers and textures: {} bytes",
        thousands(plan.bytes)
    ));
    parts.join("\n\n")
}

fn surface(surface: &PlannedSurface) -> String {
    let buffers: Vec<Vec<String>> = surface
        .buffers
        .iter()
        .map(|b| vec![b.name.clone(), thousands(b.bytes)])
        .collect();
    let history = if surface.history_dependent {
        ", history-dependent"
    } else {
        ""
    };
    let back_faces = match (surface.back_faces.as_str(), surface.approximate) {
        ("drawn", _) => String::new(),
        (name, false) => format!(", back faces {name}"),
        (name, true) => format!(", back faces {name} (approximate: visible parts may be missing)"),
    };
    let morph = match surface.morph.as_str() {
        "none" => String::new(),
        name => format!(", {name}"),
    };
    let pairs = if surface.pairs == "forced" {
        ""
    } else {
        ", pairs as wished"
    };
    format!(
        "surface {}: {}, metric {}{history}{pairs}{morph}{back_faces}\n{} faces, {} roots, {} leaves at most ({:.1} bytes a leaf), level {} at most, {} \
         triangles a leaf\n\n{}\n\n{}",
        surface.name,
        surface.surface,
        surface.metric,
        thousands(surface.faces.into()),
        thousands(surface.roots.into()),
        thousands(surface.capacity.into()),
        surface.bytes_a_leaf,
        surface.max_level,
        surface.triangles_a_leaf,
        modules(&surface.modules),
        table::format(&["buffer", "bytes"], &buffers),
    )
}

fn modules(modules: &[PlannedModule]) -> String {
    let rows: Vec<Vec<String>> = modules
        .iter()
        .map(|m| vec![m.name.clone(), m.pipelines.join(", "), m.files.join(", ")])
        .collect();
    table::format(&["pass", "pipelines", "shader files"], &rows)
}
