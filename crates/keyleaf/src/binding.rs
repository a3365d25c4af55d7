//! Bind group layouts as tables of what each binding is.

/// What a binding of a shader is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Binding {
    /// A uniform buffer.
    Uniform,
    /// A storage buffer that is only read.
    Read,
    /// A storage buffer that is read and written.
    Write,
    /// A texture of floats read sample by sample.
    Texels,
    /// A colour texture with a filter.
    Colour,
    /// A filtering sampler.
    Sampler,
    /// Nothing at this number.
    Absent,
}

impl Binding {
    fn kind(self) -> Option<wgpu::BindingType> {
        let buffer = |ty| wgpu::BindingType::Buffer {
            ty,
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let texture = |filterable| wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable },
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        };
        match self {
            Self::Uniform => Some(buffer(wgpu::BufferBindingType::Uniform)),
            Self::Read => Some(buffer(wgpu::BufferBindingType::Storage { read_only: true })),
            Self::Write => Some(buffer(wgpu::BufferBindingType::Storage { read_only: false })),
            Self::Texels => Some(texture(false)),
            Self::Colour => Some(texture(true)),
            Self::Sampler => Some(wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering)),
            Self::Absent => None,
        }
    }
}

/// A layout whose binding i is `bindings[i]`.
pub(crate) fn layout(
    device: &wgpu::Device,
    label: &str,
    stages: wgpu::ShaderStages,
    bindings: &[Binding],
) -> wgpu::BindGroupLayout {
    let entries: Vec<_> = (0u32..)
        .zip(bindings)
        .filter_map(|(binding, kind)| {
            Some(wgpu::BindGroupLayoutEntry {
                binding,
                visibility: stages,
                ty: kind.kind()?,
                count: None,
            })
        })
        .collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some(label),
        entries: &entries,
    })
}

/// A bind group from (number, resource).
pub(crate) fn group(
    device: &wgpu::Device,
    label: &str,
    layout: &wgpu::BindGroupLayout,
    resources: &[(u32, wgpu::BindingResource<'_>)],
) -> wgpu::BindGroup {
    let entries: Vec<_> = resources
        .iter()
        .map(|(binding, resource)| wgpu::BindGroupEntry {
            binding: *binding,
            resource: resource.clone(),
        })
        .collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some(label),
        layout,
        entries: &entries,
    })
}
