//! Pictures of a scene at changing settings.

use crate::session;
use crate::timing::{self, TimedFrame, Timer};
use glam::{DMat4, UVec2};
use keyleaf::headless::Headless;
use keyleaf::{Settings, View};
use keyleaf_report::error::ScreenView;
use keyleaf_stage::{Canvas, Loaded, LoadedObject, Pipelines, Stage, StageLook, target};
use std::time::{Duration, Instant};

/// What all pictures of a run have in common.
#[derive(Clone, Copy)]
pub struct Setup<'a> {
    pub gpu: &'a Headless,
    pub size: UVec2,
    /// Frames that are timed.
    pub frames: u32,
    /// No more frames are timed after this.
    pub timed: Duration,
    pub quiet: bool,
}

/// A scene of one surface, ready to be drawn.
pub struct Studio<'a> {
    setup: &'a Setup<'a>,
    stage: Stage,
    canvas: Canvas,
    timer: Option<Timer>,
    view: View,
}

/// A picture.
pub struct Shot {
    /// Four bytes a pixel.
    pub pixels: Vec<u8>,
    /// Triangles drawn.
    pub triangles: u64,
    /// Splits that did not fit the buffers.
    pub starved: u32,
    /// Median of update and draw together.
    pub ms: f64,
}

/// Frames of a settled view.
pub struct Film {
    pub frames: Vec<TimedFrame>,
    /// Four bytes a pixel.
    pub pixels: Vec<u8>,
}

impl<'a> Studio<'a> {
    /// Compiles what the scene needs.
    pub fn new(setup: &'a Setup<'a>, loaded: &Loaded, view: &View) -> anyhow::Result<Self> {
        Self::with_pipelines(setup, loaded, view, &mut Pipelines::default())
    }

    /// The same with what was compiled before.
    pub fn with_pipelines(
        setup: &'a Setup<'a>,
        loaded: &Loaded,
        view: &View,
        pipelines: &mut Pipelines,
    ) -> anyhow::Result<Self> {
        let look = StageLook::default();
        let stage = Stage::with_pipelines(setup.gpu, loaded, look, target(look.show), pipelines)?;
        let canvas = Canvas::new(&setup.gpu.device, setup.size, stage.target())?;
        Ok(Self {
            setup,
            timer: Timer::new(setup.gpu, &stage),
            stage,
            canvas,
            view: *view,
        })
    }

    /// Changes the settings of the surface.
    pub fn set(&mut self, change: impl Fn(&mut Settings)) -> anyhow::Result<()> {
        for object in &mut self.stage.objects {
            let mut settings = *object.quadtree.settings();
            change(&mut settings);
            object.quadtree.set_settings(settings)?;
        }
        Ok(())
    }

    /// What is drawn.
    pub fn stage(&self) -> &Stage {
        &self.stage
    }

    /// Whether milliseconds are the device's.
    pub fn has_timestamps(&self) -> bool {
        self.timer.is_some()
    }

    /// Frames once nothing changes any more, with all that is known of them.
    pub fn film(&mut self) -> anyhow::Result<Film> {
        let gpu = self.setup.gpu;
        session::settle(gpu, &mut self.stage, &self.view, None, self.setup.quiet)?;
        let timer = self.timer.as_ref();
        let mut frame = || timing::frame(gpu, &mut self.stage, Some(&self.canvas), &self.view, timer);
        frame()?; // shaders are compiled at their first use
        let begin = Instant::now();
        let mut frames = Vec::new();
        while frames.len() < self.setup.frames as usize && (frames.is_empty() || begin.elapsed() < self.setup.timed) {
            frames.push(frame()?);
        }
        Ok(Film {
            frames,
            pixels: self.canvas.read(gpu)?,
        })
    }

    /// The picture once nothing changes any more, drawn `frames` times.
    fn draw(&mut self, frames: u32) -> anyhow::Result<Shot> {
        let gpu = self.setup.gpu;
        session::settle(gpu, &mut self.stage, &self.view, None, self.setup.quiet)?;
        let timer = self.timer.as_ref();
        let mut frame = || timing::frame(gpu, &mut self.stage, Some(&self.canvas), &self.view, timer);
        // Shaders are compiled at their first use: the first frame does not count.
        let statistics = frame()?.statistics;
        let mut times = Vec::new();
        let begin = Instant::now();
        for _ in 0..frames {
            let frame = frame()?;
            times.push(frame.update.ms + frame.draw.unwrap_or_default().ms);
            if begin.elapsed() > self.setup.timed {
                break;
            }
        }
        times.sort_by(f64::total_cmp);
        Ok(Shot {
            pixels: self.canvas.read(gpu)?,
            triangles: statistics.triangles,
            starved: statistics.starved,
            ms: times.get(times.len() / 2).copied().unwrap_or(0.0),
        })
    }

    /// The picture, timed.
    pub fn shoot(&mut self) -> anyhow::Result<Shot> {
        self.draw(self.setup.frames)
    }

    /// The picture without times.
    pub fn look(&mut self) -> anyhow::Result<Shot> {
        self.draw(0)
    }
}

/// The view of the pictures, as the object space of a surface sees it.
pub fn screen_of(setup: &Setup<'_>, view: &View, object: &LoadedObject) -> ScreenView {
    let clip_from_world = view.clip_from_view().as_dmat4()
        * DMat4::from_quat(view.orientation.inverse())
        * DMat4::from_translation(-view.eye);
    ScreenView::new(
        clip_from_world * DMat4::from(object.world_from_object),
        setup.size.to_array(),
    )
}

/// The scene with another surface in place of its only one.
pub fn with_object(loaded: &Loaded, object: LoadedObject) -> Loaded {
    Loaded {
        file: loaded.file.clone(),
        scene: loaded.scene.clone(),
        objects: vec![object],
        notes: Vec::new(),
        files: Vec::new(),
        bounds: loaded.bounds,
    }
}

/// The same with its surface's settings changed.
pub fn with_settings(loaded: &Loaded, change: impl Fn(&mut Settings)) -> Loaded {
    let mut object = loaded.objects[0].clone();
    change(&mut object.settings);
    with_object(loaded, object)
}
