//! The device with the window's surface: made, configured anew, lost and made again.

use crate::Present;
use anyhow::Context;
use egui_winit::winit::window::Window;
use keyleaf::headless::Headless;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};

/// The device, and the surface that it presents to.
pub struct Gpu {
    /// Adapter, device and queue.
    pub headless: Headless,
    instance: wgpu::Instance,
    window: Arc<Window>,
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    lost: Arc<AtomicBool>,
    errors: Arc<Mutex<Vec<String>>>,
}

/// What became of a frame's picture of the window.
pub enum Acquired {
    /// Draw on it.
    Frame(wgpu::SurfaceTexture),
    /// Nothing can be drawn now; later perhaps.
    Skip,
    /// The surface was made anew: ask again.
    Again,
}

impl Gpu {
    /// A device that can present to the window.
    ///
    /// # Errors
    /// No adapter or no device; the message names what was refused.
    pub fn new(window: &Arc<Window>, present: Present) -> anyhow::Result<Self> {
        let display = Box::new(Arc::clone(window));
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_with_display_handle_from_env(display));
        let surface = instance
            .create_surface(Arc::clone(window))
            .context("the window has no surface to draw on")?;
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            compatible_surface: Some(&surface),
            ..Default::default()
        };
        let adapter = pollster::block_on(instance.request_adapter(&options))
            .context("there is no graphics device that can draw in a window; `keyleaf info` lists what there is")?;
        let headless = pollster::block_on(Headless::from_adapter(adapter))?;
        let config = configuration(&surface, &headless, window, present)?;
        surface.configure(&headless.device, &config);

        let lost = Arc::new(AtomicBool::new(false));
        let errors = Arc::new(Mutex::new(Vec::new()));
        let flag = Arc::clone(&lost);
        headless.device.set_device_lost_callback(move |reason, message| {
            eprintln!("note: the graphics device is lost ({reason:?}): {message}");
            flag.store(true, Ordering::Release);
        });
        let list = Arc::clone(&errors);
        headless.device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            let text = error.to_string().split_whitespace().collect::<Vec<_>>().join(" ");
            if let Ok(mut list) = list.lock() {
                list.push(text);
            }
        }));
        Ok(Self {
            headless,
            instance,
            window: Arc::clone(window),
            surface,
            config,
            lost,
            errors,
        })
    }

    /// The format of the window's pictures.
    pub fn format(&self) -> wgpu::TextureFormat {
        self.config.format
    }

    /// Pixels of the window.
    pub fn size(&self) -> [u32; 2] {
        [self.config.width, self.config.height]
    }

    /// How frames wait for the screen.
    pub fn present_mode(&self) -> wgpu::PresentMode {
        self.config.present_mode
    }

    /// Follows a new size of the window; a minimised one keeps the last.
    pub fn resize(&mut self, width: u32, height: u32) {
        let most = self.headless.device.limits().max_texture_dimension_2d;
        if width > 0 && height > 0 && !self.is_lost() {
            (self.config.width, self.config.height) = (width.min(most), height.min(most));
            self.surface.configure(&self.headless.device, &self.config);
        }
    }

    /// Whether everything on the device is gone.
    pub fn is_lost(&self) -> bool {
        // The news comes with the answers of the device; a device that does not answer has its own news.
        let _ = self.headless.device.poll(wgpu::PollType::Poll);
        self.lost.load(Ordering::Acquire)
    }

    /// What the device refused since the last call.
    pub fn take_errors(&self) -> Vec<String> {
        self.errors
            .lock()
            .map(|mut list| std::mem::take(&mut *list))
            .unwrap_or_default()
    }

    /// The next picture of the window.
    pub fn acquire(&mut self) -> Acquired {
        use wgpu::CurrentSurfaceTexture as Current;
        match self.surface.get_current_texture() {
            Current::Success(frame) => Acquired::Frame(frame),
            Current::Suboptimal(frame) => {
                drop(frame);
                self.surface.configure(&self.headless.device, &self.config);
                match self.surface.get_current_texture() {
                    Current::Success(frame) | Current::Suboptimal(frame) => Acquired::Frame(frame),
                    _ => Acquired::Skip,
                }
            }
            Current::Outdated => {
                self.surface.configure(&self.headless.device, &self.config);
                Acquired::Again
            }
            Current::Lost => match self.instance.create_surface(Arc::clone(&self.window)) {
                Ok(surface) => {
                    self.surface = surface;
                    self.surface.configure(&self.headless.device, &self.config);
                    Acquired::Again
                }
                Err(_) => Acquired::Skip,
            },
            Current::Timeout | Current::Occluded | Current::Validation => Acquired::Skip,
        }
    }
}

fn configuration(
    surface: &wgpu::Surface<'_>,
    gpu: &Headless,
    window: &Window,
    present: Present,
) -> anyhow::Result<wgpu::SurfaceConfiguration> {
    let able = surface.get_capabilities(&gpu.adapter);
    let size = window.inner_size();
    let mut config = surface
        .get_default_config(&gpu.adapter, size.width.max(1), size.height.max(1))
        .context("the graphics device cannot draw in this window")?;
    // The interface is composed in sRGB bytes, which a format without decoding takes as they are.
    let plain = able.formats.iter().find(|format| !format.is_srgb());
    config.format = *plain.unwrap_or(&config.format);
    let wanted = present.mode();
    config.present_mode = if able.present_modes.contains(&wanted) {
        wanted
    } else {
        wgpu::PresentMode::Fifo
    };
    Ok(config)
}
