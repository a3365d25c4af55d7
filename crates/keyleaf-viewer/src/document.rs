//! The scene that is open: loaded, on the device, tuned; and how far its quadtrees have settled.

use crate::costs::{Costs, Sample};
use anyhow::{Context, bail};
use keyleaf::headless::Headless;
use keyleaf::shading::Tint;
use keyleaf::{Phase, Statistics, View, wgpu};
use keyleaf_scene::Scene;
use keyleaf_scene::scene::Effect;
use keyleaf_stage::mesh::{Extent, Mesh};
use keyleaf_stage::{Canvas, ErrorProbe, Loaded, Pipelines, Settling, Show, Stage, StageLook, target};
use std::path::Path;
use std::time::Instant;

/// What is drawn on top of what the scene says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Look {
    /// Edges of the triangles.
    pub wireframe: bool,
    /// What the surface is tinted by.
    pub tint: Tint,
    /// How often each pixel is drawn, in place of the picture.
    pub overdraw: bool,
}

impl Look {
    fn of_stage(self) -> StageLook {
        StageLook {
            show: if self.overdraw { Show::Overdraw } else { Show::Colour },
            wireframe: self.wireframe,
            tint: self.tint,
        }
    }
}

/// The scene that is open.
pub struct Document {
    /// What was loaded, with what was tuned since.
    pub loaded: Loaded,
    /// Its quadtrees.
    pub stage: Stage,
    /// What is drawn besides.
    pub look: Look,
    /// The view that the quadtrees are frozen at.
    pub frozen: Option<View>,
    /// Measures the error of what is drawn, where somebody looks.
    pub probe: Option<ErrorProbe>,
    /// The scene as it was opened.
    pub original: Scene,
    /// Of the pose of moving surfaces, in seconds.
    time: f64,
    settling: Settling,
    /// Passes recorded since the quadtrees were made.
    passes: u32,
    /// What was last drawn, and refined for.
    drawn: Option<(View, Look)>,
    refined: Option<View>,
    statistics: Option<Statistics>,
}

impl Document {
    /// Puts a scene on the device.
    ///
    /// # Errors
    /// What the device, or its shader compiler, refuses.
    pub fn new(gpu: &Headless, loaded: Loaded, pipelines: &mut Pipelines) -> anyhow::Result<Self> {
        let mut loaded = loaded;
        // From here on these are the viewer's switches.
        let has = |effect| loaded.scene.effects.contains(&effect);
        let look = Look {
            wireframe: has(Effect::Wireframe),
            tint: if has(Effect::LevelTint) {
                Tint::Level
            } else {
                Tint::None
            },
            overdraw: false,
        };
        let original = loaded.scene.clone();
        loaded
            .scene
            .effects
            .retain(|effect| !matches!(effect, Effect::Wireframe | Effect::LevelTint));
        let stage = checked(gpu, || {
            Ok(Stage::with_pipelines(
                gpu,
                &loaded,
                look.of_stage(),
                target(Show::Colour),
                pipelines,
            )?)
        })?;
        Ok(Self {
            loaded,
            stage,
            look,
            frozen: None,
            time: 0.0,
            probe: None,
            original,
            settling: Settling::default(),
            passes: 0,
            drawn: None,
            refined: None,
            statistics: None,
        })
    }

    /// The name of the file, for titles.
    pub fn name(&self) -> String {
        let file = &self.loaded.file;
        file.file_name()
            .unwrap_or(file.as_os_str())
            .to_string_lossy()
            .into_owned()
    }

    /// Figures of the latest frame that has arrived.
    pub fn statistics(&self) -> Option<Statistics> {
        self.statistics
    }

    /// Whether what is on the screen is final for this view.
    pub fn is_settled(&self) -> bool {
        self.frozen.is_some() || (self.settling.is_settled() && self.refined.is_some())
    }

