//! A surface whose control mesh moves: the buffers of its module `pose` (such as
//! `shaders/passes/pose.wgsl`), and when that has to run.

use crate::KeyleafError;
use crate::binding;
use crate::layout;
use crate::passes::{Passes, Stage};
use crate::surface_buffers::{SurfaceBuffers, buffer};
use glam::DVec3;
use keyleaf_surface::gaussian::{Covariance, Symmetric3};
use keyleaf_surface::{PoseDispatch, Surface};

/// The binding of table B, where bounds are.
const BOUNDS: u32 = 5;

fn groups(dispatch: &PoseDispatch) -> [u32; 3] {
    match *dispatch {
        PoseDispatch::Groups(groups) => layout::groups_for(groups, 1),
        PoseDispatch::Invocations(invocations) => layout::groups_for(invocations, layout::GROUP_SIZE),
    }
}

/// A pose of a control mesh.
#[derive(PartialEq)]
struct Pose {
    positions: Vec<DVec3>,
    /// By vertex, if there are covariances: axes, and standard deviations along them.
    axes: Vec<[[f32; 4]; 3]>,
}

impl Pose {
    /// As the GPU reads it: a position, and with covariances the axes behind it, each with the standard deviation of the one that comes next.
    fn entries(&self, origin: DVec3) -> Vec<[f32; 4]> {
        let mut entries = Vec::with_capacity(self.positions.len() + 3 * self.axes.len());
        let mut axes = self.axes.iter();
        for &position in &self.positions {
            let relative = (position - origin).as_vec3();
            match axes.next() {
                Some([x, y, z]) => {
                    let entry = |axis: &[f32; 4], next: f32| [axis[0], axis[1], axis[2], next];
                    entries.push(relative.extend(x[3]).to_array());
                    entries.extend([entry(x, y[3]), entry(y, z[3]), entry(z, 0.0)]);
                }
                None => entries.push(relative.extend(0.0).to_array()),
            }
        }
        entries
    }
}

/// Axes and standard deviations of a covariance (xx, xy, xz, yy, yz, zz), its variances raised to the floor.
fn axes(covariance: [f64; 6], unit: f64) -> Result<[[f32; 4]; 3], String> {
    let (covariance, _) = Covariance::regularised(Symmetric3::from_array(covariance)).map_err(|e| e.to_string())?;
    let (axes, deviations) = covariance.axes();
    let entry = |k: usize| axes[k].as_vec3().extend((deviations[k] / unit) as f32).to_array();
    Ok([0, 1, 2].map(entry))
}

/// Where the control mesh is, and what finds the tables of the surface from it.
pub(crate) struct Posing {
    group: wgpu::BindGroup,
    cage: wgpu::Buffer,
    bytes: u64,
    vertices: usize,
    has_covariances: bool,
    /// Workgroups of each entry point.
    dispatches: Vec<[u32; 3]>,
    /// None while the mesh is at rest, as the tables of the surface have it.
    pose: Option<Pose>,
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
        let cage = sized("keyleaf.pose.cage", 16 * pose.cage_entries() as u64);
        let scratch = sized("keyleaf.pose.scratch", 4 * pose.scratch as u64);
        let finds_bounds = passes.kind.pose.is_some_and(|pose| pose.finds_bounds);
        let buffers = [&params, &words, &rows, &cage, &tables.a, &tables.b, &scratch];
        let resources: Vec<_> = (0..)
            .zip(buffers)
            .filter(|(number, _)| *number != BOUNDS || finds_bounds)
            .map(|(number, buffer)| (number, buffer.as_entire_binding()))
            .collect();
        let own = [&params, &words, &rows, &cage, &scratch];
        Ok(Some(Self {
            group: binding::group(device, "keyleaf.pose", &stage.layout, &resources),
            bytes: own.iter().map(|buffer| buffer.size()).sum(),
            cage,
            vertices: pose.vertices,
            has_covariances: pose.has_covariances,
            dispatches: pose.dispatches.iter().map(groups).collect(),
            pose: None,
            origin: None,
            is_due: false,
        }))
    }

    /// Takes another pose; covariances are in the order xx, xy, xz, yy, yz, zz.
    pub fn set(&mut self, positions: Vec<DVec3>, covariances: Option<&[[f64; 6]]>) -> Result<(), KeyleafError> {
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
        let axes = self.axes(covariances)?;
        let pose = Pose { positions, axes };
        if self.pose.as_ref() != Some(&pose) {
            self.pose = Some(pose);
            self.origin = None;
        }
        Ok(())
    }

    /// Of all vertices, in a unit in which the largest standard deviation is about 1: a common factor changes nothing.
    fn axes(&self, covariances: Option<&[[f64; 6]]>) -> Result<Vec<[[f32; 4]; 3]>, KeyleafError> {
        let (expected, found) = (self.vertices, covariances.map_or(0, <[_]>::len));
        match covariances {
            None if !self.has_covariances => return Ok(Vec::new()),
            None => {
                return Err(KeyleafError::Cage(
                    "its vertices have covariances, which were not given".to_owned(),
                ));
            }
            Some(_) if !self.has_covariances => {
                return Err(KeyleafError::Cage(
                    "its vertices have no covariances, but some were given".to_owned(),
                ));
            }
            Some(_) if found != expected => {
                return Err(KeyleafError::Cage(format!(
                    "{found} covariances were given, the control mesh has {expected} vertices"
                )));
            }
            Some(_) => {}
        }
        let covariances = covariances.unwrap_or_default();
        let variances = covariances.iter().flat_map(|c| [c[0], c[3], c[5]]);
        let unit = variances.filter(|x| x.is_finite()).fold(0.0, f64::max).sqrt();
        let of_vertex = |(vertex, &covariance): (usize, &[f64; 6])| {
            axes(covariance, unit).map_err(|defect| {
                KeyleafError::Cage(format!(
                    "the covariance of vertex {vertex}, counted from 0, is none: {defect}"
                ))
            })
        };
        covariances.iter().enumerate().map(of_vertex).collect()
    }

    /// Sends the pose, where it or the origin is another one. Whether the surface changes.
    pub fn write(&mut self, queue: &wgpu::Queue, origin: DVec3) -> bool {
        let Some(pose) = &self.pose else {
            return false;
        };
        if self.origin == Some(origin) {
            return false;
        }
        queue.write_buffer(&self.cage, 0, bytemuck::cast_slice(&pose.entries(origin)));
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
