//! The data behind a glTF document: buffers, accessors, pictures.
//!
//! The document is validated by the `gltf` crate, which checks references and types, but neither that views and
//! accessors lie within their buffers nor that indices are in range; that is done here, before anything is read.

use std::cell::RefCell;
use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

use gltf::json::accessor::{ComponentType, Type};
use gltf::json::validation::Checked;
use gltf::{Document, Glb};

use crate::error::{FilePlace, ImportError};
use crate::note::Note;
use crate::texture::ColourTexture;

/// Required extensions that need nothing from a reader of shapes and base colours, or that are read.
const HARMLESS_EXTENSIONS: [&str; 12] = [
    "KHR_mesh_quantization",
    "KHR_lights_punctual",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
];

/// A place that glTF numbers, such as `node 3`.
pub(super) fn part(what: &str, index: usize) -> FilePlace {
    FilePlace::Part(format!("{what} {index}"))
}

/// A validated document with its buffers.
pub(super) struct GltfData<'a> {
    pub file: &'a Path,
    pub document: Document,
    buffers: Vec<Vec<u8>>,
    pictures: RefCell<HashMap<usize, Arc<ColourTexture>>>,
}

impl<'a> GltfData<'a> {
    /// Parses the document and reads its buffers.
    pub fn read(file: &'a Path, bytes: &[u8], notes: &mut Vec<Note>) -> Result<Self, ImportError> {
        let malformed = |reason: String| ImportError::malformed(file, FilePlace::Whole, reason);
        let (json, mut blob) = if bytes.starts_with(b"glTF") {
            let declared = bytes.get(8..12).and_then(|b| b.try_into().ok()).map(u32::from_le_bytes);
            if declared.is_none_or(|length| length < 12 || length as usize > bytes.len()) {
                return Err(malformed(format!(
                    "truncated: the header announces {} bytes, the file has {}",
                    declared.unwrap_or(12),
                    bytes.len()
                )));
            }
            let glb = Glb::from_slice(bytes).map_err(|e| malformed(e.to_string()))?;
            (glb.json.into_owned(), glb.bin.map(|bin| bin.into_owned()))
        } else {
            (bytes.to_vec(), None)
        };
        let mut root: gltf::json::Root = gltf::json::deserialize::from_slice(&json).map_err(|error| {
            let place = if blob.is_some() || error.line() == 0 {
                FilePlace::Whole
            } else {
                FilePlace::Line(error.line())
            };
            ImportError::malformed(file, place, format!("not a glTF document: {error}"))
        })?;
        if root.extensions_used.iter().any(|e| e == "KHR_texture_transform") {
            notes.push(Note::warning(file, "KHR_texture_transform is not read"));
        }
        root.extensions_required
            .retain(|e| !HARMLESS_EXTENSIONS.contains(&e.as_str()) && e != "KHR_texture_transform");
        if let Some(extension) = root.extensions_required.first() {
            let reason = format!("the required extension {extension} is not read; export without it");
            return Err(ImportError::unsupported(file, FilePlace::Whole, reason));
        }
        // The crate's validation takes this for granted.
        let mut attributes = root
            .meshes
            .iter()
            .flat_map(|mesh| &mesh.primitives)
            .flat_map(|primitive| primitive.attributes.values());
        if let Some(missing) = attributes.find(|index| index.value() >= root.accessors.len()) {
            return Err(ImportError::IndexOutOfRange {
                file: file.to_path_buf(),
                place: FilePlace::Whole,
                what: "accessor",
                index: missing.value() as i64,
                count: root.accessors.len(),
            });
        }
        let document =
            Document::from_json(root).map_err(|error| malformed(format!("not a valid glTF document: {error}")))?;
        let mut buffers = Vec::new();
        for (index, buffer) in document.as_json().buffers.iter().enumerate() {
            let bytes = match &buffer.uri {
                Some(uri) => resource(file, part("buffer", index), uri)?,
                None => blob.take().ok_or_else(|| {
                    let reason = "the buffer is neither named nor in the file";
                    ImportError::malformed(file, part("buffer", index), reason)
                })?,
            };
            let declared = buffer.byte_length.0;
            if (bytes.len() as u64) < declared {
                let reason = format!("truncated: {} of {declared} bytes", bytes.len());
                return Err(ImportError::malformed(file, part("buffer", index), reason));
            }
            buffers.push(bytes);
        }
        Ok(Self {
            file,
            document,
            buffers,
            pictures: RefCell::default(),
        })
    }

