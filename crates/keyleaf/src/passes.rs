//! The compute pipelines of the update, device-long for one kind of surface, metric and balance.

use crate::KeyleafError;
use crate::binding::{self, Binding};
use crate::module::shader_module;
use crate::settings::{BackFaces, Balance, Morph};
use crate::surface_buffers::surface_layout;
use keyleaf_surface::PoseShader;

use Binding::{Absent, Read, Uniform, Write};

/// What decides which shaders a quadtree needs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Kind {
    /// WGSL file of the surface.
    pub surface: &'static str,
    /// WGSL file of the metric.
    pub metric: &'static str,
    /// How neighbours are kept from cracking.
    pub balance: Balance,
    /// What is done with triangles that are seen from behind.
    pub back_faces: BackFaces,
    /// Where the vertices that a split adds are drawn. The passes are the same with and without.
    pub morph: Morph,
    /// WGSL file of the size of a pair, where pairs may be wished.
    pub pair_metric: Option<&'static str>,
    /// What poses a moving surface.
    pub pose: Option<PoseShader>,
}

impl Kind {
    /// The WGSL files that say where vertices are drawn.
    pub fn drawing_files(&self) -> Vec<&'static str> {
        let mut files = vec![self.morph.shader(), self.surface];
        if self.morph == Morph::Geomorph {
            files.push(self.metric);
            files.extend(match self.pair_metric {
                Some(pair) => vec!["pairs/morph_wished.wgsl", pair],
                None => vec!["pairs/morph_forced.wgsl"],
            });
        }
        files
    }

    /// Refuses to cull the faces of a surface that has no control net.
    ///
    /// # Errors
    /// [`KeyleafError::Setting`].
    pub fn validate(&self) -> Result<(), KeyleafError> {
        let has_net =
            || keyleaf_shaders::dependencies(&[self.surface]).map(|files| files.contains(&"shared/patch.wgsl"));
        if self.back_faces.shader().is_some() && !has_net()? {
            return Err(KeyleafError::Setting {
                setting: "back_faces",
                value: self.back_faces.name().to_owned(),
                expected: "expected drawn, hidden or leaves: only Bézier and NURBS surfaces have control nets to cull by",
            });
        }
        Ok(())
    }
}

/// One module of the update: its name, the WGSL files it is composed of, the bindings of its group 0 and its entry points.
#[derive(Debug, Clone)]
pub struct Module {
    /// Name, as in labels and `plan`.
    pub name: &'static str,
    /// WGSL files, without those that they require.
    pub files: Vec<&'static str>,
    /// What binding i of its group 0 is.
    pub bindings: &'static [Binding],
    /// Whether its group 1 is the surface's.
    pub uses_surface: bool,
    /// Entry points, each a pipeline.
    pub entries: &'static [&'static str],
}

