//! The errors that can stand on an axis.

use super::Point;

/// An error of a [`Point`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Greatest distance over the diagonal.
    Object,
    /// Greatest distance in pixels, seen side-on.
    Pixels,
    /// Greatest distance of silhouettes in pixels.
    Silhouette,
    /// Greatest angle of normals, degrees.
    Normal,
    /// PSNR of the picture in decibels; more is better.
    Psnr,
    /// Structural dissimilarity of the picture, 1 − SSIM.
    Dissimilarity,
}

impl Quantity {
    /// All, in the order in which a report shows them.
    pub const ALL: [Self; 6] = [
        Self::Object,
        Self::Pixels,
        Self::Silhouette,
        Self::Normal,
        Self::Psnr,
        Self::Dissimilarity,
    ];

    /// What an axis says.
    pub fn axis(self) -> &'static str {
        match self {
            Self::Object => "greatest distance / diagonal",
            Self::Pixels => "greatest distance, pixels",
            Self::Silhouette => "silhouette off by, pixels",
            Self::Normal => "greatest angle of normals, degrees",
            Self::Psnr => "PSNR, dB",
            Self::Dissimilarity => "1 − SSIM",
        }
    }

    /// What a heading says.
    pub fn title(self) -> &'static str {
        match self {
            Self::Object => "Error in space against time",
            Self::Pixels => "Error in pixels against time",
            Self::Silhouette => "Error of the silhouette against time",
            Self::Normal => "Error of normals against time",
            Self::Psnr => "PSNR against time",
            Self::Dissimilarity => "Structural dissimilarity against time",
        }
    }

    /// The value, if it was measured and is finite.
    pub fn of(self, point: &Point) -> Option<f64> {
        let errors = &point.errors;
        let value = match self {
            Self::Object => errors.object?.max,
            Self::Pixels => errors.pixels?.max,
            Self::Silhouette => errors.silhouette?.max,
            Self::Normal => errors.normal?.max,
            Self::Psnr => errors.picture?.psnr?,
            Self::Dissimilarity => 1.0 - errors.picture?.ssim,
        };
        value.is_finite().then_some(value)
    }

    /// The value with its sign so that less is better.
    pub fn badness(self, point: &Point) -> Option<f64> {
        let value = self.of(point)?;
        Some(if self.is_logarithmic() { value } else { -value })
    }

    /// Whether its axis is logarithmic. That of decibels, which are logarithms, is not.
    pub fn is_logarithmic(self) -> bool {
        self != Self::Psnr
    }
}
