//! A device of one's own, for tools and tests that have no window. An engine brings its own device instead.

use crate::KeyleafError;

/// An adapter, its device and its queue.
#[derive(Debug, Clone)]
pub struct Headless {
    /// The adapter.
    pub adapter: wgpu::Adapter,
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
}

impl Headless {
    /// The first adapter that there is, hardware before software. Features: timestamps where the adapter has them. Limits: WebGPU's
    /// defaults, and larger buffers and textures where the adapter allows. The environment variables of wgpu (`WGPU_BACKEND`,
    /// `WGPU_ADAPTER_NAME`, …) choose otherwise.
    ///
    /// # Errors
    /// [`KeyleafError::NoAdapter`] or [`KeyleafError::NoDevice`].
    pub async fn request() -> Result<Self, KeyleafError> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            ..Default::default()
        };
        let adapter = instance
            .request_adapter(&options)
            .await
            .map_err(|e| KeyleafError::NoAdapter(e.to_string()))?;
        Self::from_adapter(adapter).await
    }

    /// A device of a given adapter, as [`Headless::request`] makes it.
    ///
    /// # Errors
    /// [`KeyleafError::NoDevice`].
    pub async fn from_adapter(adapter: wgpu::Adapter) -> Result<Self, KeyleafError> {
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("keyleaf"),
            required_features: adapter.features() & wanted_features(),
            required_limits: wanted_limits(&adapter.limits()),
            ..Default::default()
        };
        let (device, queue) = adapter
            .request_device(&descriptor)
            .await
            .map_err(|e| KeyleafError::NoDevice {
                adapter: adapter.get_info().name,
                reason: e.to_string(),
            })?;
        Ok(Self { adapter, device, queue })
    }

    /// Whether the adapter computes on the CPU: its times are not GPU times.
    pub fn is_software(&self) -> bool {
        self.adapter.get_info().device_type == wgpu::DeviceType::Cpu
    }
}

/// Features that are used if they are there; none is needed.
pub fn wanted_features() -> wgpu::Features {
    wgpu::Features::TIMESTAMP_QUERY
}

/// WebGPU's default limits, raised to what the adapter has where a larger scene profits: buffers and textures.
pub fn wanted_limits(adapter: &wgpu::Limits) -> wgpu::Limits {
    wgpu::Limits {
        max_buffer_size: adapter.max_buffer_size,
        max_storage_buffer_binding_size: adapter.max_storage_buffer_binding_size,
        max_texture_dimension_2d: adapter.max_texture_dimension_2d,
        ..wgpu::Limits::defaults()
    }
}
