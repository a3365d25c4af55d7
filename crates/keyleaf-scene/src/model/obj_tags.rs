//! Subdivision tags of Wavefront OBJ files, as OpenSubdiv writes them: `t name ints/floats/strings values…`.
//!
//! | tag | means |
//! |---|---|
//! | `t crease 2/1/0 3 7 2.5` | the edge of vertices 3 and 7, counted from 0, has sharpness 2.5; several pairs share one sharpness, or have one each |
//! | `t corner 1/1/0 4 10` | vertex 4 has sharpness 10 |
//! | `t interpolateboundary 1/0/0 2` | boundaries: 0 [`BoundaryRule::None`], 1 [`BoundaryRule::EdgesAndCorners`], 2 [`BoundaryRule::Edges`] |
//! | `t creasemethod 0/0/1 chaikin` | `normal` or `chaikin` |
//! | `t facevarying…`, `t smoothtriangles`, `t trianglesubdiv` | checked for their form, and not applied: texture coordinates are interpolated linearly in the faces |
//!
//! The numbers of `interpolateboundary` are those of OpenSubdiv's regression shapes (`shape_utils`), not of its enumeration.

use std::path::Path;

use keyleaf_surface::{BoundaryRule, Corner, Crease, Creasing};

use crate::error::{FilePlace, ImportError};
use crate::note::Note;
use crate::soup::check_finite;

use super::sharpness::Placed;

/// The tags of a file.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Tags {
    pub creases: Vec<Placed<Crease>>,
    pub corners: Vec<Placed<Corner>>,
    pub boundary: Option<BoundaryRule>,
    pub creasing: Option<Creasing>,
}

/// Reads tags from lines with their numbers; `vertices` is how many the file has.
pub(super) fn parse(
    file: &Path,
    lines: &[(usize, String)],
    vertices: usize,
    notes: &mut Vec<Note>,
) -> Result<Tags, ImportError> {
    let mut tags = Tags::default();
    let mut ignored: Vec<&str> = Vec::new();
    for (number, line) in lines {
        let tag = Tag::parse(file, *number, line, vertices)?;
        match tag.name {
            "crease" => tag.creases(&mut tags.creases)?,
            "corner" => tag.corners(&mut tags.corners)?,
            "interpolateboundary" => tags.boundary = Some(tag.boundary()?),
            "creasemethod" => tags.creasing = Some(tag.creasing()?),
            name => {
                if !ignored.contains(&name) {
                    ignored.push(name);
                }
            }
        }
    }
    for name in ignored {
        let known = name.starts_with("facevarying") || ["smoothtriangles", "trianglesubdiv"].contains(&name);
        let text = format!("tag '{name}' is not applied");
        notes.push(if known {
            Note::remark(file, text)
        } else {
            Note::warning(file, text)
        });
    }
    Ok(tags)
}

/// One line.
struct Tag<'a> {
    file: &'a Path,
    line: usize,
    vertices: usize,
    name: &'a str,
    integers: Vec<i64>,
    numbers: Vec<f64>,
    strings: Vec<&'a str>,
}

impl<'a> Tag<'a> {
    fn parse(file: &'a Path, line: usize, text: &'a str, vertices: usize) -> Result<Self, ImportError> {
        let malformed = |reason: String| ImportError::malformed(file, FilePlace::Line(line), reason);
        let mut words = text.split_ascii_whitespace().skip(1);
        let name = words.next().ok_or_else(|| malformed("a tag without a name".into()))?;
        let head = words.next().unwrap_or("");
        let counts: Option<Vec<usize>> = head.split('/').map(|count| count.parse().ok()).collect();
        let Some([integers, numbers, strings]) = counts.as_deref() else {
            let reason = format!(
                "tag '{name}': expected how many integers, numbers and strings follow, as in 2/1/0, found '{head}'"
            );
            return Err(malformed(reason));
        };
        let values: Vec<&str> = words.collect();
        let expected = [integers, numbers, strings]
            .into_iter()
            .try_fold(0usize, |sum, &count| sum.checked_add(count));
        if expected != Some(values.len()) {
            let reason = format!(
                "tag '{name}': {head} announces other values than the {} that follow",
                values.len()
            );
            return Err(malformed(reason));
        }
        let (first, rest) = values.split_at(*integers);
        let (second, strings) = rest.split_at(*numbers);
        let no_number = |word: &&str| {
            malformed(format!(
                "tag '{name}': '{word}' is no number of the kind that {head} says"
            ))
        };
        let integers: Result<_, _> = first
            .iter()
            .map(|word| word.parse().map_err(|_| no_number(word)))
            .collect();
        let numbers: Result<_, _> = second
            .iter()
            .map(|word| word.parse().map_err(|_| no_number(word)))
            .collect();
        Ok(Self {
            file,
            line,
            vertices,
            name,
            integers: integers?,
            numbers: numbers?,
            strings: strings.to_vec(),
        })
    }

