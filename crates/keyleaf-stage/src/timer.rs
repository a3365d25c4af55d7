//! Timestamps around what a stage records: `bench` waits for them, the viewer reads them some frames late.

use crate::{Stage, StageObject};
use keyleaf::Phase;
use keyleaf::headless::Headless;
use std::ops::Range;

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
    /// The pass of the draw among those with timestamps; those of the updates follow, in their order.
    pub const DRAW: u32 = 0;

    /// Queries for a stage; `None` if the device has no timestamps.
    pub fn new(gpu: &Headless, stage: &Stage) -> Option<Self> {
        if !gpu.device.features().contains(wgpu::Features::TIMESTAMP_QUERY) {
            return None;
        }
        let settle = |object: &StageObject| object.quadtree.settings().settle;
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

    /// The timestamps of pass `pass`, an update.
    pub fn of_update(&self, pass: u32) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        let (query_set, beginning_of_pass_write_index, end_of_pass_write_index) = self.of(pass)?;
        Some(wgpu::ComputePassTimestampWrites {
            query_set,
            beginning_of_pass_write_index,
            end_of_pass_write_index,
        })
    }

    /// The timestamps of the draw.
    pub fn of_draw(&self) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        let (query_set, beginning_of_pass_write_index, end_of_pass_write_index) = self.of(Self::DRAW)?;
        Some(wgpu::RenderPassTimestampWrites {
            query_set,
            beginning_of_pass_write_index,
            end_of_pass_write_index,
        })
    }

    /// Records the copy of the timestamps of some passes to the start of a buffer; the buffer, and the bytes that will hold them.
    pub fn resolve(&self, encoder: &mut wgpu::CommandEncoder, passes: Range<u32>) -> (&wgpu::Buffer, u64) {
        let passes = passes.start..passes.end.min(self.passes);
        encoder.resolve_query_set(&self.queries, 2 * passes.start..2 * passes.end, &self.resolved, 0);
        (&self.resolved, u64::from(passes.end - passes.start) * 16)
    }

    /// Milliseconds of each pass, from the bytes of [`resolve`](Self::resolve).
    pub fn milliseconds(&self, bytes: &[u8]) -> Vec<f64> {
        let ticks: Vec<u64> = bytemuck::pod_collect_to_vec(bytes);
        let intervals = ticks.as_chunks::<2>().0.iter();
        intervals
            .map(|[begin, end]| end.saturating_sub(*begin) as f64 * self.period)
            .collect()
    }

    /// The bytes of all timestamps.
    pub fn bytes(&self) -> u64 {
        self.resolved.size()
    }
}
