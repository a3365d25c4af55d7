//! What a frame costs: on the device by timestamps where it has them, on the wall's clock where not, and on all CPU cores.

use crate::session;
use cpu_time::ProcessTime;
use keyleaf::headless::Headless;
use keyleaf::{KeyleafError, Phase, Statistics, View, read_back, wgpu};
use keyleaf_stage::{Canvas, Stage};
use std::ops::Range;
use std::time::{Duration, Instant};

/// Timestamp queries around the phases of the updates of all surfaces, and around the draw.
pub struct Timer {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    /// Milliseconds a tick.
    period: f64,
    /// Passes that have timestamps, the draw first.
    passes: u32,
}

impl Timer {
    /// Queries for a stage; `None` if the device has no timestamps.
    pub fn new(gpu: &Headless, stage: &Stage) -> Option<Self> {
        if !gpu.device.features().contains(wgpu::Features::TIMESTAMP_QUERY) {
            return None;
        }
        let settle = |object: &keyleaf_stage::StageObject| object.quadtree.settings().settle;
        let updates: u32 = stage.objects.iter().map(settle).sum();
        let wanted = 1 + updates * Phase::ALL.len() as u32;
        let passes = wanted.min(wgpu::QUERY_SET_MAX_QUERIES / 2);
        let count = 2 * passes;
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
            passes,
        })
    }

    /// The queries of a pass; `None` beyond those that there are.
    fn of(&self, pass: u32) -> Option<(&wgpu::QuerySet, Option<u32>, Option<u32>)> {
        (pass < self.passes).then(|| (&self.queries, Some(2 * pass), Some(2 * pass + 1)))
    }

    fn of_update(&self, pass: u32) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        let (query_set, beginning_of_pass_write_index, end_of_pass_write_index) = self.of(pass)?;
        Some(wgpu::ComputePassTimestampWrites {
            query_set,
            beginning_of_pass_write_index,
            end_of_pass_write_index,
        })
    }

    fn of_draw(&self) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        let (query_set, beginning_of_pass_write_index, end_of_pass_write_index) = self.of(DRAW)?;
        Some(wgpu::RenderPassTimestampWrites {
            query_set,
            beginning_of_pass_write_index,
            end_of_pass_write_index,
        })
    }

    /// Milliseconds of each of the given passes.
    fn read(&self, gpu: &Headless, passes: Range<u32>) -> Result<Vec<f64>, KeyleafError> {
        let passes = passes.start..passes.end.min(self.passes);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.resolve_query_set(&self.queries, 2 * passes.start..2 * passes.end, &self.resolved, 0);
        gpu.queue.submit([encoder.finish()]);
        let size = u64::from(passes.end - passes.start) * 16;
        let bytes = read_back::read(&gpu.device, &gpu.queue, "timestamps", &self.resolved, 0, size)?;
        let ticks: Vec<u64> = bytemuck::pod_collect_to_vec(&bytes);
        let intervals = ticks.as_chunks::<2>().0.iter();
        Ok(intervals
            .map(|[begin, end]| end.saturating_sub(*begin) as f64 * self.period)
            .collect())
    }
}

/// The pass of the draw among those with timestamps.
const DRAW: u32 = 0;

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
    /// Milliseconds of the phases of the update; `None` without timestamps.
    pub phases: Option<[f64; Phase::ALL.len()]>,
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
    let mut timed: Vec<Phase> = Vec::new();
    let mut update = part(gpu, |encoder| match timer {
        Some(timer) => stage.update_timed(encoder, view, |_, phase| {
            timed.push(phase);
            timer.of_update(DRAW + timed.len() as u32)
        }),
        None => stage.update(encoder, view),
    })?;
    let mut phases = None;
    if let Some(timer) = timer {
        let sums = phases.insert([0.0; Phase::ALL.len()]);
        let first = DRAW + 1;
        for (phase, ms) in timed.iter().zip(timer.read(gpu, first..first + timed.len() as u32)?) {
            sums[*phase as usize] += ms;
        }
        update.ms = sums.iter().sum();
    }
    let draw = match canvas {
        Some(canvas) => {
            let mut draw = part(gpu, |encoder| {
                canvas.draw(encoder, stage, view, timer.and_then(Timer::of_draw));
            })?;
            if let Some(timer) = timer {
                draw.ms = timer.read(gpu, DRAW..DRAW + 1)?.iter().sum();
            }
            Some(draw)
        }
        None => None,
    };
    Ok(TimedFrame {
        update,
        phases,
        draw,
        wall: begin.elapsed(),
        statistics: session::statistics(stage)?,
    })
}

/// Records, submits and waits; milliseconds by the wall's clock.
fn part(gpu: &Headless, record: impl FnOnce(&mut wgpu::CommandEncoder)) -> Result<Part, KeyleafError> {
    let (begin, cpu) = (Instant::now(), ProcessTime::now());
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    record(&mut encoder);
    let commands = encoder.finish();
    let recorded = begin.elapsed();
    let submitted = Instant::now();
    gpu.queue.submit([commands]);
    session::wait(gpu)?;
    Ok(Part {
        ms: submitted.elapsed().as_secs_f64() * 1e3,
        cpu: cpu.elapsed(),
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