    fn malformed(&self, reason: impl std::fmt::Display) -> ImportError {
        let reason = format!("tag '{}': {reason}", self.name);
        ImportError::malformed(self.file, FilePlace::Line(self.line), reason)
    }

    fn vertex(&self, index: i64) -> Result<u32, ImportError> {
        let found = u32::try_from(index).ok().filter(|&v| (v as usize) < self.vertices);
        found.ok_or_else(|| ImportError::IndexOutOfRange {
            file: self.file.to_path_buf(),
            place: FilePlace::Line(self.line),
            what: "vertex (tags count from 0)",
            index,
            count: self.vertices,
        })
    }

    /// The sharpness of element `index` of `count`.
    fn sharpness(&self, index: usize, count: usize) -> Result<f64, ImportError> {
        let value = match self.numbers[..] {
            [value] => value,
            ref values if values.len() == count => values[index],
            ref values => {
                let found = values.len();
                return Err(self.malformed(format!("{found} sharpnesses for {count}; expected one, or one each")));
            }
        };
        check_finite(self.file, || FilePlace::Line(self.line), "sharpness", &[value])?;
        if value < 0.0 {
            return Err(self.malformed(format!("the sharpness {value} is below 0")));
        }
        Ok(value)
    }

    fn creases(&self, creases: &mut Vec<Placed<Crease>>) -> Result<(), ImportError> {
        if self.integers.is_empty() || !self.integers.len().is_multiple_of(2) {
            let found = self.integers.len();
            return Err(self.malformed(format!("{found} vertices; expected pairs")));
        }
        let count = self.integers.len() / 2;
        for (index, pair) in self.integers.chunks_exact(2).enumerate() {
            let vertices = [self.vertex(pair[0])?, self.vertex(pair[1])?];
            let sharpness = self.sharpness(index, count)?;
            creases.push(self.placed(Crease { vertices, sharpness }));
        }
        Ok(())
    }

    fn corners(&self, corners: &mut Vec<Placed<Corner>>) -> Result<(), ImportError> {
        let count = self.integers.len();
        if count == 0 {
            return Err(self.malformed("no vertex; expected at least one"));
        }
        for (index, &vertex) in self.integers.iter().enumerate() {
            let (vertex, sharpness) = (self.vertex(vertex)?, self.sharpness(index, count)?);
            corners.push(self.placed(Corner { vertex, sharpness }));
        }
        Ok(())
    }

    fn placed<T>(&self, value: T) -> Placed<T> {
        Placed {
            value,
            place: FilePlace::Line(self.line),
        }
    }

    fn boundary(&self) -> Result<BoundaryRule, ImportError> {
        match self.integers[..] {
            [0] => Ok(BoundaryRule::None),
            [1] => Ok(BoundaryRule::EdgesAndCorners),
            [2] => Ok(BoundaryRule::Edges),
            _ => Err(self.malformed("expected one of 0 (none), 1 (edges and corners), 2 (edges)")),
        }
    }

    fn creasing(&self) -> Result<Creasing, ImportError> {
        match self.strings[..] {
            ["normal" | "uniform"] => Ok(Creasing::Uniform),
            ["chaikin"] => Ok(Creasing::Chaikin),
            _ => Err(self.malformed("expected one of normal, chaikin")),
        }
    }
}
