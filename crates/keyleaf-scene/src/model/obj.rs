//! Wavefront OBJ: polygons of any size, texture coordinates, normals, vertex colours, materials.
//!
//! A reader of the project's own, since an error has to name its line, polygons must stay whole, and vertices must
//! not be split by material. What is no polygon (points, lines, free-form curves and surfaces) is skipped with a note;
//! subdivision tags are handed on. Sizes: one pass over the text, about 60 bytes a corner.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use glam::DVec3;

use crate::error::{FilePlace, ImportError};
use crate::material::SurfaceMaterial;
use crate::note::Note;
use crate::soup::{Soup, linear_from_srgb, unit};
use crate::wavefront::{for_each_line, index, numbers, rest_of};

use super::mtl;

/// What an OBJ file holds.
pub(super) struct Obj {
    pub soup: Soup,
    pub materials: Vec<SurfaceMaterial>,
    /// The lines of subdivision tags, with their numbers.
    pub tags: Vec<(usize, String)>,
}

/// The tables that face lines refer to, and what is seen on the way.
#[derive(Default)]
struct Reader {
    soup: Soup,
    colours: Vec<Option<[f32; 3]>>,
    uvs: Vec<[f32; 2]>,
    normals: Vec<[f32; 3]>,
    /// Texture coordinate and normal of each corner, `u32::MAX` where the face names none.
    corner_uv: Vec<u32>,
    corner_normal: Vec<u32>,
    libraries: Vec<PathBuf>,
    material_names: Vec<String>,
    material_index: HashMap<String, u32>,
    material: u32,
    tags: Vec<(usize, String)>,
    skipped: HashMap<&'static str, usize>,
}

const NONE: u32 = u32::MAX;
const FREE_FORM: &str = "free-form curves and surfaces";

/// Reads an OBJ file from its bytes; `file` names it in errors and is where material libraries are looked for.
pub(super) fn read(file: &Path, bytes: &[u8], notes: &mut Vec<Note>) -> Result<Obj, ImportError> {
    let text = String::from_utf8_lossy(bytes);
    let mut reader = Reader::default();
    reader.soup.states_topology = true;
    // Faces before the first `usemtl`.
    reader.use_material("");
    for_each_line(file, &text, |number, line| reader.line(file, number, line))?;
    reader.finish(file, notes)
}

impl Reader {
    fn line(&mut self, file: &Path, number: usize, line: &str) -> Result<(), ImportError> {
        let mut words = line.split_ascii_whitespace();
        let Some(keyword) = words.next() else { return Ok(()) };
        match keyword {
            "v" => self.vertex(file, number, words),
            "vt" => {
                let mut uv = numbers::<2>(file, number, "vt", 1, words)?.0;
                uv.iter_mut().for_each(|c| *c += 0.0);
                self.uvs.push(uv.map(|c| c as f32));
                Ok(())
            }
            "vn" => {
                let (normal, _) = numbers::<3>(file, number, "vn", 3, words)?;
                self.normals.push(unit(DVec3::from(normal)));
                Ok(())
            }
            "f" | "fo" => self.face(file, number, words),
            "usemtl" => {
                self.use_material(rest_of(line, keyword));
                Ok(())
            }
            "mtllib" => {
                self.libraries.push(PathBuf::from(rest_of(line, keyword)));
                Ok(())
            }
            "t" => {
                self.tags.push((number, line.to_owned()));
                Ok(())
            }
            "p" | "l" => self.skip("points and lines"),
            "curv" | "curv2" | "surf" => self.skip(FREE_FORM),
            // Names, groups, smoothing, free-form bodies.
            _ => Ok(()),
        }
    }

    fn skip(&mut self, what: &'static str) -> Result<(), ImportError> {
        *self.skipped.entry(what).or_default() += 1;
        Ok(())
    }

    fn use_material(&mut self, name: &str) {
        let next = self.material_names.len() as u32;
        self.material = *self.material_index.entry(name.to_owned()).or_insert_with(|| {
            self.material_names.push(name.to_owned());
            next
        });
    }

