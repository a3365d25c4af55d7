//! The samples of a height map file, as the file has them.

use std::io::Cursor;
use std::path::Path;

use image::DynamicImage;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;

use crate::error::{FilePlace, ImportError, extension, read_file};
use crate::note::Note;
use crate::texture::{self, MAX_DECODED_BYTES};

use super::{HEIGHT_MAP_EXTENSIONS, HeightMapOptions};

/// What the samples of a file are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SampleKind {
    /// 0..255.
    Byte,
    /// Unsigned integers of 16 bits or more.
    Unsigned,
    /// Signed integers.
    Signed,
    /// Floating-point numbers.
    Float,
}

/// The samples of a file.
#[derive(Debug)]
pub(super) struct Raster {
    pub width: usize,
    pub height: usize,
    pub samples: Vec<f32>,
    pub kind: SampleKind,
    /// The sample that means 1 in a picture of displacements.
    pub full_scale: f64,
    /// The void value that the file itself states.
    pub no_data: Option<f32>,
}

/// Decodes a height map; the ending of its name tells the format.
pub(super) fn decode(file: &Path, options: &HeightMapOptions, notes: &mut Vec<Note>) -> Result<Raster, ImportError> {
    let format = extension(file);
    if !super::is_height_map(file) {
        return Err(ImportError::UnknownExtension {
            file: file.to_path_buf(),
            extension: format,
            expected: HEIGHT_MAP_EXTENSIONS,
        });
    }
    let bytes = read_file(file)?;
    let raster = match format.as_str() {
        "png" => decode_png(file, &bytes, notes)?,
        "exr" => decode_exr(file, &bytes, notes)?,
        "tif" | "tiff" => decode_tiff(file, &bytes, notes)?,
        _ => decode_raw(file, &bytes, options.raw_size)?,
    };
    if raster.samples.len() != raster.width * raster.height {
        let reason = format!(
            "{} samples for a picture of {}x{}",
            raster.samples.len(),
            raster.width,
            raster.height
        );
        return Err(ImportError::malformed(file, FilePlace::Whole, reason));
    }
    Ok(raster)
}

fn decode_png(file: &Path, bytes: &[u8], notes: &mut Vec<Note>) -> Result<Raster, ImportError> {
    let picture = texture::decode(file, &FilePlace::Whole, bytes)?;
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let of_u8 = |values: Vec<u8>| values.into_iter().map(f32::from).collect();
    let of_u16 = |values: Vec<u16>| values.into_iter().map(f32::from).collect();
    if picture.color().has_color() {
        let text = "a colour picture: its luminance is taken for heights; use a grey picture of 16 bits";
        notes.push(Note::warning(file, text));
    }
    let (kind, samples) = match picture {
        DynamicImage::ImageLuma8(grey) => (SampleKind::Byte, of_u8(grey.into_raw())),
        DynamicImage::ImageLuma16(grey) => (SampleKind::Unsigned, of_u16(grey.into_raw())),
        deep @ (DynamicImage::ImageLumaA16(_) | DynamicImage::ImageRgb16(_) | DynamicImage::ImageRgba16(_)) => {
            (SampleKind::Unsigned, of_u16(deep.into_luma16().into_raw()))
        }
        other => (SampleKind::Byte, of_u8(other.into_luma8().into_raw())),
    };
    if kind == SampleKind::Byte {
        let text = "8 bits a sample make terraces; use 16 bits or floats";
        notes.push(Note::remark(file, text));
    }
    let full_scale = if kind == SampleKind::Byte { 255.0 } else { 65_535.0 };
    Ok(Raster {
        width,
        height,
        samples,
        kind,
        full_scale,
        no_data: None,
    })
}

/// Raw 16-bit samples, little-endian, unsigned, row by row.
fn decode_raw(file: &Path, bytes: &[u8], size: Option<[u32; 2]>) -> Result<Raster, ImportError> {
    let count = bytes.len() / 2;
    let [width, height] = match size {
        Some(size) => size.map(|s| s as usize),
        None => [count.isqrt(); 2],
    };
    if width.checked_mul(height).and_then(|n| n.checked_mul(2)) != Some(bytes.len()) {
        let reason = match size {
            Some(_) => format!(
                "{width}x{height} samples of 16 bits are {} bytes, the file has {}",
                width as u128 * height as u128 * 2,
                bytes.len()
            ),
            None => format!(
                "{} bytes are no square of 16-bit samples; give its size in a scene file, raw_size: (w, h)",
                bytes.len()
            ),
        };
        return Err(ImportError::malformed(file, FilePlace::Whole, reason));
    }
    let sample = |b: &[u8]| f32::from(u16::from_le_bytes([b[0], b[1]]));
    let samples = bytes.chunks_exact(2).map(sample).collect();
    let kind = SampleKind::Unsigned;
    Ok(Raster {
        width,
        height,
        samples,
        kind,
        full_scale: 65_535.0,
        no_data: None,
    })
}

