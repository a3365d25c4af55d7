//! Shader modules from WGSL files.

use crate::KeyleafError;
use keyleaf_shaders::{compose, label};

/// Compiles files with all that they require. The label names them, so that [`keyleaf_shaders::located`] finds the line of a file that
/// the compiler complains of.
pub(crate) fn shader_module(device: &wgpu::Device, files: &[&str]) -> Result<wgpu::ShaderModule, KeyleafError> {
    Ok(device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(&label(files)),
        source: wgpu::ShaderSource::Wgsl(compose(files)?.into()),
    }))
}
