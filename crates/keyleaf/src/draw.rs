//! Drawing the visible leaves of a quadtree, and the sky behind them, into a pass of the caller's.
//!
//! # Practice
//! One indirect draw a quadtree: instances are visible leaves, vertices the base grid. Depth is reversed (near = 1, far = 0), clear it
//! to 0. [`Target`] says what the pass renders to.

use crate::binding::{self, Binding};
use crate::colour_texture::colour_texture;
use crate::grid::GridBuffers;
use crate::layout::arguments;
use crate::module::shader_module;
use crate::passes::Kind;
use crate::settings::BackFaces;
use crate::shading::{Background, Channel, Shading};
use crate::surface_buffers::surface_layout;
use crate::{KeyleafError, Quadtree, View};
use encase::ShaderType;
use glam::{Vec2, Vec3};
use wgpu::util::DeviceExt;

/// What the pass renders to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Target {
    /// Format of the colour attachment.
    pub colour: wgpu::TextureFormat,
    /// Format of the depth attachment.
    pub depth: wgpu::TextureFormat,
    /// Samples a pixel.
    pub samples: u32,
}

/// A colour texture in sRGB bytes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ColourTexture {
    /// Texels across.
    pub width: u32,
    /// Texels down.
    pub height: u32,
    /// Four bytes a texel, row by row from the top.
    pub rgba: Vec<u8>,
}

/// What a mesh has at one of its corners.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Attribute {
    /// Object space; zero: the surface's own.
    pub normal: [f32; 3],
    /// Four bytes, linear, red lowest.
    pub colour: u32,
    /// Texture coordinates, (0, 0) at the top left.
    pub uv: [f32; 2],
    /// Padding.
    pub unused: [f32; 2],
}

/// What a quadtree is drawn with besides its geometry.
#[derive(Debug, Clone, Default)]
pub struct Look {
    /// One a half-edge, in the order of the topology, then one a face; empty if no channel has attributes.
    pub attributes: Vec<Attribute>,
    /// The base-colour texture.
    pub texture: Option<ColourTexture>,
}

/// The pipeline of one kind of surface, channel and target. Device-long.
#[derive(Debug)]
pub struct LeafPipeline {
    pipeline: wgpu::RenderPipeline,
    leaf_layout: wgpu::BindGroupLayout,
    look_layout: wgpu::BindGroupLayout,
    channel: Channel,
}

impl LeafPipeline {
    /// Compiles it.
    ///
    /// # Errors
    /// [`KeyleafError::Compose`] if a shader file is missing.
    pub fn new(device: &wgpu::Device, kind: &Kind, channel: Channel, target: Target) -> Result<Self, KeyleafError> {
        let mut files = channel.files();
        files.extend(kind.drawing_files());
        let shader = shader_module(device, &files)?;
        let leaf_layout = binding::layout(
            device,
            "keyleaf.draw.leaves",
            wgpu::ShaderStages::VERTEX,
            &[Binding::Uniform, Binding::Read, Binding::Read, Binding::Read],
        );
        let look = match (channel.has_attributes(), channel.has_texture()) {
            (false, _) => &[Binding::Uniform][..],
            (true, false) => &[Binding::Uniform, Binding::Read],
            (true, true) => &[Binding::Uniform, Binding::Read, Binding::Colour, Binding::Sampler],
        };
        let look_layout = binding::layout(device, "keyleaf.draw.look", wgpu::ShaderStages::VERTEX_FRAGMENT, look);
        let surface = surface_layout(device, kind.surface)?;
        let is_sum = channel == Channel::Overdraw;
        let hides = if is_sum {
            wgpu::CompareFunction::Always
        } else {
            wgpu::CompareFunction::Greater
        };
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("keyleaf.draw"),
            bind_group_layouts: &[Some(&leaf_layout), Some(&surface), Some(&look_layout)],
            immediate_size: 0,
        });
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("keyleaf.draw"),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &shader,
                entry_point: Some("vertex"),
                compilation_options: Default::default(),
                buffers: &[Some(wgpu::VertexBufferLayout {
                    array_stride: 4,
                    step_mode: wgpu::VertexStepMode::Vertex,
                    attributes: &[wgpu::VertexAttribute {
                        format: wgpu::VertexFormat::Uint32,
                        offset: 0,
                        shader_location: 0,
                    }],
                })],
            },
            primitive: wgpu::PrimitiveState {
                cull_mode: (kind.back_faces != BackFaces::Drawn).then_some(wgpu::Face::Back),
                ..Default::default()
            },
            depth_stencil: Some(wgpu::DepthStencilState {
                depth_write_enabled: Some(!is_sum),
                ..depth(target, hides)
            }),
            multisample: wgpu::MultisampleState {
                count: target.samples,
                ..Default::default()
            },
            fragment: Some(wgpu::FragmentState {
                module: &shader,
                entry_point: Some("fragment"),
                compilation_options: Default::default(),
                targets: &[Some(wgpu::ColorTargetState {
                    blend: is_sum.then_some(SUM),
                    ..target.colour.into()
                })],
            }),
            multiview_mask: None,
            cache: None,
        });
        Ok(Self {
            pipeline,
            leaf_layout,
            look_layout,
            channel,
        })
    }
}

