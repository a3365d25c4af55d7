//! The quadtrees of a scene with what draws them.

use crate::{LoadError, Loaded};
use glam::{DVec3, Vec3};
use keyleaf::draw::{ColourTexture, LeafDraw, LeafPipeline, Look, Sky, Target};
use keyleaf::headless::Headless;
use keyleaf::shading::{Atmosphere, Channel, Material, Overlay, Shading};
use keyleaf::{KeyleafError, Kind, Passes, Phase, Quadtree, Statistics, View};
use keyleaf_key::Topology;
use keyleaf_scene::scene::Effect;
use keyleaf_scene::{ControlCage, PoseError};
use keyleaf_surface::CornerAttributes;
use std::collections::HashMap;
use std::sync::Arc;

/// What a picture shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Show {
    /// The lit surface.
    #[default]
    Colour,
    /// World normals as colours.
    Normal,
    /// Levels as colours.
    Level,
    /// World positions relative to the eye, as floats.
    Position,
}

/// What a stage draws besides what the scene says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct StageLook {
    /// The channel.
    pub show: Show,
    /// Edges of the triangles over the surface.
    pub wireframe: bool,
    /// Levels as a tint.
    pub level_tint: bool,
}

/// The effects that a scene and a look name: these are composed into the shaders, and no others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Effects {
    /// Whether the sky is drawn.
    pub sky: bool,
    /// Air.
    pub atmosphere: Atmosphere,
    /// Over the surface.
    pub overlay: Overlay,
}

impl Effects {
    /// The effects of a scene seen in a certain way.
    pub fn of(scene: &keyleaf_scene::Scene, look: StageLook) -> Self {
        let has = |wanted: fn(&Effect) -> bool| scene.effects.iter().any(wanted);
        let colour = look.show == Show::Colour;
        Self {
            sky: colour && has(|e| matches!(e, Effect::Sky)),
            atmosphere: if has(|e| matches!(e, Effect::Fog(_))) {
                Atmosphere::Haze
            } else {
                Atmosphere::None
            },
            overlay: Overlay::of(
                look.level_tint || has(|e| matches!(e, Effect::LevelTint)),
                look.wireframe || has(|e| matches!(e, Effect::Wireframe)),
            ),
        }
    }

    /// The channel that draws a material.
    pub fn channel(&self, show: Show, material: Material) -> Channel {
        match show {
            Show::Colour => Channel::Colour(material, self.overlay, self.atmosphere),
            Show::Normal => Channel::Normal,
            Show::Level => Channel::Level,
            Show::Position => Channel::Position,
        }
    }
}

/// One surface on the GPU.
pub struct StageObject {
    /// Its name in the scene.
    pub name: String,
    /// Its quadtree.
    pub quadtree: Quadtree,
    pipeline: Arc<LeafPipeline>,
    draw: LeafDraw,
    shading: Shading,
    /// The control mesh, if it moves.
    cage: Option<Arc<ControlCage>>,
}

/// The pipelines that were compiled so far, for one target. Scenes that follow each other on a device can share them.
#[derive(Default)]
pub struct Pipelines {
    passes: HashMap<Kind, Arc<Passes>>,
    draws: HashMap<(Kind, Channel), Arc<LeafPipeline>>,
}

impl Pipelines {
    /// The passes of the update for a kind of quadtree.
    ///
    /// # Errors
    /// [`KeyleafError`] if the kind is impossible.
    pub fn passes(&mut self, device: &wgpu::Device, kind: Kind) -> Result<Arc<Passes>, KeyleafError> {
        if let Some(passes) = self.passes.get(&kind) {
            return Ok(Arc::clone(passes));
        }
        let passes = Arc::new(Passes::new(device, kind)?);
        self.passes.insert(kind, Arc::clone(&passes));
        Ok(passes)
    }

    fn draw(
        &mut self,
        device: &wgpu::Device,
        kind: Kind,
        channel: Channel,
        target: Target,
    ) -> Result<Arc<LeafPipeline>, KeyleafError> {
        if let Some(pipeline) = self.draws.get(&(kind, channel)) {
            return Ok(Arc::clone(pipeline));
        }
        let pipeline = Arc::new(LeafPipeline::new(device, &kind, channel, target)?);
        self.draws.insert((kind, channel), Arc::clone(&pipeline));
        Ok(pipeline)
    }
}

