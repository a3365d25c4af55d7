//! The free-form surfaces of Wavefront OBJ (Advanced Visualizer manual, appendix B1): `cstype` `deg` `surf` `parm` `end`.
//!
//! The fourth number of a vertex is its weight, which only `rat` surfaces use; its position is not multiplied by it. Curves, special
//! curves and points, and statements about display are skipped with a note.

use std::collections::BTreeMap;
use std::path::Path;

use glam::DVec3;
use keyleaf_surface::NurbsSurface;

use crate::error::{FilePlace, ImportError};
use crate::note::Note;
use crate::wavefront::{for_each_line, index, numbers, rest_of};

use super::obj_surface::{Body, CurveType, State};
use super::{PatchFileOptions, patch_name};

/// A vertex and its line.
pub(super) struct Vertex {
    pub position: DVec3,
    pub weight: f64,
    pub line: usize,
}

/// What stands open until `end`.
enum Element {
    Surface(Body),
    /// A curve, of which nothing is read.
    Curve(usize),
}

struct Reader<'a> {
    file: &'a Path,
    options: &'a PatchFileOptions,
    vertices: Vec<Vertex>,
    state: State,
    name: Option<String>,
    open: Option<Element>,
    surfaces: Vec<NurbsSurface>,
    names: Vec<String>,
    /// The line of the first polygon.
    polygon: Option<usize>,
    trimmed: usize,
    /// How often each statement is there that is not read.
    skipped: BTreeMap<String, usize>,
}

/// Whether the text has a `surf` statement.
pub(super) fn has_surfaces(bytes: &[u8]) -> bool {
    let first_word = |line: &[u8]| {
        let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        words.next() == Some(b"surf".as_slice())
    };
    bytes.split(|&byte| byte == b'\n' || byte == b'\r').any(first_word)
}

/// Reads the surfaces of a file and their names; `file` names it in errors.
pub(super) fn read(
    file: &Path,
    text: &str,
    options: &PatchFileOptions,
    notes: &mut Vec<Note>,
) -> Result<(Vec<NurbsSurface>, Vec<String>), ImportError> {
    let mut reader = Reader {
        file,
        options,
        vertices: Vec::new(),
        state: State::default(),
        name: None,
        open: None,
        surfaces: Vec::new(),
        names: Vec::new(),
        polygon: None,
        trimmed: 0,
        skipped: BTreeMap::new(),
    };
    for_each_line(file, text, |number, line| reader.line(number, line))?;
    reader.finish(notes)
}

