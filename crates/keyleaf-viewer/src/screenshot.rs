//! Pictures of the window and of the scene.

use anyhow::Context;
use glam::UVec2;
use image::{ExtendedColorType, ImageEncoder, codecs::png::PngEncoder};
use keyleaf::headless::Headless;
use keyleaf::{read_back, wgpu};
use std::io::Write;
use std::path::{Path, PathBuf};

/// A texture that the interface can be drawn on and read back from.
pub struct Target {
    texture: wgpu::Texture,
    size: UVec2,
}

impl Target {
    /// As large as the window, in its format.
    pub fn new(gpu: &Headless, [width, height]: [u32; 2], format: wgpu::TextureFormat) -> Self {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("keyleaf.viewer.screenshot"),
            size: wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        Self {
            texture,
            size: UVec2::new(width, height),
        }
    }

    /// What to draw on.
    pub fn view(&self) -> wgpu::TextureView {
        self.texture.create_view(&Default::default())
    }

    /// Its pixels, four bytes each: red, green, blue, and what there is beside. Waits for the device.
    ///
    /// # Errors
    /// The device is lost.
    pub fn read(&self, gpu: &Headless) -> anyhow::Result<Vec<u8>> {
        let row = self.size.x * 4;
        let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("keyleaf.viewer.screenshot"),
            size: u64::from(padded) * u64::from(self.size.y),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(padded),
            rows_per_image: None,
        };
        encoder.copy_texture_to_buffer(
            self.texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout,
            },
            self.texture.size(),
        );
        gpu.queue.submit([encoder.finish()]);
        let bytes = read_back::read(&gpu.device, &gpu.queue, "the picture", &buffer, 0, buffer.size())?;
        let is_bgra = matches!(
            self.texture.format(),
            wgpu::TextureFormat::Bgra8Unorm | wgpu::TextureFormat::Bgra8UnormSrgb
        );
        let pixels = bytes
            .chunks(padded as usize)
            .flat_map(|line| line[..row as usize].as_chunks::<4>().0);
        Ok(pixels
            .flat_map(|[a, b, c, d]| if is_bgra { [*c, *b, *a, *d] } else { [*a, *b, *c, *d] })
            .collect())
    }
}

/// Writes four bytes a pixel as a PNG, whole or not at all.
///
/// # Errors
/// The file cannot be written.
pub fn write(file: &Path, pixels: &[u8], size: UVec2) -> anyhow::Result<()> {
    let colours: Vec<u8> = pixels
        .as_chunks::<4>()
        .0
        .iter()
        .flat_map(|[r, g, b, _]| [*r, *g, *b])
        .collect();
    let mut png = Vec::new();
    PngEncoder::new(&mut png).write_image(&colours, size.x, size.y, ExtendedColorType::Rgb8)?;
    keyleaf_scene::write_whole(file, |out| out.write_all(&png))
        .with_context(|| format!("{}: cannot be written", file.display()))
}

/// A file in the current folder that is not there yet: `keyleaf-NAME-1.ENDING`, and so on.
pub fn free_name(name: &str, ending: &str) -> PathBuf {
    let stem = Path::new(name)
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    let file = |n: u32| PathBuf::from(format!("keyleaf-{stem}-{n}.{ending}"));
    (1..).map(file).find(|file| !file.exists()).unwrap_or_else(|| file(0))
}
