//! Runs a surface module on an adapter: points to frames, leaves to bounds.

use glam::Vec3;
use keyleaf_key::{Place, RootPoint};
use keyleaf_surface::{SurfaceTables, TextureData};
use wgpu::util::DeviceExt;

pub struct Device {
    device: wgpu::Device,
    queue: wgpu::Queue,
}

/// `surface_point` and `surface_frame` at a point.
#[derive(Clone, Copy, Debug)]
pub struct GpuFrame {
    pub point: Vec3,
    pub position: Vec3,
    pub du: Vec3,
    pub dv: Vec3,
    pub normal: Vec3,
}

/// `surface_bound` of a leaf.
#[derive(Clone, Copy, Debug)]
pub struct GpuBound {
    pub centre: Vec3,
    pub radius: f32,
    pub size: f32,
    pub guard: f32,
    pub deviation: f32,
    pub pair_deviation: f32,
}

impl GpuBound {
    pub fn bits(&self) -> [u32; 7] {
        let c = self.centre;
        [c.x, c.y, c.z, self.radius, self.size, self.guard, self.deviation].map(f32::to_bits)
    }
}

pub struct Evaluated {
    pub frames: Vec<GpuFrame>,
    pub bounds: Vec<GpuBound>,
}

const ENTRY_POINTS: &str = "
@group(0) @binding(0) var<storage, read> places: array<Place>;
@group(0) @binding(1) var<storage, read_write> results: array<f32>;

fn store(slot: u32, v: vec3f) {
    results[slot] = v.x;
    results[slot + 1u] = v.y;
    results[slot + 2u] = v.z;
}

@compute @workgroup_size(64)
fn frames(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&places) { return; }
    let p = places[id.x];
    let at = FaceCoord(p.root, p.x, p.y);
    store(16u * id.x, surface_point(p.face, at));
    let frame = surface_frame(p.face, at);
    store(16u * id.x + 3u, frame.position);
    store(16u * id.x + 6u, frame.du);
    store(16u * id.x + 9u, frame.dv);
    store(16u * id.x + 12u, frame.normal);
}

@compute @workgroup_size(64)
fn bounds(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&places) { return; }
    let bound = surface_bound(places[id.x]);
    store(16u * id.x, bound.centre);
    store(16u * id.x + 3u, vec3f(bound.radius, bound.size, bound.guard));
    results[16u * id.x + 6u] = bound.deviation;
    results[16u * id.x + 7u] = bound.pair_deviation;
}
";

impl Device {
    /// None if there is no adapter.
    pub fn new() -> Option<Self> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default())).ok()?;
        println!("{:?}", adapter.get_info().name);
        let (device, queue) =
            pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default())).expect("a device");
        Some(Self { device, queue })
    }

    fn storage(&self, words: &[u32]) -> wgpu::Buffer {
        self.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: None,
            contents: bytemuck::cast_slice(words),
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        })
    }

    fn texture(&self, data: &TextureData) -> wgpu::TextureView {
        let format = if data.channels == 1 {
            wgpu::TextureFormat::R32Float
        } else {
            wgpu::TextureFormat::Rgba32Float
        };
        let descriptor = wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d {
                width: data.width,
                height: data.height,
                depth_or_array_layers: 1,
            },
            mip_level_count: data.mips.len() as u32,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        };
        let bytes: Vec<u8> = data
            .mips
            .iter()
            .flat_map(|mip| bytemuck::cast_slice(mip).iter().copied())
            .collect();
        let order = wgpu::util::TextureDataOrder::LayerMajor;
        let texture = self
            .device
            .create_texture_with_data(&self.queue, &descriptor, order, &bytes);
        texture.create_view(&wgpu::TextureViewDescriptor::default())
    }

    fn read(&self, buffer: &wgpu::Buffer) -> Vec<f32> {
        let copy = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: buffer.size(),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = self
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_buffer_to_buffer(buffer, 0, &copy, 0, buffer.size());
        self.queue.submit([encoder.finish()]);
        copy.slice(..)
            .map_async(wgpu::MapMode::Read, |result| result.expect("mapped"));
        self.device.poll(wgpu::PollType::wait_indefinitely()).expect("finished");
        let bytes = copy.slice(..).get_mapped_range().expect("mapped");
        bytemuck::pod_collect_to_vec(&bytes)
    }
}

fn entry(binding: u32, ty: wgpu::BindingType) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty,
        count: None,
    }
}

