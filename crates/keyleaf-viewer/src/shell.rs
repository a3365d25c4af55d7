//! Window, device and interface: made at the start, made again when the device is lost, remembered at the end.

use crate::app::App;
use crate::frame::Painter;
use crate::gpu::Gpu;
use crate::opening::Wanted;
use crate::palette;
use crate::picking::Picker;
use crate::remembered::Remembered;
use crate::viewer::DeviceText;
use anyhow::Context;
use egui::ViewportId;
use egui_winit::winit::dpi::{LogicalSize, PhysicalPosition};
use egui_winit::winit::event_loop::ActiveEventLoop;
use egui_winit::winit::window::Window;
use keyleaf_stage::Pipelines;
use std::sync::Arc;

/// Window, device and interface: what is there between `resumed` and the end.
pub(crate) struct Shell {
    pub window: Arc<Window>,
    pub gpu: Gpu,
    pub painter: Painter,
    pub interface: egui_winit::State,
}

impl App {
    /// Opens the window, and what was asked for in it.
    pub(crate) fn start(&mut self, events: &ActiveEventLoop) -> anyhow::Result<()> {
        let size = self
            .options
            .size
            .map(|size| size.map(f64::from))
            .or(self.remembered.size);
        let [width, height] = size.unwrap_or([1280.0, 800.0]);
        let mut attributes = Window::default_attributes()
            .with_title("keyleaf")
            .with_inner_size(LogicalSize::new(width, height))
            .with_maximized(self.remembered.maximised && self.options.size.is_none());
        if let Some([x, y]) = self.remembered.position {
            attributes = attributes.with_position(PhysicalPosition::new(x, y));
        }
        let window = Arc::new(events.create_window(attributes).context("there is no window")?);
        palette::set_themes(&self.context);
        self.set_theme();
        self.shell = Some(self.shell(window)?);
        if let Some(file) = self.options.file.clone() {
            self.open(Wanted::File(file, self.options.reading), false);
        }
        Ok(())
    }

    /// Device and interface for a window.
    fn shell(&mut self, window: Arc<Window>) -> anyhow::Result<Shell> {
        let gpu = Gpu::new(&window, self.options.present)?;
        let painter = Painter::new(&gpu);
        let most = gpu.headless.device.limits().max_texture_dimension_2d as usize;
        let scale = window.scale_factor() as f32;
        let interface = egui_winit::State::new(
            self.context.clone(),
            ViewportId::ROOT,
            &window,
            Some(scale),
            window.theme(),
            Some(most),
        );
        let info = gpu.headless.adapter.get_info();
        self.viewer.device = DeviceText {
            name: info.name.clone(),
            driver: format!("{}, {} {}", info.backend, info.driver, info.driver_info),
            present: format!("{:?}", gpu.present_mode()).to_lowercase(),
            is_software: gpu.headless.is_software(),
        };
        Ok(Shell {
            window,
            gpu,
            painter,
            interface,
        })
    }

    /// Everything on the device is gone: makes it again, and keeps what the person sees.
    pub(crate) fn rebuild(&mut self) {
        let Some(shell) = self.shell.take() else { return };
        let window = Arc::clone(&shell.window);
        drop(shell);
        self.pipelines = Pipelines::default();
        self.picker = Picker::default();
        self.viewer.costs.forget_device();
        self.viewer.minimap.forget_device();
        self.viewer.picture = None;
        // The interface keeps its state, but sends all textures again.
        self.context = egui::Context::default();
        palette::set_themes(&self.context);
        self.set_theme();
        match self.shell(window) {
            Ok(shell) => {
                let before = self.viewer.document.take();
                self.shell = Some(shell);
                if let (Some(before), Some(shell)) = (before, &self.shell) {
                    match before.on(&shell.gpu.headless, &mut self.pipelines) {
                        Ok(document) => self.viewer.document = Some(document),
                        Err(error) => self.viewer.complain(format!("{error:#}")),
                    }
                }
                self.viewer.say("the graphics device was lost and is back");
            }
            Err(error) => self.fail(error.context("the graphics device is lost")),
        }
    }

    /// Remembers the window for the next start.
    pub(crate) fn remember(&mut self) {
        let Some(shell) = &self.shell else { return };
        if self.is_scripted() {
            return;
        }
        let scale = shell.window.scale_factor();
        let size: LogicalSize<f64> = shell.window.inner_size().to_logical(scale);
        let maximised = shell.window.is_maximized();
        Remembered {
            size: if maximised {
                self.remembered.size
            } else {
                Some([size.width, size.height])
            },
            position: shell.window.outer_position().ok().map(|at| [at.x, at.y]),
            maximised,
            shown: self.viewer.shown.clone(),
        }
        .save();
    }
}
