//! Shapes by name, for models that are opened directly.

use std::fmt;
use std::str::FromStr;

use super::Shape;

/// The kind of surface that a model of polygons is drawn as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShapeName {
    /// `flat`: [`Shape::Flat`].
    Flat,
    /// `catmull-clark`: [`Shape::CatmullClark`].
    CatmullClark,
    /// `loop`: [`Shape::Loop`].
    Loop,
    /// `qas`: [`Shape::Qas`].
    Qas,
    /// `pn`: [`Shape::PnTriangles`].
    PnTriangles,
    /// `gaussian-product`: [`Shape::GaussianProduct`], with the covariances of the model's file or of the `.cov` file beside it.
    GaussianProduct,
}

impl ShapeName {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::Flat,
        Self::CatmullClark,
        Self::Loop,
        Self::Qas,
        Self::PnTriangles,
        Self::GaussianProduct,
    ];

    /// As a command line writes it.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Flat => "flat",
            Self::CatmullClark => "catmull-clark",
            Self::Loop => "loop",
            Self::Qas => "qas",
            Self::PnTriangles => "pn",
            Self::GaussianProduct => "gaussian-product",
        }
    }
}

impl fmt::Display for ShapeName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

/// A name that is none of [`ShapeName::ALL`].
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("'{found}' is no kind of surface; expected one of {}", ShapeName::ALL.map(ShapeName::as_str).join(", "))]
pub struct UnknownShape {
    /// What was found.
    pub found: String,
}

impl FromStr for ShapeName {
    type Err = UnknownShape;

    fn from_str(text: &str) -> Result<Self, UnknownShape> {
        let named = Self::ALL.into_iter().find(|name| name.as_str() == text);
        named.ok_or_else(|| UnknownShape { found: text.to_owned() })
    }
}

impl From<ShapeName> for Shape {
    /// The shape with its defaults.
    fn from(name: ShapeName) -> Self {
        match name {
            ShapeName::Flat => Self::Flat,
            ShapeName::CatmullClark => Self::CatmullClark(Default::default()),
            ShapeName::Loop => Self::Loop(Default::default()),
            ShapeName::Qas => Self::Qas(Default::default()),
            ShapeName::PnTriangles => Self::PnTriangles,
            ShapeName::GaussianProduct => Self::GaussianProduct(Default::default()),
        }
    }
}
