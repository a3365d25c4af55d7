//! The quadtrees of a scene with what draws them.

use crate::{LoadError, Loaded, LoadedObject, Pipelines};
use glam::{DVec3, Vec3};
use keyleaf::draw::{ColourTexture, LeafDraw, LeafPipeline, Look, Sky, Target};
use keyleaf::headless::Headless;
use keyleaf::map::{LeafMap, MapPipeline};
use keyleaf::shading::{Atmosphere, Channel, Material, Overlay, Shading, Tint};
use keyleaf::{KeyleafError, Phase, Quadtree, Statistics, View};
use keyleaf_key::Topology;
use keyleaf_scene::scene::Effect;
use keyleaf_scene::{ControlCage, PoseError};
use keyleaf_surface::CornerAttributes;
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
    /// Distance of the drawn triangles from the surface in pixels, as floats.
    Error,
    /// How often each pixel is drawn.
    Overdraw,
}

/// What a stage draws besides what the scene says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct StageLook {
    /// The channel.
    pub show: Show,
    /// Edges of the triangles over the surface.
    pub wireframe: bool,
    /// What the surface is tinted by; none: what the scene says.
    pub tint: Tint,
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
            overlay: Overlay {
                tint: match look.tint {
                    Tint::None if has(|e| matches!(e, Effect::LevelTint)) => Tint::Level,
                    tint => tint,
                },
                wireframe: look.wireframe || has(|e| matches!(e, Effect::Wireframe)),
            },
        }
    }

    /// The channel that draws a material.
    pub fn channel(&self, show: Show, material: Material) -> Channel {
        match show {
            Show::Colour => Channel::Colour(material, self.overlay, self.atmosphere),
            Show::Normal => Channel::Normal,
            Show::Level => Channel::Level,
            Show::Position => Channel::Position,
            Show::Error => Channel::Error,
            Show::Overdraw => Channel::Overdraw,
        }
    }
}

/// One surface on the GPU.
pub struct StageObject {
    /// Its name in the scene.
    pub name: String,
    /// Its quadtree.
    pub quadtree: Quadtree,
    drawn: Drawing,
    map: Option<(Arc<MapPipeline>, LeafMap)>,
    /// The control mesh, if it moves.
    cage: Option<Arc<ControlCage>>,
}

/// What draws a quadtree.
struct Drawing {
    pipeline: Arc<LeafPipeline>,
    draw: LeafDraw,
    shading: Shading,
}

/// A scene on the GPU, for one kind of picture.
pub struct Stage {
    /// The surfaces, in the order of the scene.
    pub objects: Vec<StageObject>,
    gpu: Headless,
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

