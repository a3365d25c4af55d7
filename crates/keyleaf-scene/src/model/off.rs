//! OFF (Object File Format of Geomview): polygons of any size, colours, normals, and covariances.
//!
//! ```text
//! OFF
//! # comment
//! 8 6 12                     vertices, faces, edges (the last is not read)
//! -1 -1 -1                   a vertex a line
//! 4 0 1 3 2                  a face a line: how many corners, their vertices from 0; colours after them are not read
//! ```
//!
//! `NOFF`, `COFF` and `CNOFF` have normals, colours, or both after the coordinates. After these a vertex may have six numbers more: its
//! covariance xx xy xz yy yz zz, an extension of keyleaf. Three or four numbers after the coordinates of a plain `OFF` are a colour.

use std::path::Path;

use glam::DVec3;

use crate::error::{FilePlace, ImportError};
use crate::note::Note;
use crate::soup::{Soup, check_finite, linear_from_srgb, unit};

/// Reads an OFF file from its bytes.
pub(super) fn read(file: &Path, bytes: &[u8], notes: &mut Vec<Note>) -> Result<Soup, ImportError> {
    let text = String::from_utf8_lossy(bytes);
    let mut lines = Lines {
        file,
        lines: text.lines().enumerate(),
        last: 1,
    };
    let mut first = lines.next("the keyword OFF")?;
    let head = first.words.next().unwrap_or("");
    let Some(mut columns) = Columns::of_keyword(head) else {
        let reason = format!("'{head}' is no keyword of OFF; expected OFF, COFF, NOFF or CNOFF, as text");
        return Err(ImportError::unsupported(file, FilePlace::Line(first.number), reason));
    };
    let mut rest = first.words.clone().peekable();
    if rest.peek().is_some_and(|word| word.eq_ignore_ascii_case("binary")) {
        let reason = "binary OFF files are not read; save the model as text";
        return Err(ImportError::unsupported(file, FilePlace::Line(first.number), reason));
    }
    let mut counts = if rest.peek().is_some() {
        first
    } else {
        lines.next("the counts")?
    };
    let vertices = counts.index(file, "number of vertices")?;
    let faces = counts.index(file, "number of faces")?;
    let mut soup = Soup {
        states_topology: true,
        ..Soup::default()
    };
    let mut attributes = Attributes::default();
    for vertex in 0..vertices {
        let line = lines.next("a vertex")?;
        let values = line.numbers(file)?;
        if vertex == 0 {
            columns.complete(file, line.number, values.len())?;
        }
        columns.push(file, line.number, &values, &mut soup, &mut attributes)?;
    }
    let mut coloured = 0;
    for _ in 0..faces {
        coloured += usize::from(face(file, lines.next("a face")?, &mut soup)?);
    }
    if coloured > 0 {
        notes.push(Note::remark(file, format!("colours of faces are not read: {coloured}")));
    }
    attributes.spread(&mut soup);
    Ok(soup)
}

/// A line with its number.
struct Line<'a> {
    number: usize,
    words: std::str::SplitAsciiWhitespace<'a>,
}

impl Line<'_> {
    fn index(&mut self, file: &Path, what: &str) -> Result<usize, ImportError> {
        let word = self.words.next().unwrap_or("");
        word.parse().map_err(|_| {
            let reason = format!("expected the {what}, a whole number of at least 0, found '{word}'");
            ImportError::malformed(file, FilePlace::Line(self.number), reason)
        })
    }

    fn numbers(&self, file: &Path) -> Result<Vec<f64>, ImportError> {
        let number = |word: &str| {
            word.parse().map_err(|_| {
                let reason = format!("'{word}' is no number");
                ImportError::malformed(file, FilePlace::Line(self.number), reason)
            })
        };
        self.words.clone().map(number).collect()
    }
}

/// The lines that hold anything, without comments.
struct Lines<'a> {
    file: &'a Path,
    lines: std::iter::Enumerate<std::str::Lines<'a>>,
    last: usize,
}

impl<'a> Lines<'a> {
    fn next(&mut self, wanted: &str) -> Result<Line<'a>, ImportError> {
        for (index, line) in self.lines.by_ref() {
            self.last = index + 1;
            let words = line.split('#').next().unwrap_or("").split_ascii_whitespace();
            if words.clone().next().is_some() {
                return Ok(Line {
                    number: self.last,
                    words,
                });
            }
        }
        let reason = format!("the file ends where {wanted} was expected");
        Err(ImportError::malformed(self.file, FilePlace::Line(self.last), reason))
    }
}

/// What the numbers of a vertex are.
struct Columns {
    has_normal: bool,
    /// Numbers of a colour: 0, 3 or 4.
    colour: usize,
    has_covariance: bool,
    count: usize,
}

