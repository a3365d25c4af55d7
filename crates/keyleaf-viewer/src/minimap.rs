//! The map: all leaves seen from above, drawn now and then into a picture of its own.

use egui::TextureId;
use egui_wgpu::Renderer;
use glam::{DMat3, DQuat, DVec3, UVec2};
use keyleaf::headless::Headless;
use keyleaf::{KeyleafError, Projection, View, wgpu};
use keyleaf_stage::{Canvas, Pipelines, Stage};

/// Seconds between two pictures while leaves change.
const PERIOD: f64 = 0.2;
/// Pixels of a side.
const SIDE: u32 = 256;

/// The map.
#[derive(Default)]
pub struct Minimap {
    /// The picture.
    pub picture: Option<TextureId>,
    canvas: Option<Canvas>,
    drawn_at: f64,
    is_stale: bool,
}

/// A view straight down on a box, north up.
pub fn view((low, high): (DVec3, DVec3)) -> View {
    let size = high - low;
    let height = (size.x.max(size.z) * 1.04).max(f64::MIN_POSITIVE.sqrt());
    let depth = size.y.max(height * 1e-3);
    let centre = (low + high) / 2.0;
    View {
        eye: DVec3::new(centre.x, high.y + depth * 0.1, centre.z),
        orientation: DQuat::from_mat3(&DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y)),
        projection: Projection::Orthographic {
            height,
            near: 0.0,
            far: 1.3 * depth,
        },
        viewport: UVec2::splat(SIDE),
    }
}

impl Minimap {
    /// The leaves have changed since the last picture.
    pub fn touch(&mut self) {
        self.is_stale = true;
    }

    /// Whether the picture is older than the leaves.
    pub fn is_behind(&self) -> bool {
        self.is_stale
    }

    /// Forgets what is on the device.
    pub fn forget_device(&mut self) {
        *self = Self::default();
    }

    /// Draws, if the leaves have changed and the last picture is old enough, or if this one is to be the last.
    ///
    /// # Errors
    /// [`KeyleafError`] if the pipelines cannot be made.
    pub fn record(
        &mut self,
        gpu: &Headless,
        renderer: &mut Renderer,
        encoder: &mut wgpu::CommandEncoder,
        (stage, pipelines): (&mut Stage, &mut Pipelines),
        bounds: (DVec3, DVec3),
        (time, is_last): (f64, bool),
    ) -> Result<(), KeyleafError> {
        if !self.is_stale || (time < self.drawn_at + PERIOD && !is_last) {
            return Ok(());
        }
        let canvas = match &self.canvas {
            Some(canvas) => canvas,
            None => {
                let canvas = Canvas::new(&gpu.device, UVec2::splat(SIDE), stage.target())?;
                let view = canvas.bytes_view();
                self.picture = Some(renderer.register_native_texture(&gpu.device, &view, wgpu::FilterMode::Linear));
                self.canvas.insert(canvas)
            }
        };
        canvas.draw_map(encoder, stage, &view(bounds), pipelines)?;
        (self.drawn_at, self.is_stale) = (time, !is_last);
        Ok(())
    }
}