/// Adds what is drawn to what is there.
const SUM: wgpu::BlendState = {
    let add = wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::One,
        dst_factor: wgpu::BlendFactor::One,
        operation: wgpu::BlendOperation::Add,
    };
    wgpu::BlendState { color: add, alpha: add }
};

fn depth(target: Target, compare: wgpu::CompareFunction) -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: target.depth,
        depth_write_enabled: Some(true),
        depth_compare: Some(compare),
        stencil: Default::default(),
        bias: Default::default(),
    }
}

/// Draws one quadtree with one pipeline: its bind groups, base grid and light.
#[derive(Debug)]
pub struct LeafDraw {
    leaves: wgpu::BindGroup,
    look: wgpu::BindGroup,
    shading: wgpu::Buffer,
    grid: GridBuffers,
    bytes: u64,
}

impl LeafDraw {
    /// Binds a quadtree, with its look, to a pipeline of its kind.
    pub fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        pipeline: &LeafPipeline,
        quadtree: &Quadtree,
        look: &Look,
    ) -> Self {
        let buffers = quadtree.buffers();
        let leaves = binding::group(
            device,
            "keyleaf.draw.leaves",
            &pipeline.leaf_layout,
            &[
                (0, buffers.frame.as_entire_binding()),
                (1, buffers.leaves.as_entire_binding()),
                (2, buffers.state.as_entire_binding()),
                (3, buffers.lists.as_entire_binding()),
            ],
        );
        let shading = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("keyleaf.draw.shading"),
            size: Shading::min_size().get(),
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut bytes = shading.size();
        let attributes = pipeline.channel.has_attributes().then(|| {
            let nothing = [Attribute {
                normal: [0.0; 3],
                colour: u32::MAX,
                uv: [0.0; 2],
                unused: [0.0; 2],
            }];
            let all = if look.attributes.is_empty() {
                &nothing[..]
            } else {
                &look.attributes
            };
            let buffer = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some("keyleaf.draw.attributes"),
                contents: bytemuck::cast_slice(all),
                usage: wgpu::BufferUsages::STORAGE,
            });
            bytes += buffer.size();
            buffer
        });
        let texture = pipeline.channel.has_texture().then(|| {
            let white = ColourTexture {
                width: 1,
                height: 1,
                rgba: vec![255; 4],
            };
            let texture = look.texture.as_ref().unwrap_or(&white);
            bytes += texture.rgba.len() as u64;
            colour_texture(device, queue, texture)
        });
        let mut resources = vec![(0, shading.as_entire_binding())];
        resources.extend(attributes.iter().map(|b| (1, b.as_entire_binding())));
        if let Some((view, sampler)) = &texture {
            resources.push((2, wgpu::BindingResource::TextureView(view)));
            resources.push((3, wgpu::BindingResource::Sampler(sampler)));
        }
        let look = binding::group(device, "keyleaf.draw.look", &pipeline.look_layout, &resources);
        Self {
            leaves,
            look,
            shading,
            grid: GridBuffers::new(device, quadtree.settings()),
            bytes,
        }
    }

    /// Writes the light of this frame, and the base grid if its setting has changed.
    pub fn prepare(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, quadtree: &Quadtree, shading: &Shading) {
        write_uniform(queue, &self.shading, shading);
        if !self.grid.is_of(quadtree.settings()) {
            self.grid = GridBuffers::new(device, quadtree.settings());
        }
    }

    /// Records the draw.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, pipeline: &LeafPipeline, quadtree: &Quadtree) {
        pass.set_pipeline(&pipeline.pipeline);
        pass.set_bind_group(0, &self.leaves, &[]);
        pass.set_bind_group(1, quadtree.surface_group(), &[]);
        pass.set_bind_group(2, &self.look, &[]);
        pass.set_vertex_buffer(0, self.grid.vertices.slice(..));
        pass.set_index_buffer(self.grid.indices.slice(..), wgpu::IndexFormat::Uint16);
        pass.draw_indexed_indirect(&quadtree.buffers().arguments, arguments::DRAW);
    }

    /// Bytes of its buffers and textures.
    pub fn bytes(&self) -> u64 {
        self.bytes + self.grid.vertices.size() + self.grid.indices.size()
    }
}

/// Draws the sky where nothing else is. Draw it last.
#[derive(Debug)]
pub struct Sky {
    pipeline: wgpu::RenderPipeline,
    background: wgpu::Buffer,
    shading: wgpu::Buffer,
    groups: [wgpu::BindGroup; 2],
    nothing: wgpu::BindGroup,
}

