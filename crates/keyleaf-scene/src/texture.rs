//! Pictures: base colours (8 bits, sRGB) and displacement heights (one float channel).

use std::path::Path;

use image::{DynamicImage, ImageReader};

use crate::error::{FilePlace, ImportError, read_file};

/// The largest side of a picture, in pixels: WebGPU's default limit of a 2D texture.
pub const MAX_TEXTURE_SIDE: u32 = 8192;

/// A base-colour picture.
#[derive(Clone, PartialEq)]
pub struct ColourTexture {
    /// Pixels a row, 1..=[`MAX_TEXTURE_SIDE`].
    pub width: u32,
    /// Rows, 1..=[`MAX_TEXTURE_SIDE`].
    pub height: u32,
    /// RGBA, sRGB-encoded, straight alpha, 4 bytes a pixel, row 0 at the top (v = 1).
    pub rgba: Vec<u8>,
}

impl std::fmt::Debug for ColourTexture {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "ColourTexture({}x{})", self.width, self.height)
    }
}

impl ColourTexture {
    /// Reads a PNG, JPEG, TIFF or EXR file; its content decides, not its name.
    pub fn read(file: &Path) -> Result<Self, ImportError> {
        Self::decode(file, &FilePlace::Whole, &read_file(file)?)
    }

    /// Decodes a picture that is part of `file`, at `place`.
    pub(crate) fn decode(file: &Path, place: &FilePlace, bytes: &[u8]) -> Result<Self, ImportError> {
        let picture = decode(file, place, bytes)?.into_rgba8();
        let (width, height) = picture.dimensions();
        if width == 0 || height == 0 {
            return Err(ImportError::empty(file, "the picture has no pixels"));
        }
        if width > MAX_TEXTURE_SIDE || height > MAX_TEXTURE_SIDE {
            let reason =
                format!("the picture has {width}x{height} pixels; scale it to at most {MAX_TEXTURE_SIDE} a side");
            return Err(ImportError::unsupported(file, place.clone(), reason));
        }
        Ok(Self {
            width,
            height,
            rgba: picture.into_raw(),
        })
    }
}

/// Decodes a picture whose format its first bytes tell.
pub(crate) fn decode(file: &Path, place: &FilePlace, bytes: &[u8]) -> Result<DynamicImage, ImportError> {
    let malformed = |error: image::ImageError| {
        let reason = format!("the picture cannot be decoded: {error}");
        ImportError::malformed(file, place.clone(), reason)
    };
    let mut reader = ImageReader::new(std::io::Cursor::new(bytes))
        .with_guessed_format()
        .map_err(|error| malformed(error.into()))?;
    let mut limits = image::Limits::default();
    limits.max_alloc = Some(MAX_DECODED_BYTES);
    reader.limits(limits);
    reader.decode().map_err(malformed)
}

/// The most memory that decoding one picture may take, in bytes.
pub(crate) const MAX_DECODED_BYTES: u64 = 2 << 30;