/// The modules of the update for a kind of quadtree. No device is needed: `plan` and the tests of the shaders ask too.
pub fn modules(kind: &Kind) -> Vec<Module> {
    let module = |name, files: &[&'static str], bindings, uses_surface, entries| Module {
        name,
        files: files.to_vec(),
        bindings,
        uses_surface,
        entries,
    };
    const UPDATE: &[Binding] = &[Uniform, Read, Read, Write, Write, Write];
    const UPDATE_CULLED: &[Binding] = &[Uniform, Read, Read, Write, Write, Write, Read, Read];
    const POSE: &[Binding] = &[Uniform, Read, Read, Read, Write, Write, Write];
    const POSE_WITHOUT_BOUNDS: &[Binding] = &[Uniform, Read, Read, Read, Write, Absent, Write];
    const CULL: &[Binding] = &[Uniform, Write];
    const DECIDE: &[Binding] = &[Uniform, Read, Read, Write, Write, Write];
    const APPLY: &[Binding] = &[Uniform, Write, Write, Write, Write, Write];
    const MEASURE: &[Binding] = &[Uniform, Read, Write, Write, Read, Write];
    const COMPACT: &[Binding] = &[Uniform, Write, Write, Write, Write, Write, Write, Write];
    const REBUILD: &[Binding] = &[Uniform, Write, Write, Absent, Absent, Write];
    const COPY: &[Binding] = &[Uniform, Write, Write];
    let (speaker, decide, change): (_, _, &[_]) = match kind.balance {
        Balance::Table => ("shared/balance.wgsl", "passes/decide.wgsl", &["passes/apply.wgsl"]),
        Balance::Off => (
            "shared/balance_off.wgsl",
            "passes/decide_alone.wgsl",
            &["passes/apply_alone.wgsl"],
        ),
    };
    let (facing, update) = match kind.back_faces {
        BackFaces::Drawn | BackFaces::Hidden => ("shared/faces_drawn.wgsl", UPDATE),
        BackFaces::Leaves => ("shared/leaves_culled.wgsl", UPDATE),
        BackFaces::Light | BackFaces::Strong | BackFaces::Conservative => ("shared/faces_culled.wgsl", UPDATE_CULLED),
    };
    let (kept, moved) = if kind.back_faces.has_leaf_cones() {
        ("shared/cone_measured.wgsl", "shared/cone_moved.wgsl")
    } else {
        ("shared/cone_none.wgsl", "shared/cone_none.wgsl")
    };
    let (pairs, pairs_kept, pairs_moved) = match kind.pair_metric {
        None => (
            "shared/pairs_forced.wgsl",
            vec!["shared/pair_none.wgsl"],
            "shared/pair_none.wgsl",
        ),
        Some(metric) => (
            "shared/pairs_wished.wgsl",
            vec!["shared/pair_measured.wgsl", metric],
            "shared/pair_moved.wgsl",
        ),
    };
    let measure = [
        &["passes/measure.wgsl", speaker, kept, kind.surface, kind.metric][..],
        &pairs_kept,
    ]
    .concat();
    let mut all = vec![
        module(
            "update",
            &["passes/update.wgsl", speaker, facing, pairs],
            update,
            false,
            &["update", "update_requested"],
        ),
        module("decide", &[decide], DECIDE, true, &["decide_splits", "decide_merges"]),
        module("apply", change, APPLY, true, &["apply"]),
        module("measure", &measure, MEASURE, true, &["measure", "measure_all"]),
        module(
            "compact",
            &["passes/compact.wgsl", moved, pairs_moved],
            COMPACT,
            false,
            &["match_slots", "move_leaves"],
        ),
        module(
            "copy",
            &["passes/copy.wgsl"],
            COPY,
            false,
            &["copy_changes", "copy_leaves", "copy_counts"],
        ),
    ];
    if let Some(culling) = kind.back_faces.shader() {
        let files = &["passes/cull_faces.wgsl", culling, kind.surface];
        all.push(module("cull", files, CULL, true, &["cull_faces"]));
    }
    if let Some(pose) = kind.pose {
        let bindings = if pose.finds_bounds { POSE } else { POSE_WITHOUT_BOUNDS };
        all.push(module("pose", pose.files, bindings, false, pose.entries));
    }
    if kind.balance == Balance::Table {
        all.push(module(
            "flag",
            &["passes/flag.wgsl"],
            DECIDE,
            true,
            &["flag", "flag_all"],
        ));
        all.push(module(
            "rebuild",
            &["passes/rebuild.wgsl"],
            REBUILD,
            false,
            &["clear_table", "enter_leaves"],
        ));
    }
    all
}

/// The pipelines of one module, with the layout of its group 0.
#[derive(Debug)]
pub(crate) struct Stage {
    pub layout: wgpu::BindGroupLayout,
    pub pipelines: Vec<wgpu::ComputePipeline>,
    pub uses_surface: bool,
}

/// All pipelines of the update, for one kind.
#[derive(Debug)]
pub struct Passes {
    pub(crate) surface_layout: wgpu::BindGroupLayout,
    pub(crate) kind: Kind,
    stages: Vec<(&'static str, Stage)>,
}

impl Passes {
    /// Compiles the pipelines. Takes some tens of milliseconds a module; do it once a kind and share.
    ///
    /// # Errors
    /// [`KeyleafError::Compose`] if a shader file is missing, [`KeyleafError::Setting`] if the surface has no patches to cull.
    pub fn new(device: &wgpu::Device, kind: Kind) -> Result<Self, KeyleafError> {
        kind.validate()?;
        let surface_layout = surface_layout(device, kind.surface)?;
        let mut stages = Vec::new();
        for module in modules(&kind) {
            stages.push((module.name, stage(device, &module, &surface_layout)?));
        }
        Ok(Self {
            surface_layout,
            kind,
            stages,
        })
    }

    /// What they are compiled for.
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// The stage of a module that the kind has; `None` for one that it lacks.
    pub(crate) fn stage(&self, name: &str) -> Option<&Stage> {
        self.stages.iter().find(|(n, _)| *n == name).map(|(_, stage)| stage)
    }
}

fn stage(device: &wgpu::Device, module: &Module, surface: &wgpu::BindGroupLayout) -> Result<Stage, KeyleafError> {
    let label = format!("keyleaf.{}", module.name);
    let shader = shader_module(device, &module.files)?;
    let layout = binding::layout(device, &label, wgpu::ShaderStages::COMPUTE, module.bindings);
    let groups = if module.uses_surface {
        vec![Some(&layout), Some(surface)]
    } else {
        vec![Some(&layout)]
    };
    let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(&label),
        bind_group_layouts: &groups,
        immediate_size: 0,
    });
    let pipelines = module
        .entries
        .iter()
        .map(|entry| {
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(&format!("keyleaf.{entry}")),
                layout: Some(&pipeline_layout),
                module: &shader,
                entry_point: Some(entry),
                compilation_options: wgpu::PipelineCompilationOptions {
                    zero_initialize_workgroup_memory: false, // every pass that has any sets it itself
                    ..Default::default()
                },
                cache: None,
            })
        })
        .collect();
    Ok(Stage {
        layout,
        pipelines,
        uses_surface: module.uses_surface,
    })
}
