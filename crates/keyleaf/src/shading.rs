//! Light and material: which effects a scene names, and their uniform.

use crate::View;
use encase::ShaderType;
use glam::{Mat4, Vec3, Vec4};

/// Colour of the surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Material {
    /// One colour.
    #[default]
    Plain,
    /// Grass, rock and snow by height and slope.
    Terrain,
    /// Normals and colours at the corners of the mesh.
    Attributes,
    /// The same, and a base-colour texture.
    Texture,
    /// Colours at the corners, and a picture of a lit sphere in place of the light.
    Matcap,
}

/// What the lit surface is tinted by, so that it tells about the leaves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Tint {
    /// Nothing.
    #[default]
    None,
    /// The level of each leaf.
    Level,
    /// Pairs in red: leaves drawn as one triangle beside a coarser one.
    Pairs,
    /// The wish of each leaf, metric over threshold: how near it is to its next change.
    Wish,
    /// How far the vertices have come to the surface, where they [morph](crate::Morph).
    Morph,
    /// World normals.
    Normal,
    /// Distance of the drawn triangles from the surface, in pixels.
    Error,
}

impl Tint {
    /// All, the plain surface first.
    pub const ALL: [Self; 7] = [
        Self::None,
        Self::Level,
        Self::Pairs,
        Self::Wish,
        Self::Morph,
        Self::Normal,
        Self::Error,
    ];

    /// The WGSL file that defines `tint`.
    pub fn shader(self) -> &'static str {
        match self {
            Self::None => "effects/tint_none.wgsl",
            Self::Level => "effects/tint_level.wgsl",
            Self::Pairs => "effects/tint_pairs.wgsl",
            Self::Wish => "effects/tint_wish.wgsl",
            Self::Morph => "effects/tint_morph.wgsl",
            Self::Normal => "effects/tint_normal.wgsl",
            Self::Error => "effects/tint_error.wgsl",
        }
    }

    /// The WGSL file that defines `leaf_mark`: what the vertices say of their leaf besides its level.
    fn mark(self) -> &'static str {
        match self {
            Self::Wish => "draw/mark_wish.wgsl",
            Self::Morph => "draw/mark_morph.wgsl",
            Self::Error => "draw/mark_error.wgsl",
            Self::None | Self::Level | Self::Pairs | Self::Normal => MARK_NONE,
        }
    }
}

const MARK_NONE: &str = "draw/mark_none.wgsl";

/// What is drawn over the lit surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Overlay {
    /// What it is tinted by.
    pub tint: Tint,
    /// Whether the edges of the triangles are drawn.
    pub wireframe: bool,
}

impl Overlay {
    /// The names of what is drawn, as `plan` prints them.
    pub fn names(self) -> Vec<String> {
        let tint = (self.tint != Tint::None).then(|| format!("{:?}", self.tint).to_lowercase());
        tint.into_iter()
            .chain(self.wireframe.then(|| "wireframe".to_owned()))
            .collect()
    }
}

/// Air between surface and eye.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Atmosphere {
    /// Clear.
    #[default]
    None,
    /// Haze that grows with distance.
    Haze,
}

/// What a draw writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Channel {
    /// The picture.
    Colour(Material, Overlay, Atmosphere),
    /// World normals, n / 2 + 1 / 2.
    Normal,
    /// Levels as colours.
    Level,
    /// World positions relative to the eye, as floats.
    Position,
    /// Distance of the drawn triangles from the surface in pixels, as floats.
    Error,
    /// How often each pixel is drawn: every triangle adds the same, and none hides another.
    Overdraw,
}