impl Sky {
    /// WGSL files of the sky.
    pub const FILES: [&'static str; 1] = ["draw/sky.wgsl"];

    /// Compiles it for a target.
    ///
    /// # Errors
    /// [`KeyleafError::Compose`] if a shader file is missing.
    pub fn new(device: &wgpu::Device, target: Target) -> Result<Self, KeyleafError> {
        let shader = shader_module(device, &Self::FILES)?;
        let layout = binding::layout(
            device,
            "keyleaf.sky",
            wgpu::ShaderStages::VERTEX_FRAGMENT,
            &[Binding::Uniform],
        );
        let empty = binding::layout(device, "keyleaf.sky.nothing", wgpu::ShaderStages::NONE, &[]);
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("keyleaf.sky"),
            bind_group_layouts: &[Some(&layout), Some(&empty), Some(&layout)],
            immediate_size: 0,
        });
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("keyleaf.sky"),
            layout: Some(&pipeline_layout),
            vertex: wgpu::VertexState {
                module: &shader,
                entry_point: Some("sky_vertex"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(depth(target, wgpu::CompareFunction::GreaterEqual)),
            multisample: wgpu::MultisampleState {
                count: target.samples,
                ..Default::default()
            },
            fragment: Some(wgpu::FragmentState {
                module: &shader,
                entry_point: Some("sky_fragment"),
                compilation_options: Default::default(),
                targets: &[Some(target.colour.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        let uniform = |label, size| {
            let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let background = uniform("keyleaf.sky.background", Background::min_size().get());
        let shading = uniform("keyleaf.sky.shading", Shading::min_size().get());
        let group =
            |buffer: &wgpu::Buffer| binding::group(device, "keyleaf.sky", &layout, &[(0, buffer.as_entire_binding())]);
        let groups = [group(&background), group(&shading)];
        let nothing = binding::group(device, "keyleaf.sky.nothing", &empty, &[]);
        Ok(Self {
            pipeline,
            background,
            shading,
            groups,
            nothing,
        })
    }

    /// Writes the view and light of this frame.
    pub fn prepare(&self, queue: &wgpu::Queue, view: &View, shading: &Shading) {
        write_uniform(queue, &self.background, &Background::new(view));
        write_uniform(queue, &self.shading, shading);
    }

    /// Records the draw.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.groups[0], &[]);
        pass.set_bind_group(1, &self.nothing, &[]);
        pass.set_bind_group(2, &self.groups[1], &[]);
        pass.draw(0..3, 0..1);
    }
}

pub(crate) fn write_uniform<T: ShaderType + encase::internal::WriteInto>(
    queue: &wgpu::Queue,
    buffer: &wgpu::Buffer,
    value: &T,
) {
    let mut bytes = encase::UniformBuffer::new(Vec::new());
    if bytes.write(value).is_ok() {
        queue.write_buffer(buffer, 0, &bytes.into_inner());
    }
}

/// Attributes of a mesh's corners and of the centres of its faces, from what the file gave, in the order of the faces.
pub fn attributes(
    corner_counts: &[u32],
    uvs: Option<&[[f32; 2]]>,
    normals: Option<&[[f32; 3]]>,
    colours: Option<&[[f32; 4]]>,
) -> Vec<Attribute> {
    let pack = |c: [f32; 4]| u32::from_le_bytes(c.map(|x| (x.clamp(0.0, 1.0) * 255.0).round() as u8));
    let make = |normal: Vec3, colour: [f32; 4], uv: Vec2| Attribute {
        normal: normal.to_array(),
        colour: pack(colour),
        uv: uv.to_array(),
        unused: [0.0; 2],
    };
    let corners: usize = corner_counts.iter().map(|n| *n as usize).sum();
    let normal = |i: usize| normals.map_or(Vec3::ZERO, |all| Vec3::from(all[i]));
    let uv = |i: usize| uvs.map_or(Vec2::ZERO, |all| Vec2::from(all[i]));
    let colour = |i: usize| colours.map_or([1.0; 4], |all| all[i]);
    let mut all: Vec<_> = (0..corners).map(|i| make(normal(i), colour(i), uv(i))).collect();
    let mut first = 0;
    for count in corner_counts.iter().map(|n| *n as usize) {
        let range = first..first + count;
        let n = count as f32;
        let mean_colour = range
            .clone()
            .fold([0.0; 4], |sum, i| std::array::from_fn(|c| sum[c] + colour(i)[c] / n));
        all.push(make(
            range.clone().map(normal).sum::<Vec3>().normalize_or_zero(),
            mean_colour,
            range.map(uv).sum::<Vec2>() / n,
        ));
        first += count;
    }
    all
}