fn buffer(ty: wgpu::BufferBindingType) -> wgpu::BindingType {
    wgpu::BindingType::Buffer {
        ty,
        has_dynamic_offset: false,
        min_binding_size: None,
    }
}

fn group(
    device: &Device,
    bindings: &[(u32, wgpu::BindingType, wgpu::BindingResource<'_>)],
) -> (wgpu::BindGroupLayout, wgpu::BindGroup) {
    let layout_entries: Vec<_> = bindings.iter().map(|(binding, ty, _)| entry(*binding, *ty)).collect();
    let layout = device
        .device
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: None,
            entries: &layout_entries,
        });
    let entries: Vec<_> = bindings
        .iter()
        .map(|(binding, _, resource)| wgpu::BindGroupEntry {
            binding: *binding,
            resource: resource.clone(),
        })
        .collect();
    let group = device.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &layout,
        entries: &entries,
    });
    (layout, group)
}

/// Evaluates `points` and `leaves` with the surface module `source`.
pub fn evaluate(
    device: &Device,
    source: &str,
    tables: &SurfaceTables,
    topology: &[u32],
    points: &[RootPoint],
    leaves: &[Place],
) -> Evaluated {
    let source = format!("{source}{ENTRY_POINTS}");
    let module = device.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(source.as_str().into()),
    });
    let params = device.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: &tables.params,
        usage: wgpu::BufferUsages::UNIFORM,
    });
    let storage = buffer(wgpu::BufferBindingType::Storage { read_only: true });
    let buffers = [
        (1, topology.to_vec()),
        (2, bytemuck::cast_slice(&tables.a).to_vec()),
        (3, tables.b.clone()),
    ]
    .map(|(binding, words)| (binding, (!words.is_empty()).then(|| device.storage(&words))));
    let textures = [(4, &tables.heights), (5, &tables.height_bounds)]
        .map(|(binding, data)| (binding, data.as_ref().map(|data| device.texture(data))));
    let mut bindings = vec![(0, buffer(wgpu::BufferBindingType::Uniform), params.as_entire_binding())];
    for (binding, words) in &buffers {
        bindings.extend(
            words
                .as_ref()
                .map(|words| (*binding, storage, words.as_entire_binding())),
        );
    }
    let texture = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    for (binding, view) in &textures {
        bindings.extend(
            view.as_ref()
                .map(|view| (*binding, texture, wgpu::BindingResource::TextureView(view))),
        );
    }
    let (surface_layout, surface) = group(device, &bindings);

    let run = |entry_point: &str, places: &[Place]| -> Vec<f32> {
        if places.is_empty() {
            return Vec::new();
        }
        let input = device.storage(bytemuck::cast_slice(places));
        let output = device.storage(&vec![0; 16 * places.len()]);
        let read_write = buffer(wgpu::BufferBindingType::Storage { read_only: false });
        let (layout, items) = group(
            device,
            &[
                (0, storage, input.as_entire_binding()),
                (1, read_write, output.as_entire_binding()),
            ],
        );
        let layout = device.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(&layout), Some(&surface_layout)],
            immediate_size: 0,
        });
        let pipeline = device.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: Some(&layout),
            module: &module,
            entry_point: Some(entry_point),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let mut encoder = device
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &items, &[]);
        pass.set_bind_group(1, &surface, &[]);
        pass.dispatch_workgroups((places.len() as u32).div_ceil(64), 1, 1);
        drop(pass);
        device.queue.submit([encoder.finish()]);
        device.read(&output)
    };

    let as_place = |at: &RootPoint| Place {
        face: at.face,
        root: at.root,
        x: at.x,
        y: at.y,
        orientation: 0,
        level: 0,
    };
    let vector = |words: &[f32], first: usize| Vec3::new(words[first], words[first + 1], words[first + 2]);
    let frames = run("frames", &points.iter().map(as_place).collect::<Vec<_>>());
    let frame = |w: &[f32]| GpuFrame {
        point: vector(w, 0),
        position: vector(w, 3),
        du: vector(w, 6),
        dv: vector(w, 9),
        normal: vector(w, 12),
    };
    let bounds = run("bounds", leaves);
    let bound = |w: &[f32]| GpuBound {
        centre: vector(w, 0),
        radius: w[3],
        size: w[4],
        guard: w[5],
        deviation: w[6],
        pair_deviation: w[7],
    };
    Evaluated {
        frames: frames.chunks(16).map(frame).collect(),
        bounds: bounds.chunks(16).map(bound).collect(),
    }
}