impl Reader<'_> {
    fn malformed(&self, line: usize, reason: impl Into<String>) -> ImportError {
        ImportError::malformed(self.file, FilePlace::Line(line), reason)
    }

    fn line(&mut self, number: usize, line: &str) -> Result<(), ImportError> {
        let mut words = line.split_ascii_whitespace();
        let Some(keyword) = words.next() else { return Ok(()) };
        match keyword {
            "v" => self.vertex(number, words),
            "vt" | "vn" | "vp" | "s" => Ok(()),
            "o" | "g" => {
                let name = rest_of(line, keyword);
                self.name = (!name.is_empty()).then(|| name.to_owned());
                Ok(())
            }
            "f" | "fo" => {
                self.polygon.get_or_insert(number);
                Ok(())
            }
            "cstype" => self.curve_type(number, words),
            "deg" => self.degree(number, words),
            "surf" => self.surface(number, words),
            "curv" | "curv2" => {
                self.skip(keyword);
                self.begin(number, Element::Curve(number))
            }
            "parm" => self.parameters(number, words),
            "trim" | "hole" => self.trim(number, keyword),
            "end" => self.end(number),
            _ => {
                self.skip(keyword);
                Ok(())
            }
        }
    }

    fn skip(&mut self, keyword: &str) {
        *self.skipped.entry(keyword.to_owned()).or_default() += 1;
    }

    /// `v x y z`, `v x y z w`, `v x y z r g b` or `v x y z w r g b`; colours are not read.
    fn vertex<'a>(&mut self, line: usize, words: impl Iterator<Item = &'a str>) -> Result<(), ImportError> {
        let (values, count) = numbers::<7>(self.file, line, "v", 3, words)?;
        let [x, y, z, weight, ..] = values;
        let has_weight = !matches!(count, 3 | 6);
        self.vertices.push(Vertex {
            position: DVec3::new(x, y, z),
            weight: if has_weight { weight } else { 1.0 },
            line,
        });
        Ok(())
    }

    fn curve_type<'a>(&mut self, line: usize, words: impl Iterator<Item = &'a str>) -> Result<(), ImportError> {
        let words: Vec<&str> = words.collect();
        let (is_rational, name) = match words[..] {
            ["rat", name] => (true, name),
            [name] => (false, name),
            _ => return Err(self.malformed(line, "expected 'cstype' with a type, or 'rat' and a type")),
        };
        self.state.curve_type = Some(CurveType {
            is_rational,
            name: name.to_owned(),
            line,
        });
        Ok(())
    }

    /// One degree for curves, two for surfaces.
    fn degree<'a>(&mut self, line: usize, words: impl Iterator<Item = &'a str>) -> Result<(), ImportError> {
        let mut degree = Vec::new();
        for word in words {
            let value = word.parse();
            degree.push(value.map_err(|_| self.malformed(line, format!("'{word}' after 'deg' is no degree")))?);
        }
        self.state.degree = Some((degree, line));
        Ok(())
    }

    fn begin(&mut self, line: usize, element: Element) -> Result<(), ImportError> {
        match self.open {
            Some(Element::Surface(Body { line: open, .. }) | Element::Curve(open)) => Err(self.malformed(
                line,
                format!("the statement of line {open} has no 'end' before this one"),
            )),
            None => {
                self.open = Some(element);
                Ok(())
            }
        }
    }

    /// `surf s0 s1 t0 t1 v…`
    fn surface<'a>(&mut self, line: usize, words: impl Iterator<Item = &'a str>) -> Result<(), ImportError> {
        let mut words = words;
        let ([s0, s1, t0, t1], _) = numbers::<4>(self.file, line, "surf", 4, words.by_ref().take(4))?;
        let mut controls = Vec::new();
        for word in words {
            let vertex = word.split('/').next().unwrap_or("");
            controls.push(index(self.file, line, "control point", vertex, self.vertices.len())?);
        }
        let body = Body::new(line, [[s0, s1], [t0, t1]], controls);
        self.begin(line, Element::Surface(body))
    }

    /// `parm u …` or `parm v …`
    fn parameters<'a>(&mut self, line: usize, words: impl Iterator<Item = &'a str>) -> Result<(), ImportError> {
        let body = match &mut self.open {
            Some(Element::Surface(body)) => body,
            Some(Element::Curve(_)) => return Ok(()),
            None => return Err(self.malformed(line, "'parm' stands outside a curve or surface")),
        };
        body.parameters(self.file, line, words)
    }

    fn trim(&mut self, line: usize, keyword: &str) -> Result<(), ImportError> {
        if !self.options.ignore_trims {
            let reason = format!("'{keyword}': untrimmed surfaces only; ignore_trims reads such surfaces whole");
            return Err(ImportError::unsupported(self.file, FilePlace::Line(line), reason));
        }
        match &mut self.open {
            Some(Element::Surface(body)) => {
                body.is_trimmed = true;
                Ok(())
            }
            _ => Err(self.malformed(line, format!("'{keyword}' stands outside a surface"))),
        }
    }

    fn end(&mut self, line: usize) -> Result<(), ImportError> {
        match self.open.take() {
            Some(Element::Surface(body)) => {
                let surface = body.surface(self.file, &self.state, &self.vertices)?;
                self.trimmed += usize::from(body.is_trimmed);
                self.surfaces.push(surface);
                let name = self.name.clone();
                self.names.push(name.unwrap_or_else(|| patch_name(self.surfaces.len())));
                Ok(())
            }
            Some(Element::Curve(_)) => Ok(()),
            None => Err(self.malformed(line, "'end' without a curve or surface before it")),
        }
    }

    fn finish(self, notes: &mut Vec<Note>) -> Result<(Vec<NurbsSurface>, Vec<String>), ImportError> {
        if let Some(Element::Surface(Body { line, .. }) | Element::Curve(line)) = self.open {
            return Err(self.malformed(line, "the file ends before the 'end' of this statement"));
        }
        if self.surfaces.is_empty() {
            return Err(ImportError::empty(self.file, "it has no free-form surfaces ('surf')"));
        }
        if let Some(line) = self.polygon {
            let reason = "polygons and free-form surfaces in one file; split it into one file for each";
            return Err(ImportError::unsupported(self.file, FilePlace::Line(line), reason));
        }
        if self.trimmed > 0 {
            let text = format!(
                "surfaces whose trimming curves are ignored, drawn whole: {}",
                self.trimmed
            );
            notes.push(Note::warning(self.file, text));
        }
        if !self.skipped.is_empty() {
            let counted = self
                .skipped
                .iter()
                .map(|(keyword, count)| format!("{keyword} ({count})"));
            let text = format!(
                "statements that are not read: {}",
                counted.collect::<Vec<_>>().join(", ")
            );
            notes.push(Note::remark(self.file, text));
        }
        Ok((self.surfaces, self.names))
    }
}
