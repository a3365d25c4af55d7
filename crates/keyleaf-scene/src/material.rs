//! What a surface looks like, apart from its shape.

use std::sync::Arc;

use crate::texture::ColourTexture;

/// What reaches the shading: base colour and pictures.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceMaterial {
    /// Linear RGBA, each 0..1. Multiplies the texture and the corner colours.
    pub base_colour: [f32; 4],
    /// Base-colour picture, looked up with the corner UVs, repeated outside the unit square.
    pub texture: Option<Arc<ColourTexture>>,
    /// Picture of a lit sphere that fills it, looked up by the normal in view space in place of the light.
    pub matcap: Option<Arc<ColourTexture>>,
}

impl Default for SurfaceMaterial {
    /// White, without pictures.
    fn default() -> Self {
        Self {
            base_colour: [1.0; 4],
            texture: None,
            matcap: None,
        }
    }
}
