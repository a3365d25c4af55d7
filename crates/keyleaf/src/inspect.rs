//! Evaluating the surface outside a frame, by the very WGSL that draws it: the vertices of leaves for export and checks, and given
//! points for `eval`. These calls wait for the device.

use crate::binding::{self, Binding};
use crate::draw::write_uniform;
use crate::grid::BaseGrid;
use crate::layout::groups_for;
use crate::module::shader_module;
use crate::passes::Kind;
use crate::read_back::map;
use crate::settings::Morph;
use crate::surface_buffers::surface_layout;
use crate::{KeyleafError, Quadtree};
use glam::{UVec4, Vec3};
use keyleaf_key::RootPoint;
use wgpu::util::DeviceExt;

/// Position and derivatives as the GPU computes them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GpuFrame {
    /// Object space, relative to [`Quadtree::origin`].
    pub position: Vec3,
    /// Derivative in u.
    pub du: Vec3,
    /// Derivative in v.
    pub dv: Vec3,
    /// Unit normal.
    pub normal: Vec3,
}

/// Vertices of one or more leaves.
#[derive(Debug, Clone, Default)]
pub struct Emitted {
    /// Object space, relative to [`Quadtree::origin`]; the vertices of [`BaseGrid`] leaf by leaf.
    pub positions: Vec<[f32; 3]>,
    /// Unit normals.
    pub normals: Vec<[f32; 3]>,
}

/// Pipelines that evaluate a kind of surface. Device-long.
#[derive(Debug)]
pub struct Inspector {
    emit: (wgpu::ComputePipeline, wgpu::BindGroupLayout),
    evaluate: (wgpu::ComputePipeline, wgpu::BindGroupLayout),
    morph: Morph,
}

/// The most bytes that one dispatch writes; larger jobs go in pieces.
const PIECE: u64 = 64 << 20;