    /// Shows the surfaces in another way.
    ///
    /// # Errors
    /// What the device, or its shader compiler, refuses; the look is then as before.
    pub fn set_look(&mut self, gpu: &Headless, look: Look, pipelines: &mut Pipelines) -> anyhow::Result<()> {
        if look != self.look {
            let (stage, loaded) = (&mut self.stage, &self.loaded);
            checked(gpu, || Ok(stage.set_look(loaded, look.of_stage(), pipelines)?))?;
            self.look = look;
        }
        Ok(())
    }

    /// Takes over settings, light and effects of a changed scene.
    ///
    /// # Errors
    /// What is out of range, or what the device refuses; the scene is then as before.
    pub fn tune(&mut self, gpu: &Headless, scene: Scene, pipelines: &mut Pipelines) -> anyhow::Result<()> {
        scene.validate(&self.loaded.file)?;
        let before: Vec<_> = self.loaded.objects.iter().map(|o| o.settings).collect();
        let scene_before = std::mem::replace(&mut self.loaded.scene, scene);
        for (object, entry) in self.loaded.objects.iter_mut().zip(&self.loaded.scene.surfaces) {
            let wanted = keyleaf_stage::settings(&self.loaded.scene.settings.with(&entry.settings));
            let asked = keyleaf_stage::settings(&scene_before.settings.with(&entry.settings)).metric;
            // A metric that loading has refined at gaps stays so until another one is asked for.
            let metric = if wanted.metric == asked {
                object.settings.metric
            } else {
                wanted.metric
            };
            let moving = object.settings.moving;
            object.settings = keyleaf::Settings {
                metric,
                moving,
                ..wanted
            };
        }
        let (stage, loaded, look) = (&mut self.stage, &self.loaded, self.look.of_stage());
        let result = checked(gpu, || {
            loaded.objects.iter().try_for_each(|o| o.settings.validate())?;
            let anew = stage.set_settings(loaded, pipelines)?;
            stage.set_look(loaded, look, pipelines)?;
            Ok(anew)
        });
        self.probe = None;
        if let Ok(true) = result {
            (self.passes, self.settling, self.time) = (0, Settling::default(), 0.0);
        }
        if result.is_err() {
            self.loaded.scene = scene_before;
            for (object, settings) in self.loaded.objects.iter_mut().zip(before) {
                object.settings = settings;
            }
            // Those before the one that was refused have changed.
            self.stage.set_settings(&self.loaded, pipelines)?;
        }
        self.forget();
        result.map(|_| ())
    }

    /// Whether a surface moves by itself.
    pub fn moves(&self) -> bool {
        self.loaded.objects.iter().any(|object| object.settings.moving)
    }

    /// Puts moving surfaces where they are at a time in seconds; what is frozen stays.
    ///
    /// # Errors
    /// A pose has no surface.
    pub fn set_time(&mut self, time: f64) -> anyhow::Result<()> {
        if self.frozen.is_none() && self.time != time && self.moves() {
            self.time = time;
            self.stage.set_time(time)?;
            self.forget();
        }
        Ok(())
    }

    /// Stops at the present view, or goes on.
    pub fn set_frozen(&mut self, at: Option<View>) {
        if at.is_none() {
            self.refined = None;
        }
        self.frozen = at;
        self.drawn = None;
    }

    /// Draws anew: the picture is gone, the leaves are not.
    pub fn forget_picture(&mut self) {
        self.drawn = None;
    }

    /// Draws and refines anew, whatever is on the screen.
    pub fn forget(&mut self) {
        (self.drawn, self.refined) = (None, None);
    }

    /// Whether a frame for this view would look or refine otherwise than the last one.
    pub fn needs_frame(&self, view: &View) -> bool {
        self.drawn != Some((*view, self.look)) || !self.is_settled()
    }

