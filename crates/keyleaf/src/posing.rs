//! A surface whose control mesh moves: the buffers of its module `pose` (such as
//! `shaders/passes/pose.wgsl`), and when that has to run.

use crate::KeyleafError;
use crate::binding;
use crate::layout;
use crate::passes::{Passes, Stage};
use crate::surface_buffers::{SurfaceBuffers, buffer};
use glam::DVec3;
use keyleaf_surface::{PoseDispatch, Surface};

fn groups(dispatch: &PoseDispatch) -> [u32; 3] {
    match *dispatch {
        PoseDispatch::Groups(groups) => layout::groups_for(groups, 1),
        PoseDispatch::Invocations(invocations) => layout::groups_for(invocations, layout::GROUP_SIZE),
    }
}

/// Where the control mesh is, and what finds the tables of the surface from it.
pub(crate) struct Posing {
    group: wgpu::BindGroup,
    cage: wgpu::Buffer,
    bytes: u64,
    vertices: usize,
    /// Workgroups of each entry point.
    dispatches: Vec<[u32; 3]>,
    /// None while the mesh is at rest, as the tables of the surface have it.
    positions: Option<Vec<DVec3>>,
    /// The origin that the cage on the GPU is relative to, if it is there.
    origin: Option<DVec3>,
    is_due: bool,
}

impl Posing {
    /// None if the kind of the passes does not move.
    pub fn new(
        device: &wgpu::Device,
        passes: &Passes,
        surface: &dyn Surface,
        tables: &SurfaceBuffers,
    ) -> Result<Option<Self>, KeyleafError> {
        let (Some(stage), Some(pose)) = (passes.stage("pose"), surface.pose_tables()) else {
            return Ok(None);
        };
        let limit = device.limits().max_storage_buffer_binding_size;
        for (name, items) in [
            ("the lists of a moving surface", pose.words.len()),
            ("the weights of a moving surface", pose.rows.len()),
            ("what is kept of a moving surface between its passes", pose.scratch),
        ] {
            let bytes = 4 * items as u64;
            if bytes > limit {
                return Err(KeyleafError::BeyondLimits {
                    buffer: name,
                    what: "words",
                    items: items as u64,
                    bytes,
                    limit,
                    most: limit / 4,
                });
            }
        }
        let storage = wgpu::BufferUsages::STORAGE;
        let params = buffer(device, "keyleaf.pose.params", &pose.params, wgpu::BufferUsages::UNIFORM);
        let words = buffer(device, "keyleaf.pose.words", bytemuck::cast_slice(&pose.words), storage);
        let rows = buffer(device, "keyleaf.pose.rows", bytemuck::cast_slice(&pose.rows), storage);
        let sized = |label, bytes: u64| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: bytes,
                usage: storage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let cage = sized("keyleaf.pose.cage", 16 * pose.vertices as u64);
        let scratch = sized("keyleaf.pose.scratch", 4 * pose.scratch as u64);
        let buffers = [&params, &words, &rows, &cage, &tables.a, &tables.b, &scratch];
        let resources: Vec<_> = (0..)
            .zip(buffers)
            .map(|(number, buffer)| (number, buffer.as_entire_binding()))
            .collect();
        let own = [&params, &words, &rows, &cage, &scratch];
        Ok(Some(Self {
            group: binding::group(device, "keyleaf.pose", &stage.layout, &resources),
            bytes: own.iter().map(|buffer| buffer.size()).sum(),
            cage,
            vertices: pose.vertices,
            dispatches: pose.dispatches.iter().map(groups).collect(),
            positions: None,
            origin: None,
            is_due: false,
        }))
    }

    /// Takes another pose.
    pub fn set(&mut self, positions: Vec<DVec3>) -> Result<(), KeyleafError> {
        let expected = self.vertices;
        if positions.len() != expected {
            let found = positions.len();
            return Err(KeyleafError::Cage(format!(
                "{found} positions were given, the control mesh has {expected} vertices"
            )));
        }
        if let Some(vertex) = positions.iter().position(|position| !position.is_finite()) {
            return Err(KeyleafError::Cage(format!(
                "the position of vertex {vertex}, counted from 0, is not finite"
            )));
        }
        if self.positions.as_ref() != Some(&positions) {
            self.positions = Some(positions);
            self.origin = None;
        }
        Ok(())
    }

    /// Sends the pose, where it or the origin is another one. Whether the surface changes.
    pub fn write(&mut self, queue: &wgpu::Queue, origin: DVec3) -> bool {
        let Some(positions) = &self.positions else {
            return false;
        };
        if self.origin == Some(origin) {
            return false;
        }
        let relative = |&position: &DVec3| (position - origin).as_vec3().extend(0.0).to_array();
        let floats: Vec<[f32; 4]> = positions.iter().map(relative).collect();
        queue.write_buffer(&self.cage, 0, bytemuck::cast_slice(&floats));
        self.origin = Some(origin);
        self.is_due = true;
        true
    }

    /// Records the pass, if it is due.
    pub fn record(&mut self, stage: &Stage, pass: &mut wgpu::ComputePass<'_>) {
        if !std::mem::take(&mut self.is_due) {
            return;
        }
        pass.set_bind_group(0, &self.group, &[]);
        for (pipeline, &[x, y, z]) in stage.pipelines.iter().zip(&self.dispatches) {
            pass.set_pipeline(pipeline);
            pass.dispatch_workgroups(x, y, z);
        }
    }

    /// Of its own buffers.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }
}