impl Inspector {
    /// WGSL files, without the surface.
    pub const FILES: [&'static str; 2] = ["draw/emit.wgsl", "draw/evaluate.wgsl"];

    /// Compiles the pipelines.
    ///
    /// # Errors
    /// [`KeyleafError::Compose`] if a shader file is missing.
    pub fn new(device: &wgpu::Device, kind: &Kind) -> Result<Self, KeyleafError> {
        use Binding::{Read, Uniform, Write};
        let surface = surface_layout(device, kind.surface)?;
        let make = |files: &[&'static str], entry: &str, bindings: &[Binding]| -> Result<_, KeyleafError> {
            let label = format!("keyleaf.{entry}");
            let module = shader_module(device, files)?;
            let layout = binding::layout(device, &label, wgpu::ShaderStages::COMPUTE, bindings);
            let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(&label),
                bind_group_layouts: &[Some(&layout), Some(&surface)],
                immediate_size: 0,
            });
            let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(&label),
                layout: Some(&pipeline_layout),
                module: &module,
                entry_point: Some(entry),
                compilation_options: Default::default(),
                cache: None,
            });
            Ok((pipeline, layout))
        };
        let [emit, evaluate] = Self::FILES;
        let mut emission = vec![Uniform, Read, Read, Read, Read, Write];
        if kind.morph != Morph::None {
            emission.push(Uniform);
        }
        let drawing = [&[emit], &kind.drawing_files()[..]].concat();
        Ok(Self {
            emit: make(&drawing, "emit", &emission)?,
            evaluate: make(&[evaluate, kind.surface], "evaluate", &[Uniform, Read, Write])?,
            morph: kind.morph,
        })
    }

    /// The vertices of the leaves in the given slots, on the grid of 4^k triangles that they are drawn with. A slot whose leaf is the
    /// even half of a pair gives the triangle of the pair.
    ///
    /// # Errors
    /// [`KeyleafError::ReadBack`] if the device is lost.
    pub fn emit(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        quadtree: &Quadtree,
        slots: &[u32],
    ) -> Result<Emitted, KeyleafError> {
        let k = quadtree.settings().base_grid;
        let grid = BaseGrid::of(quadtree.settings()).vertices;
        let a_leaf = 32 * grid.len() as u64;
        let piece = (PIECE.min(device.limits().max_storage_buffer_binding_size) / a_leaf).max(1) as usize;
        let buffers = quadtree.buffers();
        let grid_buffer = storage(device, "keyleaf.emit.grid", bytemuck::cast_slice(&grid));
        let mut all = Emitted::default();
        for part in slots.chunks(piece) {
            let emission = UVec4::new(0, part.len() as u32, grid.len() as u32, k);
            let slots = storage(device, "keyleaf.emit.slots", bytemuck::cast_slice(part));
            let mut inputs = vec![
                (1, &buffers.leaves),
                (2, &buffers.state),
                (3, &slots),
                (4, &grid_buffer),
            ];
            if self.morph != Morph::None {
                inputs.push((6, &buffers.frame));
            }
            let words = self.run(
                device,
                queue,
                &self.emit,
                quadtree,
                emission,
                &inputs,
                (5, a_leaf * part.len() as u64),
                part.len() as u32 * grid.len() as u32,
            )?;
            for [position, normal] in words.as_chunks::<2>().0 {
                all.positions.push([position[0], position[1], position[2]]);
                all.normals.push([normal[0], normal[1], normal[2]]);
            }
        }
        Ok(all)
    }

    /// The surface at given points.
    ///
    /// # Errors
    /// [`KeyleafError::ReadBack`] if the device is lost.
    pub fn evaluate(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        quadtree: &Quadtree,
        points: &[RootPoint],
    ) -> Result<Vec<GpuFrame>, KeyleafError> {
        let mut frames = Vec::with_capacity(points.len());
        for part in points.chunks((PIECE / 64) as usize) {
            let requests: Vec<[u32; 4]> = part.iter().map(|p| [p.face, p.root, p.x, p.y]).collect();
            let requests = storage(device, "keyleaf.evaluate.requests", bytemuck::cast_slice(&requests));
            let count = part.len() as u32;
            let words = self.run(
                device,
                queue,
                &self.evaluate,
                quadtree,
                UVec4::new(count, 0, 0, 0),
                &[(1, &requests)],
                (2, 64 * u64::from(count)),
                count,
            )?;
            let vector = |w: [f32; 4]| Vec3::new(w[0], w[1], w[2]);
            frames.extend(
                words
                    .as_chunks::<4>()
                    .0
                    .iter()
                    .map(|[position, du, dv, normal]| GpuFrame {
                        position: vector(*position),
                        du: vector(*du),
                        dv: vector(*dv),
                        normal: vector(*normal),
                    }),
            );
        }
        Ok(frames)
    }

    /// One dispatch over `items`, whose output at (number, bytes) is read back as vectors.
    #[expect(clippy::too_many_arguments, reason = "a private step of two public calls")]
    fn run(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        (pipeline, layout): &(wgpu::ComputePipeline, wgpu::BindGroupLayout),
        quadtree: &Quadtree,
        uniform: UVec4,
        inputs: &[(u32, &wgpu::Buffer)],
        (output_binding, bytes): (u32, u64),
        items: u32,
    ) -> Result<Vec<[f32; 4]>, KeyleafError> {
        use wgpu::BufferUsages as U;
        let make = |label, size, usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let output = make("keyleaf.inspect.output", bytes, U::STORAGE | U::COPY_SRC);
        let staging = make("keyleaf.inspect.staging", bytes, U::MAP_READ | U::COPY_DST);
        let parameters = make("keyleaf.inspect.parameters", 16, U::UNIFORM | U::COPY_DST);
        write_uniform(queue, &parameters, &uniform);
        let mut resources = vec![
            (0, parameters.as_entire_binding()),
            (output_binding, output.as_entire_binding()),
        ];
        resources.extend(inputs.iter().map(|(n, buffer)| (*n, buffer.as_entire_binding())));
        let group = binding::group(device, "keyleaf.inspect", layout, &resources);
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor {
            label: Some("keyleaf.inspect"),
        });
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some("keyleaf.inspect"),
                timestamp_writes: None,
            });
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.set_bind_group(1, quadtree.surface_group(), &[]);
            let [x, y, z] = groups_for(items, 64);
            pass.dispatch_workgroups(x, y, z);
        }
        encoder.copy_buffer_to_buffer(&output, 0, &staging, 0, Some(bytes));
        queue.submit([encoder.finish()]);
        Ok(bytemuck::pod_collect_to_vec(&map(
            device,
            "evaluated points",
            &staging,
        )?))
    }
}

fn storage(device: &wgpu::Device, label: &str, contents: &[u8]) -> wgpu::Buffer {
    device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some(label),
        contents,
        usage: wgpu::BufferUsages::STORAGE,
    })
}
