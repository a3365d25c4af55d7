//! What a scene needs on the GPU: passes, pipelines, WGSL files, buffers and bytes. What it does not name is not here, and not there.

use crate::{Effects, Loaded, LoadedObject, Show, StageLook};
use keyleaf::draw::Sky;
use keyleaf::layout;
use keyleaf::shading::Channel;
use keyleaf::{Quadtree, modules};
use serde::Serialize;

/// One shader module with its pipelines.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct PlannedModule {
    /// Name of the pass.
    pub name: String,
    /// Entry points, each a pipeline.
    pub pipelines: Vec<String>,
    /// WGSL files, dependencies first.
    pub files: Vec<String>,
}

/// One buffer or texture.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct PlannedBuffer {
    /// Its name.
    pub name: String,
    /// Its size.
    pub bytes: u64,
}

/// One surface.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlannedSurface {
    /// Name in the scene.
    pub name: String,
    /// The evaluator.
    pub surface: String,
    /// The metric.
    pub metric: String,
    /// Whether a settled result can depend on what came before.
    pub history_dependent: bool,
    /// What is done with triangles that are seen from behind.
    pub back_faces: String,
    /// Whether something that can be seen may be missing.
    pub approximate: bool,
    /// Where the vertices that a split adds are drawn.
    pub morph: String,
    /// Which leaves are drawn as pairs.
    pub pairs: String,
    /// Faces of the control mesh.
    pub faces: u32,
    /// Roots: the fewest leaves.
    pub roots: u32,
    /// Leaves that the buffers hold.
    pub capacity: u32,
    /// Bytes of the buffers that grow with the capacity, a leaf.
    pub bytes_a_leaf: f64,
    /// Triangles that a leaf is drawn with.
    pub triangles_a_leaf: u32,
    /// The deepest level.
    pub max_level: u32,
    /// Modules of the update, then of the draw.
    pub modules: Vec<PlannedModule>,
    /// Buffers and textures.
    pub buffers: Vec<PlannedBuffer>,
}

/// A scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Plan {
    /// Effects that the scene names.
    pub effects: Vec<String>,
    /// Surfaces.
    pub surfaces: Vec<PlannedSurface>,
    /// Modules that no surface owns.
    pub modules: Vec<PlannedModule>,
    /// Bytes of all buffers and textures of the surfaces.
    pub bytes: u64,
    /// What was noted when the scene was loaded.
    pub notes: Vec<String>,
}

/// Plans a scene seen in a certain way. Needs no device.
///
/// # Errors
/// [`keyleaf_shaders::ComposeError`] if a WGSL file is missing.
pub fn plan(loaded: &Loaded, look: StageLook) -> Result<Plan, keyleaf_shaders::ComposeError> {
    let effects = Effects::of(&loaded.scene, look);
    let surfaces = loaded
        .objects
        .iter()
        .map(|object| surface(object, effects, look.show))
        .collect::<Result<Vec<_>, _>>()?;
    let mut names = Vec::new();
    let mut others = Vec::new();
    if effects.sky {
        names.push("sky".to_owned());
        others.push(module("sky", &["sky"], &Sky::FILES)?);
    }
    let drawn = effects.channel(look.show, Default::default());
    if let Channel::Colour(_, overlay, atmosphere) = drawn {
        names.extend(overlay.names());
        names.extend((atmosphere != Default::default()).then(|| format!("{atmosphere:?}").to_lowercase()));
    }
    let bytes = surfaces.iter().flat_map(|s| &s.buffers).map(|b| b.bytes).sum();
    Ok(Plan {
        effects: names,
        surfaces,
        modules: others,
        bytes,
        notes: loaded.notes.clone(),
    })
}

fn surface(
    object: &LoadedObject,
    effects: Effects,
    show: Show,
) -> Result<PlannedSurface, keyleaf_shaders::ComposeError> {
    let kind = Quadtree::kind(object.surface.as_ref(), &object.settings);
    let mut planned = Vec::new();
    for pass in modules(&kind) {
        planned.push(module(pass.name, pass.entries, &pass.files)?);
    }
    let channel = effects.channel(show, object.material);
    let mut files = channel.files();
    files.extend(kind.drawing_files());
    planned.push(module("draw", &["draw"], &files)?);

    let capacity = object.settings.capacity;
    let mut buffers: Vec<PlannedBuffer> = layout::buffer_bytes(capacity, kind.back_faces, object.settings.pairs)
        .into_iter()
        .map(|(name, bytes)| PlannedBuffer {
            name: name.to_owned(),
            bytes,
        })
        .collect();
    let by_leaf: u64 = buffers.iter().map(|b| b.bytes).sum();
    let mut add = |name: &str, bytes: usize| {
        if bytes > 0 {
            buffers.push(PlannedBuffer {
                name: name.to_owned(),
                bytes: bytes as u64,
            });
        }
    };
    let topology = object.surface.topology();
    let tables = object.surface.tables(glam::DVec3::ZERO);
    add("topology", 4 * topology.gpu_words().len());
    if kind.back_faces.shader().is_some() {
        add("faces", 4 * topology.face_count() as usize);
    }
    add("surface parameters", tables.params.len());
    add("surface A", 4 * tables.a.len());
    add("surface B", 4 * tables.b.len());
    if let Some(pose) = object.surface.pose_tables().filter(|_| kind.pose.is_some()) {
        let words = pose.words.len() + pose.rows.len() + pose.scratch + 4 * pose.cage_entries();
        add("pose", pose.params.len() + 4 * words);
    }
    for (name, data) in [("heights", &tables.heights), ("height bounds", &tables.height_bounds)] {
        add(
            name,
            data.as_ref()
                .map_or(0, |data| data.mips.iter().map(|mip| 4 * mip.len()).sum()),
        );
    }
    if channel.has_attributes() {
        add(
            "attributes",
            size_of::<keyleaf::draw::Attribute>() * object.look.attributes.len().max(1),
        );
    }
    if channel.has_texture() {
        add(
            "base-colour texture",
            object.look.texture.as_ref().map_or(4, |t| t.rgba.len()),
        );
    }
    let frame = <keyleaf::Frame as encase::ShaderType>::min_size().get() as usize;
    add(
        "control, arguments, frame",
        size_of::<layout::Control>() + layout::arguments::SIZE as usize + frame,
    );

    Ok(PlannedSurface {
        name: object.name.clone(),
        surface: kind.surface.to_owned(),
        metric: object.settings.metric.name().to_owned(),
        history_dependent: !object.settings.metric.is_nested(),
        back_faces: object.settings.drawn_faces().name().to_owned(),
        approximate: object.settings.back_faces.is_approximate(),
        morph: object.settings.morph.name().to_owned(),
        pairs: object.settings.pairs.name().to_owned(),
        faces: topology.face_count(),
        roots: topology.half_edge_count(),
        capacity,
        bytes_a_leaf: by_leaf as f64 / f64::from(capacity),
        triangles_a_leaf: 1 << (2 * object.settings.base_grid),
        max_level: object.settings.max_level,
        modules: planned,
        buffers,
    })
}

fn module(name: &str, pipelines: &[&str], files: &[&str]) -> Result<PlannedModule, keyleaf_shaders::ComposeError> {
    Ok(PlannedModule {
        name: name.to_owned(),
        pipelines: pipelines.iter().map(|p| (*p).to_owned()).collect(),
        files: keyleaf_shaders::dependencies(files)?
            .into_iter()
            .map(str::to_owned)
            .collect(),
    })
}