impl Columns {
    fn of_keyword(keyword: &str) -> Option<Self> {
        let (has_normal, colour) = match keyword {
            "OFF" => (false, 0),
            "NOFF" => (true, 0),
            "COFF" => (false, 4),
            "CNOFF" | "NCOFF" => (true, 4),
            _ => return None,
        };
        Some(Self {
            has_normal,
            colour,
            has_covariance: false,
            count: 0,
        })
    }

    /// Decides by the number of columns of the first vertex.
    fn complete(&mut self, file: &Path, line: usize, count: usize) -> Result<(), ImportError> {
        self.count = count;
        let fixed = if self.has_normal { 6 } else { 3 };
        let is_plain = self.colour == 0;
        (self.colour, self.has_covariance) = match count.checked_sub(fixed) {
            Some(0) if is_plain => (0, false),
            Some(6) if is_plain => (0, true),
            Some(more @ (3 | 4)) => (more, false),
            Some(more @ (9 | 10)) => (more - 6, true),
            _ => {
                let reason = format!(
                    "a vertex with {count} numbers; expected 3 coordinates{}, then a colour of 3 or 4 numbers{}, then none or the 6 of a \
                     covariance",
                    if self.has_normal { ", a normal of 3" } else { "" },
                    if is_plain { " or none" } else { "" }
                );
                return Err(ImportError::malformed(file, FilePlace::Line(line), reason));
            }
        };
        Ok(())
    }

    fn push(
        &self,
        file: &Path,
        line: usize,
        values: &[f64],
        soup: &mut Soup,
        attributes: &mut Attributes,
    ) -> Result<(), ImportError> {
        let place = || FilePlace::Line(line);
        if values.len() != self.count {
            let reason = format!(
                "a vertex with {} numbers; the first one has {}",
                values.len(),
                self.count
            );
            return Err(ImportError::malformed(file, place(), reason));
        }
        let (position, mut rest) = values.split_at(3);
        check_finite(file, place, "position", position)?;
        soup.positions.push(DVec3::from_slice(position));
        if self.has_normal {
            check_finite(file, place, "normal", &rest[..3])?;
            attributes.normals.push(unit(DVec3::from_slice(rest)));
            rest = &rest[3..];
        }
        let (colour, covariance) = rest.split_at(self.colour);
        if !colour.is_empty() {
            check_finite(file, place, "colour", colour)?;
            let alpha = colour.get(3).copied();
            attributes.colours.push(([colour[0], colour[1], colour[2]], alpha));
        }
        if let (true, Ok(covariance)) = (self.has_covariance, <[f64; 6]>::try_from(covariance)) {
            check_finite(file, place, "covariance", &covariance)?;
            soup.covariances.push(covariance);
        }
        Ok(())
    }
}

/// Reads a face; whether more numbers stand after its corners.
fn face(file: &Path, mut line: Line<'_>, soup: &mut Soup) -> Result<bool, ImportError> {
    let place = FilePlace::Line(line.number);
    let corners = line.index(file, "number of corners")?;
    if corners < 3 {
        let reason = format!("a face needs at least 3 corners, this one has {corners}");
        return Err(ImportError::malformed(file, place, reason));
    }
    let count = soup.positions.len();
    for _ in 0..corners {
        let vertex = line.index(file, "vertex of a corner")?;
        if vertex >= count {
            return Err(ImportError::IndexOutOfRange {
                file: file.to_path_buf(),
                place,
                what: "vertex",
                index: vertex as i64,
                count,
            });
        }
        soup.corners.push(vertex as u32);
    }
    soup.ends.push(soup.corners.len() as u32);
    soup.lines.push(line.number as u32);
    Ok(line.words.next().is_some())
}

/// Attributes of the vertices; empty where the file has none.
#[derive(Default)]
struct Attributes {
    normals: Vec<[f32; 3]>,
    /// As they are seen (sRGB), 0..1 or 0..255, with an alpha.
    colours: Vec<([f64; 3], Option<f64>)>,
}

impl Attributes {
    /// Copies them to the corners.
    fn spread(&self, soup: &mut Soup) {
        let corners = soup.corners.iter().map(|&v| v as usize);
        if !self.normals.is_empty() {
            soup.normals = corners.clone().map(|v| self.normals[v]).collect();
        }
        if self.colours.is_empty() {
            return;
        }
        let largest = self
            .colours
            .iter()
            .flat_map(|(rgb, alpha)| rgb.iter().chain(alpha))
            .fold(0.0f64, |most, &c| most.max(c));
        // Geomview writes 0..1, others bytes.
        let full = if largest > 1.0 { 255.0 } else { 1.0 };
        let channel = |value: f64| (value / full).clamp(0.0, 1.0) as f32;
        let linear = |&([r, g, b], alpha): &([f64; 3], Option<f64>)| {
            let [r, g, b] = [r, g, b].map(|c| linear_from_srgb(channel(c)));
            [r, g, b, alpha.map_or(1.0, channel)]
        };
        let colours: Vec<[f32; 4]> = self.colours.iter().map(linear).collect();
        soup.colours = corners.map(|v| colours[v]).collect();
    }
}
