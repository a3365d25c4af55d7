//! `keyleaf info`: the adapter that is used.

use crate::Outcome;
use crate::output;
use crate::session::{self, DeviceReport};
use clap::Args;
use keyleaf::wgpu;
use serde_json::json;

/// Print the adapter that is used, with its driver, features and limits
#[derive(Args)]
#[command(after_help = "Example: keyleaf info --json\n
Environment: WGPU_BACKEND (vulkan, gl), WGPU_ADAPTER_NAME (part of a name) choose another adapter.")]
pub struct Arguments {
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> anyhow::Result<Outcome> {
    let gpu = session::device()?;
    let info = gpu.adapter.get_info();
    let report = DeviceReport::new(&gpu);
    let names =
        |features: wgpu::Features| -> Vec<String> { features.iter_names().map(|(name, _)| name.to_owned()).collect() };
    let (used, offered) = (names(gpu.device.features()), names(gpu.adapter.features()));
    let limits = gpu.device.limits();
    let limits = [
        ("buffer bytes", limits.max_buffer_size),
        ("bytes a storage binding", limits.max_storage_buffer_binding_size),
        (
            "storage buffers a stage",
            limits.max_storage_buffers_per_shader_stage.into(),
        ),
        ("texture side", limits.max_texture_dimension_2d.into()),
        (
            "work groups a dimension",
            limits.max_compute_workgroups_per_dimension.into(),
        ),
    ];
    if arguments.json {
        let limits: serde_json::Map<_, _> = limits
            .iter()
            .map(|(name, value)| (name.replace(' ', "_"), json!(value)))
            .collect();
        output::print_json(&json!({
            "device": report.device, "driver": report.driver, "backend": report.backend,
            "type": format!("{:?}", info.device_type), "software": report.software, "times": report.times,
            "version": env!("CARGO_PKG_VERSION"), "features_used": used, "features_offered": offered, "limits": limits,
        }))?;
    } else {
        let list = |names: &[String]| {
            if names.is_empty() {
                "none".to_owned()
            } else {
                names.join(", ")
            }
        };
        let mut lines = vec![
            format!("adapter   {} ({:?})", report.device, info.device_type),
            format!("driver    {}", report.driver),
            format!("backend   {}", report.backend),
            format!(
                "software  {}",
                if report.software {
                    "yes: its times are not GPU times"
                } else {
                    "no"
                }
            ),
            format!("features  {} (of {} offered)", list(&used), offered.len()),
        ];
        lines.extend(
            limits
                .iter()
                .map(|(name, value)| format!("limit     {name}: {}", output::thousands(*value))),
        );
        output::print(&lines.join("\n"))?;
    }
    Ok(Outcome::Done)
}
