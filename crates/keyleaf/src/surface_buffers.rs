//! A surface on the GPU: its tables, and bind group 1 of every pass that needs the surface or the topology.

use crate::KeyleafError;
use crate::binding::{self, Binding};
use glam::DVec3;
use keyleaf_surface::{Surface, SurfaceTables, TextureData};
use wgpu::util::DeviceExt;

/// Bindings of group 1: parameters, topology, tables A and B, heights, bounds of heights.
const BINDINGS: [Binding; 6] = [
    Binding::Uniform,
    Binding::Read,
    Binding::Read,
    Binding::Read,
    Binding::Texels,
    Binding::Texels,
];

/// The layout of group 1 for the bindings that a surface's shader declares.
pub(crate) fn surface_layout(device: &wgpu::Device, file: &str) -> Result<wgpu::BindGroupLayout, KeyleafError> {
    let bindings: Vec<Binding> = declared(file)?
        .iter()
        .zip(BINDINGS)
        .map(|(is, b)| if *is { b } else { Binding::Absent })
        .collect();
    let stages = wgpu::ShaderStages::COMPUTE | wgpu::ShaderStages::VERTEX;
    Ok(binding::layout(device, "keyleaf.surface", stages, &bindings))
}

/// Which bindings of group 1 a surface's shader declares, the topology in any case.
fn declared(file: &str) -> Result<[bool; BINDINGS.len()], KeyleafError> {
    let source = keyleaf_shaders::compose(&[file])?;
    let mut all = std::array::from_fn(|i| source.contains(&format!("@group(1) @binding({i})")));
    all[1] = true;
    Ok(all)
}

/// The tables of one surface, relative to one origin.
#[derive(Debug)]
pub(crate) struct SurfaceBuffers {
    pub group: wgpu::BindGroup,
    pub origin: DVec3,
    /// (name, bytes) of each buffer and texture, for `plan`.
    pub sizes: Vec<(&'static str, u64)>,
    params: wgpu::Buffer,
    pub a: wgpu::Buffer,
    pub b: wgpu::Buffer,
}

impl SurfaceBuffers {
    pub fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        layout: &wgpu::BindGroupLayout,
        surface: &dyn Surface,
        origin: DVec3,
    ) -> Result<Self, KeyleafError> {
        let tables = surface.tables(origin);
        let topology = surface.topology().gpu_words();
        check_sizes(device, &tables, topology.len())?;

        let params = buffer(
            device,
            "keyleaf.surface.params",
            &tables.params,
            wgpu::BufferUsages::UNIFORM,
        );
        let topology = buffer(
            device,
            "keyleaf.surface.topology",
            bytemuck::cast_slice(&topology),
            wgpu::BufferUsages::STORAGE,
        );
        let a = buffer(
            device,
            "keyleaf.surface.a",
            bytemuck::cast_slice(&tables.a),
            wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        );
        let b = buffer(
            device,
            "keyleaf.surface.b",
            bytemuck::cast_slice(&tables.b),
            wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        );
        let upload = |label, data: &Option<std::sync::Arc<TextureData>>| {
            data.as_ref().map(|data| texture(device, queue, label, data))
        };
        let heights = upload("keyleaf.surface.heights", &tables.heights);
        let bounds = upload("keyleaf.surface.height_bounds", &tables.height_bounds);

        let declared = declared(surface.shader())?;
        let mut resources = Vec::new();
        for (number, buffer) in [(0, &params), (1, &topology), (2, &a), (3, &b)] {
            if declared[number as usize] {
                resources.push((number, buffer.as_entire_binding()));
            }
        }
        resources.extend(heights.iter().map(|view| (4, wgpu::BindingResource::TextureView(view))));
        resources.extend(bounds.iter().map(|view| (5, wgpu::BindingResource::TextureView(view))));
        let group = binding::group(device, "keyleaf.surface", layout, &resources);

        let bytes = |data: &TextureData| data.mips.iter().map(|mip| 4 * mip.len() as u64).sum();
        let mut sizes = vec![("surface parameters", params.size()), ("topology", topology.size())];
        sizes.extend(declared[2].then(|| ("surface A", a.size())));
        sizes.extend(declared[3].then(|| ("surface B", b.size())));
        sizes.extend(tables.heights.iter().map(|t| ("heights", bytes(t))));
        sizes.extend(tables.height_bounds.iter().map(|t| ("height bounds", bytes(t))));
        Ok(Self {
            group,
            origin,
            sizes,
            params,
            a,
            b,
        })
    }

