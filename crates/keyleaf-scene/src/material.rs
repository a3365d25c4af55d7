//! What a surface looks like, apart from its shape.

use std::sync::Arc;

use crate::texture::ColourTexture;

/// The base colour of a material: what reaches the shading.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceMaterial {
    /// Linear RGBA, each 0..1. Multiplies the texture and the corner colours.
    pub base_colour: [f32; 4],
    /// Base-colour picture, looked up with the corner UVs, repeated outside the unit square.
    pub texture: Option<Arc<ColourTexture>>,
}

impl Default for SurfaceMaterial {
    /// White, without a picture.
    fn default() -> Self {
        Self {
            base_colour: [1.0; 4],
            texture: None,
        }
    }
}
