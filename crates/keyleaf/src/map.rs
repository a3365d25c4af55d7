//! A map of a quadtree: all its leaves, whether the view sees them or not, as one triangle each, seen from anywhere and coloured by
//! level. For tools: it costs three evaluations of the surface a leaf.

use crate::binding::{self, Binding};
use crate::draw::{Target, write_uniform};
use crate::module::shader_module;
use crate::passes::Kind;
use crate::surface_buffers::surface_layout;
use crate::view::Frame;
use crate::{KeyleafError, Quadtree, Settings, View};
use encase::ShaderType;

/// The pipeline of one kind of surface and target. Device-long.
#[derive(Debug)]
pub struct MapPipeline {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
}

impl MapPipeline {
    /// WGSL files, without the surface.
    pub const FILES: [&'static str; 1] = ["draw/map.wgsl"];

    /// Compiles it.
    ///
    /// # Errors
    /// [`KeyleafError::Compose`] if a shader file is missing.
    pub fn new(device: &wgpu::Device, kind: &Kind, target: Target) -> Result<Self, KeyleafError> {
        let [file] = Self::FILES;
        let shader = shader_module(device, &[file, kind.surface])?;
        let bindings = [Binding::Uniform, Binding::Read, Binding::Read];
        let layout = binding::layout(device, "keyleaf.map", wgpu::ShaderStages::VERTEX, &bindings);
        let surface = surface_layout(device, kind.surface)?;
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("keyleaf.map"),
            bind_group_layouts: &[Some(&layout), Some(&surface)],
            immediate_size: 0,
        });
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("keyleaf.map"),
            layout: Some(&pipeline_layout),
            vertex: wgpu::VertexState {
                module: &shader,
                entry_point: Some("map_vertex"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: target.depth,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Greater),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState {
                count: target.samples,
                ..Default::default()
            },
            fragment: Some(wgpu::FragmentState {
                module: &shader,
                entry_point: Some("map_fragment"),
                compilation_options: Default::default(),
                targets: &[Some(target.colour.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        Ok(Self { pipeline, layout })
    }
}

/// The map of one quadtree: its own view of the same leaves.
#[derive(Debug)]
pub struct LeafMap {
    group: wgpu::BindGroup,
    frame: wgpu::Buffer,
}

impl LeafMap {
    /// Binds a quadtree to a pipeline of its kind.
    pub fn new(device: &wgpu::Device, pipeline: &MapPipeline, quadtree: &Quadtree) -> Self {
        let frame = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("keyleaf.map.frame"),
            size: Frame::min_size().get(),
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let buffers = quadtree.buffers();
        let group = binding::group(
            device,
            "keyleaf.map",
            &pipeline.layout,
            &[
                (0, frame.as_entire_binding()),
                (1, buffers.leaves.as_entire_binding()),
                (2, buffers.state.as_entire_binding()),
            ],
        );
        Self { group, frame }
    }

    /// Writes the view of the map.
    pub fn prepare(&self, queue: &wgpu::Queue, quadtree: &Quadtree, view: &View) {
        let settings = Settings {
            base_grid: 0,
            ..*quadtree.settings()
        };
        let frame = Frame::new(view, quadtree.world_from_object(), quadtree.origin(), &settings);
        write_uniform(queue, &self.frame, &frame);
    }

    /// Records the draw of the first `leaves` slots: [`Statistics::leaves`](crate::Statistics::leaves), which may be some frames old.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, pipeline: &MapPipeline, quadtree: &Quadtree, leaves: u32) {
        pass.set_pipeline(&pipeline.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.set_bind_group(1, quadtree.surface_group(), &[]);
        pass.draw(0..3, 0..leaves.min(quadtree.settings().capacity));
    }
}