    /// Writes the tables anew relative to another origin. Only parameters and table A depend on it.
    pub fn move_origin(&mut self, queue: &wgpu::Queue, surface: &dyn Surface, origin: DVec3) {
        let tables = surface.tables(origin);
        queue.write_buffer(&self.params, 0, &tables.params);
        queue.write_buffer(&self.a, 0, bytemuck::cast_slice(&tables.a));
        self.origin = origin;
    }

    /// Writes the tables of another surface of the same kind and size; false if it is of another.
    pub fn replace(&mut self, queue: &wgpu::Queue, surface: &dyn Surface) -> bool {
        let tables = surface.tables(self.origin);
        let [a, b]: [&[u8]; 2] = [bytemuck::cast_slice(&tables.a), bytemuck::cast_slice(&tables.b)];
        let fits = [(&self.params, tables.params.as_slice()), (&self.a, a), (&self.b, b)]
            .iter()
            .all(|(buffer, bytes)| buffer.size() == content(bytes).len() as u64);
        if fits {
            queue.write_buffer(&self.params, 0, &tables.params);
            queue.write_buffer(&self.a, 0, a);
            queue.write_buffer(&self.b, 0, b);
        }
        fits
    }
}

fn check_sizes(device: &wgpu::Device, tables: &SurfaceTables, topology_words: usize) -> Result<(), KeyleafError> {
    let limits = device.limits();
    let limit = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
    for (buffer, words) in [
        ("the topology", topology_words),
        ("surface table A", tables.a.len()),
        ("surface table B", tables.b.len()),
    ] {
        let bytes = 4 * words as u64;
        if bytes > limit {
            return Err(KeyleafError::BeyondLimits {
                buffer,
                what: "words",
                items: words as u64,
                bytes,
                limit,
                most: limit / 4,
            });
        }
    }
    let side = limits.max_texture_dimension_2d;
    for data in tables.heights.iter().chain(tables.height_bounds.iter()) {
        if data.width > side || data.height > side {
            return Err(KeyleafError::TextureTooLarge {
                width: data.width,
                height: data.height,
                limit: side,
            });
        }
    }
    Ok(())
}

/// What a buffer holds, which is never of size zero.
fn content(bytes: &[u8]) -> &[u8] {
    if bytes.is_empty() { &[0; 16] } else { bytes }
}

/// A buffer with the given content, never of size zero.
pub(crate) fn buffer(device: &wgpu::Device, label: &str, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
    let usage = usage | wgpu::BufferUsages::COPY_DST;
    let contents = content(contents);
    device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some(label),
        contents,
        usage,
    })
}

fn texture(device: &wgpu::Device, queue: &wgpu::Queue, label: &str, data: &TextureData) -> wgpu::TextureView {
    let format = match data.channels {
        1 => wgpu::TextureFormat::R32Float,
        2 => wgpu::TextureFormat::Rg32Float,
        _ => wgpu::TextureFormat::Rgba32Float,
    };
    let descriptor = wgpu::TextureDescriptor {
        label: Some(label),
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
    let texture = device.create_texture(&descriptor);
    for (level, texels) in (0u32..).zip(&data.mips) {
        let (width, height) = ((data.width >> level).max(1), (data.height >> level).max(1));
        queue.write_texture(
            wgpu::TexelCopyTextureInfo {
                texture: &texture,
                mip_level: level,
                origin: wgpu::Origin3d::ZERO,
                aspect: wgpu::TextureAspect::All,
            },
            bytemuck::cast_slice(texels),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(width * data.channels * 4),
                rows_per_image: Some(height),
            },
            wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers: 1,
            },
        );
    }
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
