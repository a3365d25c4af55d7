//! Figures of a quadtree that arrive some frames late, so that nothing ever waits for them.

use crate::Settings;
use crate::layout::Control;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

/// What one quadtree did in a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Statistics {
    /// Leaves alive.
    pub leaves: u32,
    /// Leaves drawn (pairs count once).
    pub visible: u32,
    /// Triangles drawn.
    pub triangles: u64,
    /// Halves of diamonds split in the last pass.
    pub splits: u32,
    /// Halves of diamonds merged in the last pass.
    pub merges: u32,
    /// Leaves that wish to split.
    pub unmet: u32,
    /// Of those, the ones for which the capacity has no room.
    pub starved: u32,
    /// Leaves that the buffers can hold.
    pub capacity: u32,
    /// Factor by which starvation or the target count have raised the threshold.
    pub threshold_factor: f32,
    /// Passes since the start.
    pub passes: u32,
    /// Rebuilds of the leaf table since the start.
    pub rebuilds: u32,
    /// Share of the table's entries that are in use, tombstones included.
    pub table_load: f32,
    /// Failed look-ups that the invariants promise to succeed: 0, or there is a bug.
    pub lost: u32,
}

impl Statistics {
    pub(crate) fn new(control: &Control, settings: &Settings) -> Self {
        Self {
            leaves: control.leaves,
            visible: control.visible,
            triangles: u64::from(control.visible) << (2 * settings.base_grid),
            splits: control.last_splits,
            merges: control.last_merges,
            unmet: control.unmet,
            starved: control.starved,
            capacity: settings.capacity,
            threshold_factor: (control.pressure as f32 / 16.0).exp2(),
            passes: control.passes,
            rebuilds: control.rebuilds,
            table_load: control.entries_used as f32 / crate::layout::table_entries(settings.capacity) as f32,
            lost: control.lost,
        }
    }
}

const IDLE: u32 = 0;
const PENDING: u32 = 1;
const READY: u32 = 2;

/// One buffer on its way from the GPU.
struct Slot {
    buffer: wgpu::Buffer,
    stage: Arc<AtomicU32>,
    number: u64,
}

/// A few buffers in turn; a frame that finds none free is not recorded.
pub(crate) struct StatisticsReader {
    slots: Vec<Slot>,
    recorded: u64,
    latest: Option<(u64, Control)>,
    /// Records up to this number are of leaves that are gone.
    forgotten: u64,
}

impl StatisticsReader {
    const SLOTS: usize = 3;

    pub fn new(device: &wgpu::Device) -> Self {
        let slot = |_| Slot {
            buffer: device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("keyleaf.statistics"),
                size: size_of::<Control>() as u64,
                usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
                mapped_at_creation: false,
            }),
            stage: Arc::new(AtomicU32::new(IDLE)),
            number: 0,
        };
        Self {
            slots: (0..Self::SLOTS).map(slot).collect(),
            recorded: 0,
            latest: None,
            forgotten: 0,
        }
    }

    /// Copies the counters when the encoder is submitted, and maps them then.
    pub fn record(&mut self, encoder: &mut wgpu::CommandEncoder, control: &wgpu::Buffer) {
        self.collect();
        let Some(slot) = self.slots.iter_mut().find(|s| s.stage.load(Ordering::Acquire) == IDLE) else {
            return;
        };
        self.recorded += 1;
        slot.number = self.recorded;
        slot.stage.store(PENDING, Ordering::Release);
        encoder.copy_buffer_to_buffer(control, 0, &slot.buffer, 0, Some(size_of::<Control>() as u64));
        let stage = Arc::clone(&slot.stage);
        encoder.map_buffer_on_submit(&slot.buffer, wgpu::MapMode::Read, .., move |result| {
            stage.store(if result.is_ok() { READY } else { IDLE }, Ordering::Release);
        });
    }

    pub fn forget(&mut self) {
        self.forgotten = self.recorded;
        self.latest = None;
    }

    fn collect(&mut self) {
        for slot in &self.slots {
            if slot.stage.load(Ordering::Acquire) != READY {
                continue;
            }
            let control = slot
                .buffer
                .get_mapped_range(..)
                .ok()
                .map(|view| bytemuck::pod_read_unaligned::<Control>(&view));
            slot.buffer.unmap();
            slot.stage.store(IDLE, Ordering::Release);
            if let Some(control) = control
                && slot.number > self.latest.map_or(self.forgotten, |(number, _)| number)
            {
                self.latest = Some((slot.number, control));
            }
        }
    }

    pub fn latest(&mut self, settings: &Settings) -> Option<Statistics> {
        self.collect();
        self.latest.map(|(_, control)| Statistics::new(&control, settings))
    }
}