    /// `v x y z`, `v x y z w` (a rational weight, ignored) or `v x y z r g b`.
    fn vertex<'a>(
        &mut self,
        file: &Path,
        number: usize,
        words: impl Iterator<Item = &'a str>,
    ) -> Result<(), ImportError> {
        let (values, count) = numbers::<7>(file, number, "v", 3, words)?;
        self.soup.positions.push(DVec3::new(values[0], values[1], values[2]));
        // Colours are stored as they are seen, that is sRGB.
        let colour = [values[3], values[4], values[5]].map(|c| linear_from_srgb(c as f32));
        self.colours.push((count >= 6).then_some(colour));
        Ok(())
    }

    fn face<'a>(
        &mut self,
        file: &Path,
        number: usize,
        words: impl Iterator<Item = &'a str>,
    ) -> Result<(), ImportError> {
        let first = self.soup.corners.len();
        for word in words {
            let mut parts = word.split('/');
            let tables = [
                ("vertex", self.soup.positions.len()),
                ("texture coordinate", self.uvs.len()),
                ("normal", self.normals.len()),
            ];
            let mut corner = [NONE; 3];
            for (slot, (what, count)) in corner.iter_mut().zip(tables) {
                match parts.next() {
                    None | Some("") => {}
                    Some(text) => *slot = index(file, number, what, text, count)?,
                }
            }
            if corner[0] == NONE || parts.next().is_some() {
                let reason = format!("'{word}' is no face corner; expected v, v/vt, v//vn or v/vt/vn");
                return Err(ImportError::malformed(file, FilePlace::Line(number), reason));
            }
            self.soup.corners.push(corner[0]);
            self.corner_uv.push(corner[1]);
            self.corner_normal.push(corner[2]);
        }
        let count = self.soup.corners.len() - first;
        if count < 3 {
            let reason = format!("a face needs at least 3 corners, this one has {count}");
            return Err(ImportError::malformed(file, FilePlace::Line(number), reason));
        }
        self.soup.ends.push(self.soup.corners.len() as u32);
        self.soup.lines.push(number as u32);
        self.soup.materials.push(self.material);
        Ok(())
    }

    fn finish(mut self, file: &Path, notes: &mut Vec<Note>) -> Result<Obj, ImportError> {
        if self.soup.face_count() == 0 && self.skipped.contains_key(FREE_FORM) {
            let reason = "it has no polygons but free-form curves and surfaces; read it as Patches, not as a Mesh";
            return Err(ImportError::empty(file, reason));
        }
        let mut skipped: Vec<_> = self.skipped.iter().collect();
        skipped.sort();
        for (what, count) in skipped {
            notes.push(Note::warning(file, format!("{count} {what} are not read")));
        }
        self.gather_attributes(file, notes);
        let libraries = mtl::read_libraries(file, &self.libraries, notes);
        let missing = |name: &String| !name.is_empty() && !libraries.contains_key(name);
        for name in self.material_names.iter().filter(|name| missing(name)) {
            notes.push(Note::warning(
                file,
                format!("material '{name}' is in no material library"),
            ));
        }
        let materials = self
            .material_names
            .iter()
            .map(|name| libraries.get(name).cloned().unwrap_or_default())
            .collect();
        Ok(Obj {
            soup: self.soup,
            materials,
            tags: self.tags,
        })
    }

    /// Turns the indices of attributes into attributes of the corners.
    fn gather_attributes(&mut self, file: &Path, notes: &mut Vec<Note>) {
        let named = |corners: &[u32]| corners.iter().filter(|&&c| c != NONE).count();
        let lookup = |i: u32| if i == NONE { None } else { Some(i as usize) };
        let corners = self.soup.corners.len();
        let (with_uv, with_normal) = (named(&self.corner_uv), named(&self.corner_normal));
        if with_uv > 0 {
            let uvs = self
                .corner_uv
                .iter()
                .map(|&i| lookup(i).map_or([0.0; 2], |i| self.uvs[i]));
            self.soup.uvs = uvs.collect();
        }
        if with_normal == corners {
            let normals = self.corner_normal.iter().map(|&i| self.normals[i as usize]);
            self.soup.normals = normals.collect();
        } else if with_normal > 0 {
            let text = "normals are ignored: not all corners have one";
            notes.push(Note::remark(file, text));
        }
        if self.colours.iter().any(Option::is_some) {
            let colour = |&v: &u32| {
                let [r, g, b] = self.colours[v as usize].unwrap_or([1.0; 3]);
                [r, g, b, 1.0]
            };
            self.soup.colours = self.soup.corners.iter().map(colour).collect();
        }
    }
}
