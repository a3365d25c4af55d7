//! Offscreen targets, and pictures read back from them.

use crate::{Pipelines, Show, Stage};
use glam::UVec2;
use keyleaf::draw::Target;
use keyleaf::headless::Headless;
use keyleaf::{KeyleafError, View, read_back};

/// Samples a pixel of a colour picture.
pub const SAMPLES: u32 = 4;

/// The depth format: reversed depth needs floats.
pub const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// What pictures of a channel render to: smooth edges for colours, single samples for data.
pub fn target(show: Show) -> Target {
    let (colour, samples) = match show {
        Show::Colour | Show::Overdraw => (wgpu::TextureFormat::Rgba8UnormSrgb, SAMPLES),
        Show::Normal | Show::Level => (wgpu::TextureFormat::Rgba8Unorm, 1),
        Show::Position => (wgpu::TextureFormat::Rgba32Float, 1),
        Show::Error => (wgpu::TextureFormat::R32Float, 1),
    };
    Target {
        colour,
        depth: DEPTH,
        samples,
    }
}

/// Offscreen textures of one size.
pub struct Canvas {
    size: UVec2,
    target: Target,
    samples: wgpu::TextureView,
    resolved: wgpu::Texture,
    resolved_view: wgpu::TextureView,
    depth: wgpu::TextureView,
}

impl Canvas {
    /// Textures for pictures of `size` pixels.
    ///
    /// # Errors
    /// [`KeyleafError::TextureTooLarge`] beyond the device's limit; [`KeyleafError::Setting`] for no pixels.
    pub fn new(device: &wgpu::Device, size: UVec2, target: Target) -> Result<Self, KeyleafError> {
        let limit = device.limits().max_texture_dimension_2d;
        if size.x == 0 || size.y == 0 {
            let value = format!("{}x{}", size.x, size.y);
            return Err(KeyleafError::Setting {
                setting: "size",
                value,
                expected: "expected at least 1x1 pixels",
            });
        }
        if size.max_element() > limit {
            return Err(KeyleafError::TextureTooLarge {
                width: size.x,
                height: size.y,
                limit,
            });
        }
        // Programs that compose in sRGB bytes sample the picture without decoding it.
        let plain = [target.colour.remove_srgb_suffix()];
        let make = |label, format, sample_count, usage| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d {
                    width: size.x,
                    height: size.y,
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats: if usage.contains(wgpu::TextureUsages::TEXTURE_BINDING) {
                    &plain
                } else {
                    &[]
                },
            })
        };
        use wgpu::TextureUsages as U;
        let resolved = make(
            "keyleaf.picture",
            target.colour,
            1,
            U::RENDER_ATTACHMENT | U::COPY_SRC | U::TEXTURE_BINDING,
        );
        let resolved_view = resolved.create_view(&Default::default());
        let samples = if target.samples > 1 {
            make(
                "keyleaf.picture.samples",
                target.colour,
                target.samples,
                U::RENDER_ATTACHMENT,
            )
            .create_view(&Default::default())
        } else {
            resolved_view.clone()
        };
        let depth = make(
            "keyleaf.picture.depth",
            target.depth,
            target.samples,
            U::RENDER_ATTACHMENT,
        );
        let depth = depth.create_view(&Default::default());
        Ok(Self {
            size,
            target,
            samples,
            resolved,
            resolved_view,
            depth,
        })
    }

    /// Pixels.
    pub fn size(&self) -> UVec2 {
        self.size
    }

    /// The picture as bytes, for a program that shows it: sampling decodes nothing.
    pub fn bytes_view(&self) -> wgpu::TextureView {
        self.resolved.create_view(&wgpu::TextureViewDescriptor {
            label: Some("keyleaf.picture.bytes"),
            format: Some(self.target.colour.remove_srgb_suffix()),
            usage: Some(wgpu::TextureUsages::TEXTURE_BINDING),
            ..Default::default()
        })
    }

    /// Records the draws of a stage for a view.
    pub fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        stage: &mut Stage,
        view: &View,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) {
        let clear = match stage.show() {
            Show::Colour => wgpu::Color {
                r: 0.045,
                g: 0.05,
                b: 0.06,
                a: 1.0,
            },
            _ => wgpu::Color::TRANSPARENT,
        };
        let mut pass = self.begin(encoder, clear, timestamps);
        stage.draw(&mut pass, view);
    }

    /// Records the map of a stage, seen by a view: all its leaves, coloured by level, where nothing else is transparent.
    ///
    /// # Errors
    /// [`KeyleafError`] if the pipelines cannot be made.
    pub fn draw_map(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        stage: &mut Stage,
        view: &View,
        pipelines: &mut Pipelines,
    ) -> Result<(), KeyleafError> {
        stage.prepare_map(view, pipelines, self.target)?;
        let mut pass = self.begin(encoder, wgpu::Color::TRANSPARENT, None);
        stage.draw_map(&mut pass);
        Ok(())
    }

    pub(crate) fn begin<'e>(
        &self,
        encoder: &'e mut wgpu::CommandEncoder,
        clear: wgpu::Color,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) -> wgpu::RenderPass<'e> {
        let multisampled = self.target.samples > 1;
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("keyleaf.draw"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.samples,
                depth_slice: None,
                resolve_target: multisampled.then_some(&self.resolved_view),
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(clear),
                    store: if multisampled {
                        wgpu::StoreOp::Discard
                    } else {
                        wgpu::StoreOp::Store
                    },
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            timestamp_writes: timestamps,
            occlusion_query_set: None,
            multiview_mask: None,
        })
    }

    /// The picture as it was last drawn, row by row from the top: four bytes a pixel, or four floats for positions. Waits for the
    /// device.
    ///
    /// # Errors
    /// [`KeyleafError::ReadBack`] if the device is lost.
    pub fn read(&self, gpu: &Headless) -> Result<Vec<u8>, KeyleafError> {
        let pixel = self.target.colour.block_copy_size(None).unwrap_or(4);
        let row = self.size.x * pixel;
        let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("keyleaf.picture.read"),
            size: u64::from(padded) * u64::from(self.size.y),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.copy(&mut encoder, &buffer, padded);
        gpu.queue.submit([encoder.finish()]);
        let bytes = read_back::read(&gpu.device, &gpu.queue, "the picture", &buffer, 0, buffer.size())?;
        Ok(bytes
            .chunks(padded as usize)
            .flat_map(|line| &line[..row as usize])
            .copied()
            .collect())
    }

    /// Records a copy of the picture to a buffer with rows of so many bytes.
    pub(crate) fn copy(&self, encoder: &mut wgpu::CommandEncoder, buffer: &wgpu::Buffer, row: u32) {
        encoder.copy_texture_to_buffer(
            self.resolved.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(row),
                    rows_per_image: None,
                },
            },
            wgpu::Extent3d {
                width: self.size.x,
                height: self.size.y,
                depth_or_array_layers: 1,
            },
        );
    }
}