/// A scene on the GPU, for one kind of picture.
pub struct Stage {
    /// The surfaces, in the order of the scene.
    pub objects: Vec<StageObject>,
    device: wgpu::Device,
    queue: wgpu::Queue,
    sky: Option<Sky>,
    light: Shading,
    effects: Effects,
    show: Show,
    target: Target,
}

impl Stage {
    /// Compiles what the scene names, and fills the buffers of its surfaces.
    ///
    /// # Errors
    /// [`KeyleafError`]: settings out of range, or more than the device holds.
    pub fn new(gpu: &Headless, loaded: &Loaded, look: StageLook, target: Target) -> Result<Self, KeyleafError> {
        Self::with_pipelines(gpu, loaded, look, target, &mut Pipelines::default())
    }

    /// The same with pipelines that are there already. All must be for one target.
    ///
    /// # Errors
    /// As [`Stage::new`].
    pub fn with_pipelines(
        gpu: &Headless,
        loaded: &Loaded,
        look: StageLook,
        target: Target,
        pipelines: &mut Pipelines,
    ) -> Result<Self, KeyleafError> {
        let (device, queue) = (&gpu.device, &gpu.queue);
        let effects = Effects::of(&loaded.scene, look);
        let light = loaded.shading();
        let mut objects = Vec::new();
        for object in &loaded.objects {
            let kind = Quadtree::kind(object.surface.as_ref(), &object.settings);
            let channel = effects.channel(look.show, object.material);
            let passes = pipelines.passes(device, kind)?;
            let pipeline = pipelines.draw(device, kind, channel, target)?;
            let quadtree = Quadtree::new(
                device,
                queue,
                passes,
                Arc::clone(&object.surface),
                object.world_from_object,
                object.settings,
            )?;
            let draw = LeafDraw::new(device, queue, &pipeline, &quadtree, &object.look);
            objects.push(StageObject {
                name: object.name.clone(),
                quadtree,
                pipeline,
                draw,
                shading: object.shading(light),
                cage: object.cage.clone().filter(|cage| cage.motion.is_some()),
            });
        }
        let sky = if effects.sky {
            Some(Sky::new(device, target)?)
        } else {
            None
        };
        Ok(Self {
            objects,
            device: device.clone(),
            queue: queue.clone(),
            sky,
            light,
            effects,
            show: look.show,
            target,
        })
    }

    /// What the pipelines render to.
    pub fn target(&self) -> Target {
        self.target
    }

    /// The effects that were composed.
    pub fn effects(&self) -> Effects {
        self.effects
    }

    /// The channel.
    pub fn show(&self) -> Show {
        self.show
    }

    /// Puts moving surfaces where they are at a time in seconds; the next update follows. Subdivision surfaces are posed on the GPU, the
    /// others have their tables made anew.
    ///
    /// # Errors
    /// [`LoadError::Pose`] if the pose of one has no surface.
    pub fn set_time(&mut self, time: f64) -> Result<(), LoadError> {
        for object in &mut self.objects {
            let Some(cage) = &object.cage else { continue };
            let no_pose = |reason: String| LoadError::Pose {
                name: object.name.clone(),
                source: PoseError { time, reason },
            };
            let posed = if object.quadtree.is_posed_on_gpu() {
                object.quadtree.set_cage(cage.pose(time))
            } else {
                let surface = cage.surface_at(time).map_err(|error| no_pose(error.reason))?;
                object.quadtree.set_surface(&self.queue, surface)
            };
            posed.map_err(|error| no_pose(error.to_string()))?;
        }
        Ok(())
    }

    /// Records the passes that refine every surface for a view.
    pub fn update(&mut self, encoder: &mut wgpu::CommandEncoder, view: &View) {
        for object in &mut self.objects {
            object.quadtree.update(&self.queue, encoder, view);
        }
    }