    /// Records a frame: refines for the view, unless frozen, and draws.
    pub fn record(
        &mut self,
        gpu: &Headless,
        encoder: &mut wgpu::CommandEncoder,
        canvas: &Canvas,
        view: &View,
        costs: &mut Costs,
        time: f64,
    ) {
        let start = Instant::now();
        let timer = costs.timer(gpu, &self.stage);
        let mut phases: Vec<Phase> = Vec::new();
        if self.frozen.is_some() {
            self.stage.look_from(view);
        } else {
            if self.refined != Some(*view) {
                self.settling.restart(self.passes);
                self.refined = Some(*view);
            }
            match timer {
                Some(timer) => self.stage.update_timed(encoder, view, |_, phase| {
                    phases.push(phase);
                    timer.of_update(phases.len() as u32)
                }),
                None => self.stage.update(encoder, view),
            }
            let settle = self.stage.objects.iter().map(|o| o.quadtree.settings().settle).max();
            self.passes += settle.unwrap_or(1);
        }
        canvas.draw(encoder, &mut self.stage, view, timer.and_then(|timer| timer.of_draw()));
        self.drawn = Some((*view, self.look));
        let sample = Sample {
            device: None,
            record: start.elapsed().as_secs_f32() * 1e3,
            time,
        };
        costs.record(gpu, encoder, phases, sample);
    }

    /// Takes the figures that have arrived.
    pub fn observe(&mut self) {
        if let Some(statistics) = self.stage.statistics() {
            // Quadtrees that began anew count from 0 again.
            if statistics.passes > self.passes {
                self.passes = statistics.passes;
            }
            self.settling.observe(&statistics);
            self.statistics = Some(statistics);
        }
    }

    /// Writes the triangles that are seen to a model; how many there are. Waits for the device.
    ///
    /// # Errors
    /// The device is lost, or the file cannot be written.
    pub fn export(&self, gpu: &Headless, file: &Path) -> anyhow::Result<usize> {
        let mesh = Mesh::of(gpu, &self.stage, Extent::Seen, |_, _| {})?;
        mesh.write(file, true)?;
        Ok(mesh.triangles.len())
    }

    /// The scene as it is now, with what is drawn besides.
    pub fn scene(&self) -> Scene {
        let mut scene = self.loaded.scene.clone();
        let tint = (self.look.tint == Tint::Level).then_some(Effect::LevelTint);
        scene.effects.extend(tint);
        scene.effects.extend(self.look.wireframe.then_some(Effect::Wireframe));
        scene
    }

    /// The same scene on another device.
    ///
    /// # Errors
    /// What the device refuses.
    pub fn on(self, gpu: &Headless, pipelines: &mut Pipelines) -> anyhow::Result<Self> {
        let (look, original) = (self.look, self.original);
        let mut document = Self::new(gpu, self.loaded, pipelines)?;
        document.original = original;
        document.set_look(gpu, look, pipelines)?;
        Ok(document)
    }

    /// Compiles all shaders again, as after a change of their text. The quadtrees begin at their roots.
    ///
    /// # Errors
    /// What the shader compiler says; the scene is then as before.
    pub fn recompile(&mut self, gpu: &Headless, pipelines: &mut Pipelines) -> anyhow::Result<()> {
        let mut fresh = Pipelines::default();
        let (loaded, look) = (&self.loaded, self.look.of_stage());
        self.stage = checked(gpu, || {
            Ok(Stage::with_pipelines(
                gpu,
                loaded,
                look,
                target(Show::Colour),
                &mut fresh,
            )?)
        })?;
        *pipelines = fresh;
        self.probe = None;
        (self.passes, self.settling, self.time) = (0, Settling::default(), 0.0);
        self.forget();
        Ok(())
    }
}

/// Runs what makes things on the device; what the device refuses meanwhile is an error.
fn checked<T>(gpu: &Headless, make: impl FnOnce() -> anyhow::Result<T>) -> anyhow::Result<T> {
    let memory = gpu.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let validation = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
    let made = make();
    let refused = pollster::block_on(validation.pop());
    let too_large = pollster::block_on(memory.pop());
    if let Some(error) = refused {
        bail!("{}", keyleaf_shaders::located(&error.to_string()));
    }
    if let Some(error) = too_large {
        return Err(anyhow::anyhow!("{error}")).context("the device has not enough memory");
    }
    made
}
