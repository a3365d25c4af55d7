//! Reading what the GPU holds, for checks, exports and tests. These calls wait for the device; no frame needs them.

use crate::layout::{Control, Leaf, state};
use crate::{KeyleafError, Quadtree, Statistics};
use std::sync::mpsc;

/// The leaves of a quadtree as the GPU holds them, by slot.
#[derive(Debug, Clone)]
pub struct Snapshot {
    /// Keys, decoded forms and entries.
    pub leaves: Vec<Leaf>,
    /// State words: published wish and flags (see [`crate::layout::state`]).
    pub states: Vec<u32>,
    /// Requests that the last decision raised, as f32 bits.
    pub requests: Vec<u32>,
    /// Slots that are drawn, in the order of the draw.
    pub visible: Vec<u32>,
    /// Counters.
    pub control: Control,
    /// The leaf table.
    pub table: Vec<u32>,
    /// Figures of the last pass.
    pub statistics: Statistics,
}

impl Snapshot {
    /// Whether the leaf in a slot is half of a pair.
    pub fn is_pair(&self, slot: usize) -> bool {
        self.states[slot] & state::PAIR != 0
    }

    /// Whether the four nodes about the right angle of the leaf in a slot are leaves, so that it may be half of a pair, and need not be.
    pub fn is_free(&self, slot: usize) -> bool {
        self.states[slot] & state::FREE != 0
    }
}

impl Quadtree {
    /// Copies the leaves alone from the GPU, and waits for them.
    ///
    /// # Errors
    /// [`KeyleafError::ReadBack`] if the device is lost.
    pub fn read_leaves(&self, device: &wgpu::Device, queue: &wgpu::Queue) -> Result<Vec<Leaf>, KeyleafError> {
        let buffers = self.buffers();
        let control = read(
            device,
            queue,
            "control",
            &buffers.control,
            0,
            size_of::<Control>() as u64,
        )?;
        let count = u64::from(bytemuck::pod_read_unaligned::<Control>(&control).leaves);
        let bytes = count * size_of::<Leaf>() as u64;
        Ok(bytemuck::pod_collect_to_vec(&read(
            device,
            queue,
            "leaves",
            &buffers.leaves,
            0,
            bytes,
        )?))
    }

    /// Copies leaves, states and lists from the GPU, and waits for them.
    ///
    /// # Errors
    /// [`KeyleafError::ReadBack`] if the device is lost.
    pub fn read_back(&self, device: &wgpu::Device, queue: &wgpu::Queue) -> Result<Snapshot, KeyleafError> {
        let buffers = self.buffers();
        let control: Control = bytemuck::pod_read_unaligned(&read(
            device,
            queue,
            "control",
            &buffers.control,
            0,
            size_of::<Control>() as u64,
        )?);
        let slots = u64::from(self.settings().capacity);
        let count = u64::from(control.leaves);
        let words = |name, buffer, from: u64, n: u64| -> Result<Vec<u32>, KeyleafError> {
            Ok(bytemuck::pod_collect_to_vec(&read(
                device,
                queue,
                name,
                buffer,
                4 * from,
                4 * n,
            )?))
        };
        Ok(Snapshot {
            leaves: bytemuck::pod_collect_to_vec(&read(device, queue, "leaves", &buffers.leaves, 0, 32 * count)?),
            states: words("state", &buffers.state, 0, count)?,
            requests: words("requests", &buffers.state, slots, count)?,
            visible: words("lists", &buffers.lists, 0, u64::from(control.visible))?,
            table: words("table", &buffers.table, 0, buffers.table.size() / 4)?,
            statistics: Statistics::new(&control, self.settings()),
            control,
        })
    }
}

impl Quadtree {
    /// Copies the tables of the surface from the GPU, `surface_a` and `surface_b`, and waits for them.
    ///
    /// # Errors
    /// [`KeyleafError::ReadBack`] if the device is lost.
    pub fn read_surface(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
    ) -> Result<(Vec<f32>, Vec<u32>), KeyleafError> {
        let [a, b] = self.surface_tables();
        let a = read(device, queue, "surface A", a, 0, a.size())?;
        let b = read(device, queue, "surface B", b, 0, b.size())?;
        Ok((bytemuck::pod_collect_to_vec(&a), bytemuck::pod_collect_to_vec(&b)))
    }
}

/// Copies bytes of a buffer from the GPU, and waits for them.
///
/// # Errors
/// [`KeyleafError::ReadBack`] if the device is lost.
pub fn read(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    name: &'static str,
    buffer: &wgpu::Buffer,
    offset: u64,
    size: u64,
) -> Result<Vec<u8>, KeyleafError> {
    if size == 0 {
        return Ok(Vec::new());
    }
    let staging = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("keyleaf.read_back"),
        size,
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor {
        label: Some("keyleaf.read_back"),
    });
    encoder.copy_buffer_to_buffer(buffer, offset, &staging, 0, Some(size));
    queue.submit([encoder.finish()]);
    map(device, name, &staging)
}

/// Maps a buffer that a submitted encoder has filled, and waits for it.
pub(crate) fn map(device: &wgpu::Device, name: &'static str, staging: &wgpu::Buffer) -> Result<Vec<u8>, KeyleafError> {
    let failed = |reason: String| KeyleafError::ReadBack(name, reason);
    let (sender, receiver) = mpsc::channel();
    staging.map_async(wgpu::MapMode::Read, .., move |result| {
        let _ = sender.send(result); // the receiver is gone only if poll failed below
    });
    device
        .poll(wgpu::PollType::wait_indefinitely())
        .map_err(|e| failed(e.to_string()))?;
    receiver
        .recv()
        .map_err(|e| failed(e.to_string()))?
        .map_err(|e| failed(e.to_string()))?;
    let bytes = staging
        .get_mapped_range(..)
        .map_err(|e| failed(e.to_string()))?
        .to_vec();
    staging.unmap();
    Ok(bytes)
}