    /// The same with every phase in a compute pass of its own; `timestamps(i, phase)` are written around those of surface i.
    pub fn update_timed<'a>(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        view: &View,
        mut timestamps: impl FnMut(usize, Phase) -> Option<wgpu::ComputePassTimestampWrites<'a>>,
    ) {
        for (i, object) in self.objects.iter_mut().enumerate() {
            object
                .quadtree
                .update_timed(&self.queue, encoder, view, |phase| timestamps(i, phase));
        }
    }

    /// Records the draws of a view, the sky last.
    pub fn draw(&mut self, pass: &mut wgpu::RenderPass<'_>, view: &View) {
        let eye = view.eye.as_vec3();
        for object in &mut self.objects {
            let shading = Shading { eye, ..object.shading };
            object
                .draw
                .prepare(&self.device, &self.queue, &object.quadtree, &shading);
            object.draw.draw(pass, &object.pipeline, &object.quadtree);
        }
        if let Some(sky) = &self.sky {
            sky.prepare(&self.queue, view, &Shading { eye, ..self.light });
            sky.draw(pass);
        }
    }

    /// Figures of all surfaces together; `None` until those of each have arrived.
    pub fn statistics(&mut self) -> Option<Statistics> {
        let all: Option<Vec<_>> = self.objects.iter_mut().map(|o| o.quadtree.statistics()).collect();
        all?.into_iter().reduce(|a, b| Statistics {
            leaves: a.leaves + b.leaves,
            visible: a.visible + b.visible,
            triangles: a.triangles + b.triangles,
            splits: a.splits + b.splits,
            merges: a.merges + b.merges,
            unmet: a.unmet + b.unmet,
            starved: a.starved + b.starved,
            capacity: a.capacity + b.capacity,
            threshold_factor: a.threshold_factor.max(b.threshold_factor),
            passes: a.passes.max(b.passes),
            rebuilds: a.rebuilds + b.rebuilds,
            table_load: a.table_load.max(b.table_load),
            lost: a.lost + b.lost,
        })
    }

    /// (surface, buffer, bytes) of everything that the stage holds on the GPU.
    pub fn memory(&self) -> Vec<(String, &'static str, u64)> {
        let mut all = Vec::new();
        for object in &self.objects {
            all.extend(
                object
                    .quadtree
                    .memory()
                    .into_iter()
                    .map(|(name, bytes)| (object.name.clone(), name, bytes)),
            );
            all.push((object.name.clone(), "look", object.draw.bytes()));
        }
        all
    }
}

/// What the corners of a mesh and its picture add to a surface. Corners go with the half-edges of the topology.
pub(crate) fn look_of(topology: &Topology, corners: Option<&CornerAttributes>, texture: Option<ColourTexture>) -> Look {
    let Some(corners) = corners else { return Look::default() };
    let counts: Vec<u32> = (0..topology.face_count())
        .map(|face| topology.corner_count(face))
        .collect();
    // Files have v = 0 at the bottom of the picture, the GPU at the top.
    let uvs: Option<Vec<[f32; 2]>> = corners
        .uvs
        .as_ref()
        .map(|all| all.iter().map(|[u, v]| [*u, 1.0 - v]).collect());
    let attributes = keyleaf::draw::attributes(
        &counts,
        uvs.as_deref(),
        corners.normals.as_deref(),
        corners.colours.as_deref(),
    );
    Look { attributes, texture }
}

/// The world box of a box in object space.
pub(crate) fn world_box(bounds: (DVec3, DVec3), world_from_object: &glam::DAffine3) -> (DVec3, DVec3) {
    let (mut least, mut most) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for corner in 0..8 {
        let pick = |bit: u32, a: f64, b: f64| if corner & bit == 0 { a } else { b };
        let p = DVec3::new(
            pick(1, bounds.0.x, bounds.1.x),
            pick(2, bounds.0.y, bounds.1.y),
            pick(4, bounds.0.z, bounds.1.z),
        );
        let p = world_from_object.transform_point3(p);
        least = least.min(p);
        most = most.max(p);
    }
    (least, most)
}

/// A linear colour as a vector.
pub(crate) fn colour(c: [f32; 3]) -> Vec3 {
    Vec3::from_array(c)
}
