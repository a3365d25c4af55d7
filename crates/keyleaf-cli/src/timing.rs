//! What a frame costs: on the device by timestamps where it has them, on the wall's clock where not, and on all CPU cores.

use crate::session;
use cpu_time::ProcessTime;
use keyleaf::headless::Headless;
use keyleaf::{KeyleafError, Phase, Statistics, View, read_back, wgpu};
pub use keyleaf_stage::Timer;
use keyleaf_stage::{Canvas, Stage};
use std::ops::Range;
use std::time::{Duration, Instant};

/// Milliseconds of each of the given passes; waits for them.
fn read(timer: &Timer, gpu: &Headless, passes: Range<u32>) -> Result<Vec<f64>, KeyleafError> {
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let (resolved, size) = timer.resolve(&mut encoder, passes);
    gpu.queue.submit([encoder.finish()]);
    let bytes = read_back::read(&gpu.device, &gpu.queue, "timestamps", resolved, 0, size)?;
    Ok(timer.milliseconds(&bytes))
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
            timer.of_update(Timer::DRAW + timed.len() as u32)
        }),
        None => stage.update(encoder, view),
    })?;
    let mut phases = None;
    if let Some(timer) = timer {
        let sums = phases.insert([0.0; Phase::ALL.len()]);
        let first = Timer::DRAW + 1;
        for (phase, ms) in timed.iter().zip(read(timer, gpu, first..first + timed.len() as u32)?) {
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
                draw.ms = read(timer, gpu, Timer::DRAW..Timer::DRAW + 1)?.iter().sum();
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
