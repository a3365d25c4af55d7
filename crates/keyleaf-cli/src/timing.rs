//! What a frame costs: on the device by timestamps where it has them, on the wall's clock where not, and on all CPU cores.

use crate::session;
use cpu_time::ProcessTime;
use keyleaf::headless::Headless;
use keyleaf::{KeyleafError, Statistics, View, read_back, wgpu};
use keyleaf_stage::{Canvas, Stage};
use std::time::{Duration, Instant};

/// Timestamp queries around the updates of all surfaces and the draw.
pub struct Timer {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    /// Milliseconds a tick.
    period: f64,
    surfaces: u32,
}

impl Timer {
    /// Queries for a stage; `None` if the device has no timestamps.
    pub fn new(gpu: &Headless, stage: &Stage) -> Option<Self> {
        if !gpu.device.features().contains(wgpu::Features::TIMESTAMP_QUERY) {
            return None;
        }
        let surfaces = stage.objects.len() as u32;
        let count = 2 * (surfaces + 1);
        let queries = gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
            label: Some("keyleaf.timestamps"),
            ty: wgpu::QueryType::Timestamp,
            count,
        });
        let resolved = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("keyleaf.timestamps"),
            size: u64::from(count) * 8,
            usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        Some(Self {
            queries,
            resolved,
            period: f64::from(gpu.queue.get_timestamp_period()) * 1e-6,
            surfaces,
        })
    }

    fn of_update(&self, surface: usize) -> wgpu::ComputePassTimestampWrites<'_> {
        let begin = 2 * surface as u32;
        wgpu::ComputePassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: Some(begin),
            end_of_pass_write_index: Some(begin + 1),
        }
    }

    fn of_draw(&self) -> wgpu::RenderPassTimestampWrites<'_> {
        wgpu::RenderPassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: Some(2 * self.surfaces),
            end_of_pass_write_index: Some(2 * self.surfaces + 1),
        }
    }

    /// Milliseconds of the given passes together.
    fn read(&self, gpu: &Headless, passes: std::ops::Range<u32>) -> Result<f64, KeyleafError> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.resolve_query_set(&self.queries, 2 * passes.start..2 * passes.end, &self.resolved, 0);
        gpu.queue.submit([encoder.finish()]);
        let size = u64::from(passes.end - passes.start) * 16;
        let bytes = read_back::read(&gpu.device, &gpu.queue, "timestamps", &self.resolved, 0, size)?;
        let ticks: Vec<u64> = bytemuck::pod_collect_to_vec(&bytes);
        let all: u64 = ticks
            .as_chunks::<2>()
            .0
            .iter()
            .map(|[begin, end]| end.saturating_sub(*begin))
            .sum();
        Ok(all as f64 * self.period)
    }
}

/// One part of a frame.
#[derive(Debug, Clone, Copy, Default)]
pub struct Part {
    /// On the device, or, without timestamps, from submission to completion.
    pub ms: f64,
    /// Of this process, over all threads.
    pub cpu: Duration,
    /// Of recording the commands.
    pub record: Duration,
}

/// One frame, waited for.
#[derive(Debug, Clone, Copy)]
pub struct TimedFrame {
    /// The update of all surfaces.
    pub update: Part,
    /// The draw, if there was one.
    pub draw: Option<Part>,
    /// From its begin to its end.
    pub wall: Duration,
    /// Figures after it.
    pub statistics: Statistics,
}

/// Updates for a view and, with a canvas, draws it. Each part is submitted and waited for by itself, so that CPU time can be told
/// apart.
pub fn frame(
    gpu: &Headless,
    stage: &mut Stage,
    canvas: Option<&Canvas>,
    view: &View,
    timer: Option<&Timer>,
) -> Result<TimedFrame, KeyleafError> {
    let begin = Instant::now();
    let update = part(gpu, timer, 0..stage.objects.len() as u32, |encoder| {
        stage.update(encoder, view, |surface| timer.map(|timer| timer.of_update(surface)));
    })?;
    let pass = stage.objects.len() as u32;
    let draw = match canvas {
        Some(canvas) => Some(part(gpu, timer, pass..pass + 1, |encoder| {
            canvas.draw(encoder, stage, view, timer.map(Timer::of_draw));
        })?),
        None => None,
    };
    Ok(TimedFrame {
        update,
        draw,
        wall: begin.elapsed(),
        statistics: session::statistics(stage)?,
    })
}

/// Records, submits and waits.
fn part(
    gpu: &Headless,
    timer: Option<&Timer>,
    passes: std::ops::Range<u32>,
    record: impl FnOnce(&mut wgpu::CommandEncoder),
) -> Result<Part, KeyleafError> {
    let (begin, cpu) = (Instant::now(), ProcessTime::now());
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    record(&mut encoder);
    let commands = encoder.finish();
    let recorded = begin.elapsed();
    let submitted = Instant::now();
    gpu.queue.submit([commands]);
    session::wait(gpu)?;
    let (wall, cpu) = (submitted.elapsed(), cpu.elapsed());
    let ms = match timer {
        Some(timer) => timer.read(gpu, passes)?,
        None => wall.as_secs_f64() * 1e3,
    };
    Ok(Part {
        ms,
        cpu,
        record: recorded,
    })
}

/// What milliseconds are measured by.
pub fn clock(timer: Option<&Timer>) -> &'static str {
    match timer {
        Some(_) => "timestamps of the device",
        None => "wall time from submission to completion: the device has no timestamps",
    }
}
