//! What frames cost: timestamps of the device that arrive some frames late, and the time that recording takes.

use keyleaf::headless::Headless;
use keyleaf::{Phase, wgpu};
use keyleaf_stage::{Stage, Timer};
use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

/// Frames that the plots show.
pub const FRAMES: usize = 240;
/// Rows of a sample: the phases of the update, and the draw.
pub const ROWS: usize = Phase::ALL.len() + 1;

/// The names of the rows.
pub fn names() -> [&'static str; ROWS] {
    let mut names = ["draw"; ROWS];
    for (name, phase) in names.iter_mut().zip(Phase::ALL) {
        *name = phase.name();
    }
    names
}

/// One frame.
#[derive(Debug, Clone, Copy, Default)]
pub struct Sample {
    /// Milliseconds of the device by row, as `bench` takes them; `None` where it has no timestamps.
    pub device: Option<[f32; ROWS]>,
    /// Milliseconds of recording the commands.
    pub record: f32,
    /// Seconds since the viewer was started.
    pub time: f64,
}

impl Sample {
    /// Milliseconds of all rows.
    pub fn total(&self) -> Option<f32> {
        self.device.map(|rows| rows.iter().sum())
    }
}

const IDLE: u32 = 0;
const PENDING: u32 = 1;
const READY: u32 = 2;

/// Timestamps on their way.
struct Slot {
    buffer: wgpu::Buffer,
    state: Arc<AtomicU32>,
    phases: Vec<Phase>,
    sample: Sample,
}

/// The last frames.
#[derive(Default)]
pub struct Costs {
    /// Oldest first.
    pub samples: VecDeque<Sample>,
    timer: Option<Timer>,
    /// Passes a frame that the timer was made for.
    passes: u32,
    slots: Vec<Slot>,
}

impl Costs {
    /// The timer for a stage, made anew where the number of its passes has changed.
    pub fn timer(&mut self, gpu: &Headless, stage: &Stage) -> Option<&Timer> {
        let passes = stage.objects.iter().map(|o| o.quadtree.settings().settle).sum();
        if self.passes != passes {
            self.passes = passes;
            self.timer = Timer::new(gpu, stage);
            self.slots.clear();
        }
        self.timer.as_ref()
    }

    /// Forgets the timer, as after a loss of the device; the samples stay.
    pub fn forget_device(&mut self) {
        self.passes = 0;
        self.timer = None;
        self.slots.clear();
    }

    /// Records that the timestamps of a frame are read, its phases in their order, then its draw.
    pub fn record(&mut self, gpu: &Headless, encoder: &mut wgpu::CommandEncoder, phases: Vec<Phase>, sample: Sample) {
        self.collect();
        let Some(timer) = &self.timer else {
            self.push(sample);
            return;
        };
        const SLOTS: usize = 4;
        if self.slots.is_empty() {
            self.slots.extend((0..SLOTS).map(|_| Slot {
                buffer: gpu.device.create_buffer(&wgpu::BufferDescriptor {
                    label: Some("keyleaf.viewer.timestamps"),
                    size: timer.bytes(),
                    usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
                    mapped_at_creation: false,
                }),
                state: Arc::new(AtomicU32::new(IDLE)),
                phases: Vec::new(),
                sample,
            }));
        }
        let free = self.slots.iter_mut().find(|s| s.state.load(Ordering::Acquire) == IDLE);
        let Some(slot) = free else { return };
        let (resolved, bytes) = timer.resolve(encoder, Timer::DRAW..Timer::DRAW + 1 + phases.len() as u32);
        encoder.copy_buffer_to_buffer(resolved, 0, &slot.buffer, 0, Some(bytes));
        (slot.phases, slot.sample) = (phases, sample);
        slot.state.store(PENDING, Ordering::Release);
        let state = Arc::clone(&slot.state);
        encoder.map_buffer_on_submit(&slot.buffer, wgpu::MapMode::Read, ..bytes, move |result| {
            state.store(if result.is_ok() { READY } else { IDLE }, Ordering::Release);
        });
    }

    /// Whether timestamps are on their way.
    pub fn is_waiting(&self) -> bool {
        self.slots.iter().any(|slot| slot.state.load(Ordering::Acquire) != IDLE)
    }

    /// Takes what has arrived.
    pub fn collect(&mut self) {
        let Some(timer) = &self.timer else { return };
        let mut arrived = Vec::new();
        for slot in &mut self.slots {
            if slot.state.load(Ordering::Acquire) != READY {
                continue;
            }
            let bytes = 16 * (1 + slot.phases.len() as u64);
            let ms = slot
                .buffer
                .get_mapped_range(..bytes.min(slot.buffer.size()))
                .map(|view| timer.milliseconds(&view));
            slot.buffer.unmap();
            slot.state.store(IDLE, Ordering::Release);
            if let Ok(ms) = ms {
                let mut rows = [0.0f32; ROWS];
                rows[ROWS - 1] = ms.first().copied().unwrap_or(0.0) as f32;
                for (phase, ms) in slot.phases.iter().zip(ms.iter().skip(1)) {
                    rows[*phase as usize] += *ms as f32;
                }
                arrived.push(Sample {
                    device: Some(rows),
                    ..slot.sample
                });
            }
        }
        arrived.sort_by(|a, b| a.time.total_cmp(&b.time));
        arrived.into_iter().for_each(|sample| self.push(sample));
    }

    fn push(&mut self, sample: Sample) {
        if self.samples.len() == FRAMES {
            self.samples.pop_front();
        }
        self.samples.push_back(sample);
    }

    /// Median and 99th percentile of a number of the samples, by nearest rank as `bench` has it.
    pub fn spread(&self, of: impl Fn(&Sample) -> Option<f32>) -> Option<(f32, f32)> {
        let mut sorted: Vec<f32> = self.samples.iter().filter_map(of).collect();
        sorted.sort_by(f32::total_cmp);
        let at = |part: f64| {
            let rank = (part * sorted.len() as f64).ceil() as usize;
            sorted.get(rank.saturating_sub(1)).copied()
        };
        Some((at(0.5)?, at(0.99)?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_are_of_the_nearest_rank() {
        let mut costs = Costs::default();
        for i in 1..=100u16 {
            costs.push(Sample {
                record: f32::from(i),
                ..Sample::default()
            });
        }
        assert_eq!(costs.spread(|s| Some(s.record)), Some((50.0, 99.0)));
        assert_eq!(costs.spread(|s| s.total()), None);
    }
}
