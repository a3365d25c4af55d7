//! One frame: the interface, the update and the draw of the scene, the window's picture.

use crate::gpu::{Acquired, Gpu};
use crate::screenshot::Target;
use crate::viewer::Viewer;
use egui::{ClippedPrimitive, FullOutput};
use egui_wgpu::{Renderer, RendererOptions, ScreenDescriptor};
use glam::UVec2;
use keyleaf::wgpu;
use keyleaf_stage::{Canvas, Pipelines, Show, target};

/// What draws: made anew when the device is lost.
pub struct Painter {
    renderer: Renderer,
    canvas: Option<Canvas>,
    picture: Option<egui::TextureId>,
    jobs: Vec<ClippedPrimitive>,
    screen: ScreenDescriptor,
}

impl Painter {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        let options = RendererOptions {
            dithering: false,
            ..RendererOptions::default()
        };
        Self {
            renderer: Renderer::new(&gpu.headless.device, gpu.format(), options),
            canvas: None,
            picture: None,
            jobs: Vec::new(),
            screen: ScreenDescriptor {
                size_in_pixels: gpu.size(),
                pixels_per_point: 1.0,
            },
        }
    }

    /// The picture of the scene alone.
    pub fn canvas(&self) -> Option<&Canvas> {
        self.canvas.as_ref()
    }

    /// Draws the scene, if it changes, and then the interface. Whether the window shows it.
    ///
    /// # Errors
    /// What the device refuses.
    pub fn draw(
        &mut self,
        gpu: &mut Gpu,
        viewer: &mut Viewer,
        pipelines: &mut Pipelines,
        context: &egui::Context,
        mut output: FullOutput,
    ) -> anyhow::Result<bool> {
        let mut encoder = gpu
            .headless
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor {
                label: Some("keyleaf.viewer"),
            });
        let drawn = self.draw_scene(gpu, viewer, pipelines, &mut encoder);
        self.jobs = context.tessellate(std::mem::take(&mut output.shapes), output.pixels_per_point);
        self.screen = ScreenDescriptor {
            size_in_pixels: gpu.size(),
            pixels_per_point: output.pixels_per_point,
        };
        let (device, queue) = (&gpu.headless.device, &gpu.headless.queue);
        let mut deltas = std::mem::take(&mut output.textures_delta);
        for (id, images) in &deltas.set {
            for image in images {
                self.renderer.update_texture(device, queue, *id, image);
            }
        }
        let mut commands = self
            .renderer
            .update_buffers(device, queue, &mut encoder, &self.jobs, &self.screen);
        let shown = match gpu.acquire() {
            Acquired::Again => gpu.acquire(),
            other => other,
        };
        if let Acquired::Frame(frame) = &shown {
            let view = frame.texture.create_view(&Default::default());
            self.draw_interface(&mut encoder, &view);
        }
        commands.push(encoder.finish());
        gpu.headless.queue.submit(commands);
        let is_shown = matches!(shown, Acquired::Frame(_));
        if let Acquired::Frame(frame) = shown {
            gpu.headless.queue.present(frame);
        }
        for id in &deltas.free {
            self.renderer.free_texture(id);
        }
        deltas.clear(); // those that are dropped full panic in debug builds
        drawn?;
        Ok(is_shown)
    }

    /// The scene and the map, as far as they are not on the screen yet.
    fn draw_scene(
        &mut self,
        gpu: &Gpu,
        viewer: &mut Viewer,
        pipelines: &mut Pipelines,
        encoder: &mut wgpu::CommandEncoder,
    ) -> anyhow::Result<()> {
        let view = viewer.view();
        let size = viewer
            .pixels
            .min(UVec2::splat(gpu.headless.device.limits().max_texture_dimension_2d));
        let Some(document) = &mut viewer.document else {
            return Ok(());
        };
        if self.canvas.as_ref().is_none_or(|canvas| canvas.size() != size) {
            self.resize(gpu, size)?;
            document.forget_picture();
        }
        viewer.picture = self.picture;
        document.observe();
        let is_last = document.is_settled();
        let Some(canvas) = &self.canvas else { return Ok(()) };
        if document.needs_frame(&view) {
            document.record(&gpu.headless, encoder, canvas, &view, &mut viewer.costs, viewer.time);
            viewer.minimap.touch();
            viewer
                .strip
                .record(&gpu.headless, encoder, (document, pipelines), &view, viewer.time)?;
        } else {
            viewer.costs.collect();
            // Whoever opens the strip sees a point at once.
            if viewer.strip.points.is_empty() {
                viewer
                    .strip
                    .record(&gpu.headless, encoder, (document, pipelines), &view, viewer.time)?;
            }
        }
        viewer.strip.collect(document, &viewer.costs);
        if viewer.shown.minimap {
            viewer.minimap.record(
                &gpu.headless,
                &mut self.renderer,
                encoder,
                (&mut document.stage, pipelines),
                document.loaded.bounds,
                (viewer.time, is_last),
            )?;
        }
        Ok(())
    }

    fn resize(&mut self, gpu: &Gpu, size: UVec2) -> anyhow::Result<()> {
        let device = &gpu.headless.device;
        let canvas = Canvas::new(device, size, target(Show::Colour))?;
        let view = canvas.bytes_view();
        let filter = wgpu::FilterMode::Nearest;
        match self.picture {
            Some(id) => self
                .renderer
                .update_egui_texture_from_wgpu_texture(device, &view, filter, id),
            None => self.picture = Some(self.renderer.register_native_texture(device, &view, filter)),
        }
        self.canvas = Some(canvas);
        Ok(())
    }

    fn draw_interface(&self, encoder: &mut wgpu::CommandEncoder, view: &wgpu::TextureView) {
        let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("keyleaf.viewer.interface"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: None,
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        self.renderer
            .render(&mut pass.forget_lifetime(), &self.jobs, &self.screen);
    }

    /// The last frame of the window once more, read back: four bytes a pixel.
    ///
    /// # Errors
    /// The device is lost.
    pub fn read_window(&self, gpu: &Gpu) -> anyhow::Result<(Vec<u8>, UVec2)> {
        let target = Target::new(&gpu.headless, self.screen.size_in_pixels, gpu.format());
        let mut encoder = gpu.headless.device.create_command_encoder(&Default::default());
        self.draw_interface(&mut encoder, &target.view());
        gpu.headless.queue.submit([encoder.finish()]);
        Ok((target.read(&gpu.headless)?, UVec2::from(self.screen.size_in_pixels)))
    }
}