    /// The bytes of a view.
    fn view(&self, index: usize) -> Result<(&[u8], Option<usize>), ImportError> {
        let out = || {
            let reason = "the view does not lie within its buffer";
            ImportError::malformed(self.file, part("buffer view", index), reason)
        };
        let view = self.document.as_json().buffer_views.get(index).ok_or_else(out)?;
        let buffer = self.buffers.get(view.buffer.value()).ok_or_else(out)?;
        let first = view.byte_offset.map_or(0, |o| o.0);
        let end = first.checked_add(view.byte_length.0).ok_or_else(out)?;
        let bytes = usize::try_from(first)
            .ok()
            .zip(usize::try_from(end).ok())
            .and_then(|(first, end)| buffer.get(first..end))
            .ok_or_else(out)?;
        Ok((bytes, view.byte_stride.map(|s| s.0)))
    }

    /// `count` rows of `width` components that begin at `offset` of a view.
    fn rows(
        &self,
        (view, offset, count): (usize, u64, usize),
        (component, width, normalised): (ComponentType, usize, bool),
        mut row: impl FnMut(usize, &[f64]),
    ) -> Result<(), ImportError> {
        let (bytes, stride) = self.view(view)?;
        let size = component.size() * width;
        let stride = stride.unwrap_or(size);
        let needed = (count as u64)
            .saturating_sub(1)
            .checked_mul(stride as u64)
            .and_then(|n| n.checked_add(size as u64)?.checked_add(offset));
        if count > 0 && needed.is_none_or(|n| n > bytes.len() as u64) {
            let reason = "an accessor does not lie within the view";
            return Err(ImportError::malformed(self.file, part("buffer view", view), reason));
        }
        let mut values = [0.0; 16];
        for i in 0..count {
            let first = offset as usize + i * stride;
            let parts = bytes[first..first + size].chunks_exact(component.size());
            for (value, part) in values.iter_mut().zip(parts) {
                *value = decode(component, part, normalised);
            }
            row(i, &values[..width.min(16)]);
        }
        Ok(())
    }

    /// All rows of an accessor, sparse ones included.
    fn accessor(
        &self,
        index: usize,
        place: &dyn Fn() -> FilePlace,
        mut row: impl FnMut(usize, &[f64]),
    ) -> Result<usize, ImportError> {
        let malformed = |reason: &str| ImportError::malformed(self.file, place(), reason);
        let accessor = self
            .document
            .as_json()
            .accessors
            .get(index)
            .ok_or_else(|| malformed("an accessor is missing"))?;
        let (Checked::Valid(component), Checked::Valid(kind)) = (accessor.component_type, accessor.type_) else {
            return Err(malformed("an accessor has an unknown type"));
        };
        let width = match kind {
            Type::Scalar => 1,
            Type::Vec2 => 2,
            Type::Vec3 => 3,
            Type::Vec4 => 4,
            _ => return Err(malformed("an attribute is a matrix")),
        };
        let of = (component.0, width, accessor.normalized);
        let count = accessor.count.0 as usize;
        if let Some(view) = accessor.buffer_view {
            let offset = accessor.byte_offset.map_or(0, |o| o.0);
            self.rows((view.value(), offset, count), of, &mut row)?;
        } else if accessor.sparse.is_none() || count > MAX_EMPTY_ACCESSOR {
            return Err(malformed("an accessor has no data"));
        } else {
            (0..count).for_each(|i| row(i, &[0.0; 4][..width]));
        }
        if let Some(sparse) = &accessor.sparse {
            let Checked::Valid(index_type) = sparse.indices.component_type else {
                return Err(malformed("a sparse accessor has an unknown index type"));
            };
            let sparse_count = sparse.count.0 as usize;
            let mut targets = Vec::new();
            let view = sparse.indices.buffer_view.value();
            let indices = (view, sparse.indices.byte_offset.0, sparse_count);
            self.rows(indices, (index_type.0, 1, false), |_, v| targets.push(v[0] as usize))?;
            if targets.iter().any(|&t| t >= count) {
                return Err(malformed("a sparse accessor replaces an element that is not there"));
            }
            let view = sparse.values.buffer_view.value();
            let values = (view, sparse.values.byte_offset.0, sparse_count);
            self.rows(values, of, |i, v| row(targets[i], v))?;
        }
        Ok(count)
    }

    /// An accessor as vectors; components that it lacks are those of `fill`.
    pub fn vectors<const N: usize>(
        &self,
        index: usize,
        fill: [f64; N],
        place: &dyn Fn() -> FilePlace,
    ) -> Result<Vec<[f64; N]>, ImportError> {
        let mut vectors: Vec<[f64; N]> = Vec::new();
        self.accessor(index, place, |i, values| {
            let mut vector = fill;
            vector.iter_mut().zip(values).for_each(|(to, from)| *to = *from);
            match vectors.get_mut(i) {
                Some(old) => *old = vector,
                None => vectors.push(vector),
            }
        })?;
        Ok(vectors)
    }

