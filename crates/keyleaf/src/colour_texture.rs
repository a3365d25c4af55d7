//! Colour textures on the GPU.

use crate::draw::ColourTexture;

/// Uploads a texture with a chain of mips, each the mean of four texels in linear light.
pub(crate) fn colour_texture(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    source: &ColourTexture,
) -> (wgpu::TextureView, wgpu::Sampler) {
    let levels = 32 - source.width.max(source.height).max(1).leading_zeros();
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("keyleaf.draw.texture"),
        size: wgpu::Extent3d {
            width: source.width.max(1),
            height: source.height.max(1),
            depth_or_array_layers: 1,
        },
        mip_level_count: levels,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8UnormSrgb,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let mut level = source.clone();
    for mip_level in 0..levels {
        queue.write_texture(
            wgpu::TexelCopyTextureInfo {
                texture: &texture,
                mip_level,
                origin: wgpu::Origin3d::ZERO,
                aspect: wgpu::TextureAspect::All,
            },
            &level.rgba,
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(4 * level.width),
                rows_per_image: Some(level.height),
            },
            wgpu::Extent3d {
                width: level.width,
                height: level.height,
                depth_or_array_layers: 1,
            },
        );
        level = half(&level);
    }
    let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("keyleaf.draw.texture"),
        address_mode_u: wgpu::AddressMode::Repeat,
        address_mode_v: wgpu::AddressMode::Repeat,
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        mipmap_filter: wgpu::MipmapFilterMode::Linear,
        ..Default::default()
    });
    (texture.create_view(&wgpu::TextureViewDescriptor::default()), sampler)
}

fn half(source: &ColourTexture) -> ColourTexture {
    let (width, height) = ((source.width / 2).max(1), (source.height / 2).max(1));
    let linear = |x: u32, y: u32, channel: usize| {
        let at = (y.min(source.height - 1) * source.width + x.min(source.width - 1)) as usize * 4 + channel;
        (f32::from(source.rgba[at]) / 255.0).powf(2.2)
    };
    let mut rgba = Vec::with_capacity((width * height * 4) as usize);
    for y in 0..height {
        for x in 0..width {
            for channel in 0..4 {
                let sum = linear(2 * x, 2 * y, channel)
                    + linear(2 * x + 1, 2 * y, channel)
                    + linear(2 * x, 2 * y + 1, channel)
                    + linear(2 * x + 1, 2 * y + 1, channel);
                rgba.push(((sum / 4.0).powf(1.0 / 2.2) * 255.0).round() as u8);
            }
        }
    }
    ColourTexture { width, height, rgba }
}