    /// The same with pipelines that are there already.
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
        let mut stage = Self {
            objects: Vec::new(),
            gpu: gpu.clone(),
            sky: None,
            light: loaded.shading(),
            effects: Effects::of(&loaded.scene, look),
            show: look.show,
            target,
        };
        for object in &loaded.objects {
            let made = stage.object(object, pipelines)?;
            stage.objects.push(made);
        }
        stage.set_sky()?;
        Ok(stage)
    }

    /// Shows the same leaves in another way: another look, other light or effects of the scene. The quadtrees stay as they are.
    ///
    /// # Errors
    /// As [`Stage::new`]; the stage is then as before.
    pub fn set_look(
        &mut self,
        loaded: &Loaded,
        look: StageLook,
        pipelines: &mut Pipelines,
    ) -> Result<(), KeyleafError> {
        let before = (self.effects, self.show, self.light);
        self.effects = Effects::of(&loaded.scene, look);
        self.show = look.show;
        self.light = loaded.shading();
        let all = self.objects.iter().zip(&loaded.objects);
        let drawn: Result<Vec<Drawing>, _> = all.map(|(o, l)| self.drawn(l, &o.quadtree, pipelines)).collect();
        match drawn {
            Ok(drawn) => {
                for (object, drawn) in self.objects.iter_mut().zip(drawn) {
                    object.drawn = drawn;
                }
                self.set_sky()
            }
            Err(error) => {
                (self.effects, self.show, self.light) = before;
                Err(error)
            }
        }
    }

    /// Takes over the settings of all surfaces. Where one needs other buffers or pipelines, all quadtrees begin again at their roots;
    /// whether they did.
    ///
    /// # Errors
    /// As [`Stage::new`]; the stage is then as before, unless a setting is out of range.
    pub fn set_settings(&mut self, loaded: &Loaded, pipelines: &mut Pipelines) -> Result<bool, KeyleafError> {
        let keeps_buffers = self.objects.iter().zip(&loaded.objects).all(|(object, wanted)| {
            let (now, wanted) = (object.quadtree.settings(), &wanted.settings);
            now.capacity == wanted.capacity
                && now.metric.shader() == wanted.metric.shader()
                && now.balance == wanted.balance
                && now.drawn_faces() == wanted.drawn_faces()
                && now.pairs == wanted.pairs
                && now.moving == wanted.moving
        });
        if !keeps_buffers {
            let made: Result<Vec<_>, _> = loaded.objects.iter().map(|o| self.object(o, pipelines)).collect();
            self.objects = made?;
            return Ok(true);
        }
        for i in 0..self.objects.len() {
            let (object, wanted) = (&mut self.objects[i], &loaded.objects[i]);
            let morph = object.quadtree.settings().morph;
            object.quadtree.set_settings(wanted.settings)?;
            if wanted.settings.morph != morph {
                self.objects[i].drawn = self.drawn(wanted, &self.objects[i].quadtree, pipelines)?;
            }
        }
        Ok(false)
    }

    fn object(&self, object: &LoadedObject, pipelines: &mut Pipelines) -> Result<StageObject, KeyleafError> {
        let kind = Quadtree::kind(object.surface.as_ref(), &object.settings);
        let passes = pipelines.passes(&self.gpu.device, kind)?;
        let quadtree = Quadtree::new(
            &self.gpu.device,
            &self.gpu.queue,
            passes,
            Arc::clone(&object.surface),
            object.world_from_object,
            object.settings,
        )?;
        Ok(StageObject {
            name: object.name.clone(),
            drawn: self.drawn(object, &quadtree, pipelines)?,
            quadtree,
            map: None,
            cage: object.cage.clone().filter(|cage| cage.motion.is_some()),
        })
    }

    fn drawn(
        &self,
        object: &LoadedObject,
        quadtree: &Quadtree,
        pipelines: &mut Pipelines,
    ) -> Result<Drawing, KeyleafError> {
        let kind = Quadtree::kind(object.surface.as_ref(), &object.settings);
        let channel = self.effects.channel(self.show, object.material);
        let pipeline = pipelines.draw(&self.gpu.device, kind, channel, self.target)?;
        Ok(Drawing {
            draw: LeafDraw::new(&self.gpu.device, &self.gpu.queue, &pipeline, quadtree, &object.look),
            pipeline,
            shading: object.shading(self.light),
        })
    }

    fn set_sky(&mut self) -> Result<(), KeyleafError> {
        if self.effects.sky != self.sky.is_some() {
            self.sky = match self.effects.sky {
                true => Some(Sky::new(&self.gpu.device, self.target)?),
                false => None,
            };
        }
        Ok(())
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

    /// Puts moving surfaces where they are at a time in seconds; the next update follows. They are posed on the GPU; QAS of Loop surfaces
    /// with creases have their tables made anew.
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
                match cage.pose_covariances(time) {
                    Some(covariances) => object.quadtree.set_covariance_cage(cage.pose(time), &covariances),
                    None => object.quadtree.set_cage(cage.pose(time)),
                }
            } else {
                let surface = cage.surface_at(time).map_err(|error| no_pose(error.reason))?;
                object.quadtree.set_surface(&self.gpu.queue, surface)
            };
            posed.map_err(|error| no_pose(error.to_string()))?;
        }
        Ok(())
    }

    /// Records the passes that refine every surface for a view.
    pub fn update(&mut self, encoder: &mut wgpu::CommandEncoder, view: &View) {
        for object in &mut self.objects {
            object.quadtree.update(&self.gpu.queue, encoder, view);
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
                .update_timed(&self.gpu.queue, encoder, view, |phase| timestamps(i, phase));
        }
    }

    /// Lets the next draws see the leaves from `view`, without refining them for it: a frozen quadtree.
    pub fn look_from(&mut self, view: &View) {
        for object in &mut self.objects {
            object.quadtree.look_from(&self.gpu.queue, view);
        }
    }

    /// Records the draws of a view, the sky last.
    pub fn draw(&mut self, pass: &mut wgpu::RenderPass<'_>, view: &View) {
        let of_view = |shading: Shading| Shading {
            eye: view.eye.as_vec3(),
            pixels_per_unit: view.pixels_per_unit() as f32,
            ..shading
        };
        for StageObject { quadtree, drawn, .. } in &mut self.objects {
            let shading = of_view(drawn.shading);
            let (device, queue) = (&self.gpu.device, &self.gpu.queue);
            drawn.draw.prepare(device, queue, quadtree, &shading);
            drawn.draw.draw(pass, &drawn.pipeline, quadtree);
        }
        if let Some(sky) = &self.sky {
            sky.prepare(&self.gpu.queue, view, &of_view(self.light));
            sky.draw(pass);
        }
    }

    /// Makes what [`draw_map`](Self::draw_map) needs, where it is not there yet, and writes the view of the map.
    ///
    /// # Errors
    /// [`KeyleafError`] if the pipelines cannot be made.
    pub fn prepare_map(&mut self, view: &View, pipelines: &mut Pipelines, target: Target) -> Result<(), KeyleafError> {
        let gpu = &self.gpu;
        for object in &mut self.objects {
            let map = match &mut object.map {
                Some(map) => map,
                none => {
                    let pipeline = pipelines.map(&gpu.device, object.quadtree.passes().kind(), target)?;
                    let map = LeafMap::new(&gpu.device, &pipeline, &object.quadtree);
                    none.insert((pipeline, map))
                }
            };
            map.1.prepare(&gpu.queue, &object.quadtree, view);
        }
        Ok(())
    }

    /// Records a map: all leaves of all surfaces, coloured by level.
    pub fn draw_map(&mut self, pass: &mut wgpu::RenderPass<'_>) {
        for object in &mut self.objects {
            let leaves = object.quadtree.statistics().map_or(0, |s| s.leaves);
            if let Some((pipeline, map)) = &object.map {
                map.draw(pass, pipeline, &object.quadtree, leaves);
            }
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
            all.push((object.name.clone(), "look", object.drawn.draw.bytes()));
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