fn decode_tiff(file: &Path, bytes: &[u8], notes: &mut Vec<Note>) -> Result<Raster, ImportError> {
    let malformed = |error: tiff::TiffError| {
        let reason = format!("the TIFF cannot be decoded: {error}");
        ImportError::malformed(file, FilePlace::Whole, reason)
    };
    let mut limits = Limits::default();
    limits.decoding_buffer_size = MAX_DECODED_BYTES as usize;
    let mut decoder = Decoder::new(Cursor::new(bytes)).map_err(malformed)?.with_limits(limits);
    let (width, height) = decoder.dimensions().map_err(malformed)?;
    let colour = decoder.colortype().map_err(malformed)?;
    if !matches!(colour, tiff::ColorType::Gray(_)) {
        let reason = format!("{colour:?} samples are no heights; use one grey channel");
        return Err(ImportError::unsupported(file, FilePlace::Whole, reason));
    }
    // GDAL writes the void value as text.
    let no_data = decoder
        .get_tag_ascii_string(Tag::Unknown(42113))
        .ok()
        .and_then(|text| text.trim_matches(['\0', ' ', '\n']).parse::<f64>().ok())
        .map(|value| value as f32);
    let image = decoder.read_image().map_err(malformed)?;
    let full_scale = match &image {
        DecodingResult::U8(_) => u8::MAX.into(),
        DecodingResult::I8(_) => i8::MAX.into(),
        DecodingResult::U16(_) => u16::MAX.into(),
        DecodingResult::I16(_) => i16::MAX.into(),
        DecodingResult::U32(_) => u32::MAX.into(),
        DecodingResult::I32(_) => i32::MAX.into(),
        _ => 1.0,
    };
    let (kind, samples) = match image {
        DecodingResult::U8(v) => (SampleKind::Byte, v.into_iter().map(f32::from).collect()),
        DecodingResult::I8(v) => (SampleKind::Signed, v.into_iter().map(f32::from).collect()),
        DecodingResult::U16(v) => (SampleKind::Unsigned, v.into_iter().map(f32::from).collect()),
        DecodingResult::I16(v) => (SampleKind::Signed, v.into_iter().map(f32::from).collect()),
        DecodingResult::F16(v) => (SampleKind::Float, v.into_iter().map(|h| h.to_f32()).collect()),
        DecodingResult::F32(v) => (SampleKind::Float, v),
        DecodingResult::F64(v) => (SampleKind::Float, rounded(v, |x| x as f32, file, notes)),
        DecodingResult::U32(v) => (SampleKind::Unsigned, rounded(v, |x| x as f32, file, notes)),
        DecodingResult::I32(v) => (SampleKind::Signed, rounded(v, |x| x as f32, file, notes)),
        DecodingResult::U64(v) => (SampleKind::Unsigned, rounded(v, |x| x as f32, file, notes)),
        DecodingResult::I64(v) => (SampleKind::Signed, rounded(v, |x| x as f32, file, notes)),
    };
    let (width, height) = (width as usize, height as usize);
    Ok(Raster {
        width,
        height,
        samples,
        kind,
        full_scale,
        no_data,
    })
}

/// Samples of more than 24 bits as f32, with a note.
fn rounded<T>(values: Vec<T>, to_f32: impl Fn(T) -> f32, file: &Path, notes: &mut Vec<Note>) -> Vec<f32> {
    notes.push(Note::remark(file, "samples are rounded to 32-bit floats"));
    values.into_iter().map(to_f32).collect()
}

/// The channels that may hold heights, in the order in which they are looked for.
const EXR_CHANNELS: [&str; 5] = ["Y", "Z", "height", "R", "G"];

fn decode_exr(file: &Path, bytes: &[u8], notes: &mut Vec<Note>) -> Result<Raster, ImportError> {
    use exr::prelude::{FlatSamples, ReadChannels, ReadLayers, read};
    let malformed = |error: exr::error::Error| {
        let reason = format!("the OpenEXR picture cannot be decoded: {error}");
        ImportError::malformed(file, FilePlace::Whole, reason)
    };
    let meta = exr::meta::MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(malformed)?;
    if meta.headers.iter().any(|header| header.deep) {
        let reason = "deep OpenEXR pictures are not read";
        return Err(ImportError::unsupported(file, FilePlace::Whole, reason));
    }
    let samples = |size: exr::math::Vec2<usize>| size.area() as u64 * 4;
    if meta.headers.iter().any(|h| samples(h.layer_size) > MAX_DECODED_BYTES) {
        let reason = format!("the picture needs more than {MAX_DECODED_BYTES} bytes");
        return Err(ImportError::unsupported(file, FilePlace::Whole, reason));
    }
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .map_err(malformed)?;
    let layer = image.layer_data;
    let channels = &layer.channel_data.list;
    let named = |name: &&str| channels.iter().find(|c| c.name == **name);
    let channel = EXR_CHANNELS.iter().find_map(named).or(channels.first());
    let Some(channel) = channel else {
        return Err(ImportError::empty(file, "the picture has no channels"));
    };
    if channels.len() > 1 {
        let text = format!("channel '{}' of {} is taken for heights", channel.name, channels.len());
        notes.push(Note::remark(file, text));
    }
    let samples = match &channel.sample_data {
        FlatSamples::F16(values) => values.iter().map(|h| h.to_f32()).collect(),
        FlatSamples::F32(values) => values.clone(),
        FlatSamples::U32(values) => rounded(values.clone(), |x| x as f32, file, notes),
    };
    let (width, height) = (layer.size.width(), layer.size.height());
    let kind = SampleKind::Float;
    Ok(Raster {
        width,
        height,
        samples,
        kind,
        full_scale: 1.0,
        no_data: None,
    })
}
