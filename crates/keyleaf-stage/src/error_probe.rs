//! How far drawn triangles are from the surface, measured: a small picture of what is seen, read some frames late.

use crate::{Canvas, Loaded, Pipelines, Show, Stage, target};
use glam::UVec2;
use keyleaf::draw::{LeafDraw, LeafPipeline};
use keyleaf::headless::Headless;
use keyleaf::shading::{Channel, Shading};
use keyleaf::{KeyleafError, Quadtree, View};
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

/// Distance of the drawn triangles from the surface over a picture, in pixels of the view.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredError {
    /// Mean over where there is a surface.
    pub mean: f32,
    /// What 99 % of it are below.
    pub p99: f32,
}

/// Measures the error of a stage as it is drawn.
pub struct ErrorProbe {
    canvas: Canvas,
    draws: Vec<(Arc<LeafPipeline>, LeafDraw)>,
    buffer: wgpu::Buffer,
    state: Arc<AtomicU32>,
}

const IDLE: u32 = 0;
const PENDING: u32 = 1;
const READY: u32 = 2;
/// Pixels of the small picture; a row of it is a multiple of what copies are aligned to.
const SIZE: UVec2 = UVec2::new(128, 72);

impl ErrorProbe {
    /// A probe of a stage; it holds no longer than the quadtrees of it.
    ///
    /// # Errors
    /// [`KeyleafError`] if the pipelines cannot be made.
    pub fn new(
        gpu: &Headless,
        stage: &Stage,
        loaded: &Loaded,
        pipelines: &mut Pipelines,
    ) -> Result<Self, KeyleafError> {
        let target = target(Show::Error);
        let mut draws = Vec::new();
        for (object, loaded) in stage.objects.iter().zip(&loaded.objects) {
            let kind = Quadtree::kind(loaded.surface.as_ref(), object.quadtree.settings());
            let pipeline = pipelines.draw(&gpu.device, kind, Channel::Error, target)?;
            let draw = LeafDraw::new(&gpu.device, &gpu.queue, &pipeline, &object.quadtree, &loaded.look);
            draws.push((pipeline, draw));
        }
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("keyleaf.error_probe"),
            size: u64::from(SIZE.x * SIZE.y * 4),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        Ok(Self {
            canvas: Canvas::new(&gpu.device, SIZE, target)?,
            draws,
            buffer,
            state: Arc::new(AtomicU32::new(IDLE)),
        })
    }

    /// Records a measurement of what was just drawn for `view`, unless one is on its way; whether it did.
    pub fn record(&mut self, gpu: &Headless, encoder: &mut wgpu::CommandEncoder, stage: &Stage, view: &View) -> bool {
        if self.state.load(Ordering::Acquire) != IDLE {
            return false;
        }
        let shading = Shading {
            pixels_per_unit: view.pixels_per_unit() as f32,
            ..Shading::default()
        };
        {
            let nothing = wgpu::Color {
                r: -1.0,
                g: 0.0,
                b: 0.0,
                a: 0.0,
            };
            for (object, (_, draw)) in stage.objects.iter().zip(&mut self.draws) {
                draw.prepare(&gpu.device, &gpu.queue, &object.quadtree, &shading);
            }
            let mut pass = self.canvas.begin(encoder, nothing, None);
            for (object, (pipeline, draw)) in stage.objects.iter().zip(&self.draws) {
                draw.draw(&mut pass, pipeline, &object.quadtree);
            }
        }
        self.canvas.copy(encoder, &self.buffer, SIZE.x * 4);
        self.state.store(PENDING, Ordering::Release);
        let state = Arc::clone(&self.state);
        encoder.map_buffer_on_submit(&self.buffer, wgpu::MapMode::Read, .., move |result| {
            state.store(if result.is_ok() { READY } else { IDLE }, Ordering::Release);
        });
        true
    }

    /// Whether a measurement is on its way.
    pub fn is_waiting(&self) -> bool {
        self.state.load(Ordering::Acquire) != IDLE
    }

    /// A measurement that has arrived, once. `None` also where nothing is seen.
    pub fn take(&mut self) -> Option<MeasuredError> {
        if self.state.load(Ordering::Acquire) != READY {
            return None;
        }
        let values: Option<Vec<f32>> = self
            .buffer
            .get_mapped_range(..)
            .ok()
            .map(|view| bytemuck::pod_collect_to_vec(&view));
        self.buffer.unmap();
        self.state.store(IDLE, Ordering::Release);
        let mut seen: Vec<f32> = values?.into_iter().filter(|e| *e >= 0.0).collect();
        seen.sort_by(f32::total_cmp);
        let rank = (seen.len() as f64 * 0.99).ceil() as usize;
        Some(MeasuredError {
            p99: *seen.get(rank.checked_sub(1)?)?,
            mean: seen.iter().sum::<f32>() / seen.len() as f32,
        })
    }
}