    /// An accessor as indices, all below `count`.
    pub fn indices(&self, index: usize, count: usize, place: &dyn Fn() -> FilePlace) -> Result<Vec<u32>, ImportError> {
        let vectors = self.vectors::<1>(index, [0.0], place)?;
        match vectors
            .iter()
            .find(|[i]| !(*i >= 0.0 && *i < count as f64 && i.fract() == 0.0))
        {
            None => Ok(vectors.into_iter().map(|[i]| i as u32).collect()),
            Some(&[index]) => Err(ImportError::IndexOutOfRange {
                file: self.file.to_path_buf(),
                place: place(),
                what: "vertex",
                index: index as i64,
                count,
            }),
        }
    }

    /// A picture of the document, decoded once.
    pub fn picture(&self, index: usize, notes: &mut Vec<Note>) -> Result<Arc<ColourTexture>, ImportError> {
        if let Some(done) = self.pictures.borrow().get(&index) {
            return Ok(done.clone());
        }
        let place = part("image", index);
        let image = self.document.as_json().images.get(index);
        let picture = match image.map(|image| (&image.buffer_view, &image.uri)) {
            Some((Some(view), _)) => ColourTexture::decode(self.file, &place, self.view(view.value())?.0)?,
            Some((None, Some(uri))) => {
                let bytes = resource(self.file, place.clone(), uri)?;
                ColourTexture::decode(self.file, &place, &bytes)?
            }
            _ => {
                let text = format!("{place}the picture has no data; it is drawn white");
                notes.push(Note::warning(self.file, text));
                ColourTexture {
                    width: 1,
                    height: 1,
                    rgba: vec![255; 4],
                }
            }
        };
        let picture = Arc::new(picture);
        self.pictures.borrow_mut().insert(index, picture.clone());
        Ok(picture)
    }
}

/// The most elements of an accessor without data of its own: a file of some bytes cannot ask for more memory.
const MAX_EMPTY_ACCESSOR: usize = 1 << 24;

/// One component; `normalised` integers become 0..1 or -1..1 (glTF 2.0, section 3.6.2.2).
fn decode(component: ComponentType, bytes: &[u8], normalised: bool) -> f64 {
    let (value, scale) = match (component, bytes) {
        (ComponentType::I8, &[a]) => (f64::from(a as i8), 127.0),
        (ComponentType::U8, &[a]) => (f64::from(a), 255.0),
        (ComponentType::I16, &[a, b]) => (f64::from(i16::from_le_bytes([a, b])), 32767.0),
        (ComponentType::U16, &[a, b]) => (f64::from(u16::from_le_bytes([a, b])), 65535.0),
        (ComponentType::U32, &[a, b, c, d]) => (f64::from(u32::from_le_bytes([a, b, c, d])), 1.0),
        (ComponentType::F32, &[a, b, c, d]) => (f64::from(f32::from_le_bytes([a, b, c, d])), 1.0),
        _ => (f64::NAN, 1.0),
    };
    if normalised { (value / scale).max(-1.0) } else { value }
}

/// The bytes behind a URI: `data:` or a file beside the document.
fn resource(file: &Path, place: FilePlace, uri: &str) -> Result<Vec<u8>, ImportError> {
    let malformed = |reason: String| ImportError::malformed(file, place.clone(), reason);
    // The crate's own decoder takes for granted that what is escaped is UTF-8.
    if !escapes_are_utf8(uri) {
        return Err(malformed("the URI is not UTF-8".into()));
    }
    let folder = file.parent().unwrap_or(Path::new(""));
    gltf::buffer::Data::from_source(gltf::buffer::Source::Uri(uri), Some(folder))
        .map(|data| data.0)
        .map_err(|error| {
            let shown: String = uri.chars().take(80).collect();
            malformed(format!("'{shown}' cannot be read: {error}"))
        })
}

fn escapes_are_utf8(uri: &str) -> bool {
    let bytes = uri.as_bytes();
    let mut decoded = Vec::with_capacity(bytes.len());
    let mut at = 0;
    while at < bytes.len() {
        let escape = bytes.get(at + 1..at + 3).filter(|_| bytes[at] == b'%');
        let code = escape
            .and_then(|hex| std::str::from_utf8(hex).ok())
            .and_then(|hex| u8::from_str_radix(hex, 16).ok());
        decoded.push(code.unwrap_or(bytes[at]));
        at += if code.is_some() { 3 } else { 1 };
    }
    std::str::from_utf8(&decoded).is_ok()
}