impl Channel {
    /// WGSL files of the draw, without those that they require and without the surface.
    pub fn files(&self) -> Vec<&'static str> {
        match self {
            Self::Normal => vec!["draw/normal.wgsl", MARK_NONE],
            Self::Level => vec!["draw/level.wgsl", MARK_NONE],
            Self::Position => vec!["draw/position.wgsl", MARK_NONE],
            Self::Error => vec!["draw/error.wgsl"],
            Self::Overdraw => vec!["draw/overdraw.wgsl", MARK_NONE],
            Self::Colour(material, overlay, atmosphere) => vec![
                "draw/colour.wgsl",
                match material {
                    Material::Matcap => "effects/shade_matcap.wgsl",
                    _ => "effects/shade_lit.wgsl",
                },
                match material {
                    Material::Plain => "effects/material_plain.wgsl",
                    Material::Terrain => "effects/material_terrain.wgsl",
                    Material::Attributes | Material::Matcap => "effects/material_attributes.wgsl",
                    Material::Texture => "effects/material_texture.wgsl",
                },
                overlay.tint.shader(),
                overlay.tint.mark(),
                if overlay.wireframe {
                    "effects/overlay_wireframe.wgsl"
                } else {
                    "effects/overlay_none.wgsl"
                },
                match atmosphere {
                    Atmosphere::None => "effects/atmosphere_none.wgsl",
                    Atmosphere::Haze => "effects/atmosphere_haze.wgsl",
                },
            ],
        }
    }

    /// Whether corners of the mesh have attributes in this channel.
    pub fn has_attributes(&self) -> bool {
        matches!(
            self,
            Self::Colour(Material::Attributes | Material::Texture | Material::Matcap, ..)
        )
    }

    /// Whether there is a texture in this channel.
    pub fn has_texture(&self) -> bool {
        matches!(self, Self::Colour(Material::Texture | Material::Matcap, ..))
    }
}

/// The uniform of `shaders/shared/shading.wgsl`. Colours are linear.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType)]
pub struct Shading {
    /// World.
    pub eye: Vec3,
    /// Factor before the tone curve.
    pub exposure: f32,
    /// Towards the sun, world, unit.
    pub sun_direction: Vec3,
    /// Of the wireframe, pixels.
    pub line_width: f32,
    /// Colour and strength of the sun.
    pub sun_colour: Vec3,
    /// A world unit; 0: clear.
    pub fog_density: f32,
    /// From the whole sky.
    pub ambient: Vec3,
    /// Height at which a terrain has the colour `low`, world units.
    pub lowest: f32,
    /// Of the haze.
    pub fog_colour: Vec3,
    /// Height at which a terrain has the colour `high`, world units.
    pub highest: f32,
    /// Of the surface.
    pub base_colour: Vec3,
    /// World units.
    pub snow_line: f32,
    /// Terrain: low ground.
    pub low: Vec3,
    /// Tangent of the slope up to which a terrain is not `steep`.
    pub gentle: f32,
    /// Terrain: high ground.
    pub high: Vec3,
    /// Tangent of the slope from which on it is.
    pub steepest: f32,
    /// Terrain: rock.
    pub steep: Vec3,
    /// Pixels that a world unit at distance 1 covers.
    pub pixels_per_unit: f32,
    /// Terrain: snow.
    pub snow: Vec3,
    /// Padding.
    pub unused_too: f32,
    /// Of the wireframe, with its opacity.
    pub line_colour: Vec4,
}

impl Default for Shading {
    fn default() -> Self {
        Self {
            eye: Vec3::ZERO,
            exposure: 1.0,
            sun_direction: Vec3::new(0.45, 0.62, 0.64).normalize(),
            line_width: 1.25,
            sun_colour: Vec3::new(2.6, 2.4, 2.1),
            fog_density: 0.0,
            ambient: Vec3::new(0.22, 0.27, 0.36),
            lowest: 0.0,
            fog_colour: Vec3::new(0.55, 0.66, 0.82),
            highest: 1.0,
            base_colour: Vec3::splat(0.5),
            snow_line: f32::MAX,
            low: Vec3::new(0.10, 0.13, 0.05),
            gentle: 0.5,
            high: Vec3::new(0.27, 0.22, 0.13),
            steepest: 1.0,
            steep: Vec3::new(0.25, 0.23, 0.21),
            pixels_per_unit: 1.0,
            snow: Vec3::new(0.82, 0.86, 0.92),
            unused_too: 0.0,
            line_colour: Vec4::new(0.02, 0.03, 0.05, 0.85),
        }
    }
}

/// The uniform of `shaders/draw/sky.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType)]
pub struct Background {
    /// World directions from clip space: where the ray through a pixel goes.
    pub world_from_clip: Mat4,
}

impl Background {
    /// The rays of a view. A parallel projection sees one direction everywhere.
    pub fn new(view: &View) -> Self {
        let rotation = Mat4::from_quat(view.orientation.as_quat());
        let tangent = match view.projection {
            crate::Projection::Perspective { fov_y, .. } => (fov_y / 2.0).tan(),
            crate::Projection::Orthographic { .. } => 0.0,
        };
        let (x, y) = ((tangent * view.aspect()) as f32, tangent as f32);
        let rays = Mat4::from_cols(x * Vec4::X, y * Vec4::Y, Vec4::ZERO, -Vec4::Z);
        Self {
            world_from_clip: rotation * rays,
        }
    }
}
