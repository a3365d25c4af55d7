//! STL, text and binary: a soup of triangles, in the order of the file.
//!
//! A reader of the project's own, since an error has to name a line or a facet. The normals of the file are not
//! read: the winding states the same, and the two often disagree.

use std::path::Path;

use glam::DVec3;

use crate::error::{FilePlace, ImportError};
use crate::note::Note;
use crate::soup::{Soup, check_finite};

/// Header and facet count of a binary file, in bytes.
const HEADER: usize = 84;
/// One facet of a binary file: normal, three corners, attribute.
const FACET: usize = 50;

/// Reads an STL file from its bytes.
pub(super) fn read(file: &Path, bytes: &[u8], notes: &mut Vec<Note>) -> Result<Soup, ImportError> {
    // Binary files may begin with "solid" too: their size gives them away.
    let declared = bytes
        .get(80..HEADER)
        .and_then(|b| b.try_into().ok())
        .map(u32::from_le_bytes);
    let exact = declared.is_some_and(|n| HEADER as u64 + FACET as u64 * u64::from(n) == bytes.len() as u64);
    let start = bytes.trim_ascii_start();
    if !exact && start.len() >= 5 && start[..5].eq_ignore_ascii_case(b"solid") {
        return read_text(file, &String::from_utf8_lossy(bytes));
    }
    let Some(declared) = declared else {
        let reason = format!(
            "the file ends after {} of the {HEADER} bytes of its header",
            bytes.len()
        );
        return Err(ImportError::malformed(
            file,
            FilePlace::Byte(bytes.len() as u64),
            reason,
        ));
    };
    read_binary(file, &bytes[HEADER..], declared as usize, notes)
}

fn read_binary(file: &Path, body: &[u8], declared: usize, notes: &mut Vec<Note>) -> Result<Soup, ImportError> {
    let present = body.len() / FACET;
    if present < declared {
        let reason = format!("the header announces {declared} facets, the file ends after {present}");
        return Err(ImportError::malformed(file, FilePlace::Face(present), reason));
    }
    if body.len() > declared * FACET {
        let rest = body.len() - declared * FACET;
        notes.push(Note::remark(
            file,
            format!("{rest} bytes after the last facet are not read"),
        ));
    }
    let mut soup = Soup::default();
    for (face, facet) in body.chunks_exact(FACET).take(declared).enumerate() {
        let mut numbers = facet.chunks_exact(4).map(|b| match *b {
            [a, b, c, d] => f64::from(f32::from_le_bytes([a, b, c, d])),
            _ => f64::NAN,
        });
        let mut next = || numbers.next().unwrap_or(f64::NAN);
        let _normal = [next(), next(), next()];
        for _ in 0..3 {
            push(file, &mut soup, || FilePlace::Face(face), [next(), next(), next()])?;
        }
        soup.ends.push(soup.corners.len() as u32);
    }
    Ok(soup)
}

fn read_text(file: &Path, text: &str) -> Result<Soup, ImportError> {
    let mut soup = Soup::default();
    let mut facet_line = None;
    for (index, line) in text.lines().enumerate() {
        let number = index + 1;
        let place = || FilePlace::Line(number);
        let mut words = line.split_ascii_whitespace();
        let keyword = words.next().unwrap_or("").to_ascii_lowercase();
        match keyword.as_str() {
            "facet" => facet_line = Some(number),
            "vertex" => {
                let mut values = [0.0; 3];
                for value in &mut values {
                    let word = words.next().unwrap_or("");
                    *value = word.parse().map_err(|_| {
                        let reason = format!("expected 3 numbers after 'vertex', found '{word}'");
                        ImportError::malformed(file, place(), reason)
                    })?;
                }
                push(file, &mut soup, place, values)?;
            }
            "endfacet" => {
                let first = soup.ends.last().copied().unwrap_or(0) as usize;
                let count = soup.corners.len() - first;
                if count != 3 {
                    let reason = format!("a facet has 3 vertices, this one has {count}");
                    return Err(ImportError::malformed(file, place(), reason));
                }
                soup.ends.push(soup.corners.len() as u32);
                soup.lines.push(facet_line.take().unwrap_or(number) as u32);
            }
            "" | "solid" | "outer" | "endloop" | "endsolid" | "color" => {}
            other => {
                let reason = format!("'{other}' is no keyword of STL");
                return Err(ImportError::malformed(file, place(), reason));
            }
        }
    }
    if soup.corners.len() != soup.ends.last().copied().unwrap_or(0) as usize || facet_line.is_some() {
        let place = FilePlace::Line(text.lines().count());
        return Err(ImportError::malformed(file, place, "the file ends inside a facet"));
    }
    Ok(soup)
}

fn push(file: &Path, soup: &mut Soup, place: impl Fn() -> FilePlace, position: [f64; 3]) -> Result<(), ImportError> {
    check_finite(file, place, "position", &position)?;
    soup.corners.push(soup.positions.len() as u32);
    soup.positions.push(DVec3::from(position));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "solid a name\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n\
        vertex 0 1e0 0\nendloop\nendfacet\nendsolid a name\n";

    fn parse(bytes: &[u8]) -> Result<Soup, String> {
        read(Path::new("t.stl"), bytes, &mut Vec::new()).map_err(|e| e.to_string())
    }

    /// Two triangles, written by another program's code.
    fn binary() -> Vec<u8> {
        let corner = stl_io::Vertex::new;
        let triangle = |z| stl_io::Triangle {
            normal: stl_io::Normal::new([0.0, 0.0, 1.0]),
            vertices: [corner([0.0, 0.0, z]), corner([1.5, 0.0, z]), corner([0.0, 2.5, z])],
        };
        let mut bytes = Vec::new();
        stl_io::write_stl(&mut bytes, [triangle(1.0), triangle(2.0)].iter()).unwrap();
        bytes
    }

    #[test]
    fn text_and_binary_are_read() {
        let soup = parse(TEXT.as_bytes()).unwrap();
        assert_eq!((soup.face_count(), soup.positions[2]), (1, DVec3::Y));
        assert_eq!(soup.place_of_face(0), FilePlace::Line(2));
        let soup = parse(&binary()).unwrap();
        assert_eq!((soup.face_count(), soup.positions[5]), (2, DVec3::new(0.0, 2.5, 2.0)));
    }

    #[test]
    fn binary_that_begins_with_solid_is_still_binary() {
        let mut bytes = binary();
        bytes[..5].copy_from_slice(b"solid");
        assert_eq!(parse(&bytes).unwrap().face_count(), 2);
    }

    #[test]
    fn every_truncation_is_an_error_or_a_smaller_whole_file() {
        let bytes = binary();
        for length in 0..bytes.len() {
            assert!(parse(&bytes[..length]).is_err(), "{length}");
        }
        for length in 0..TEXT.len() {
            if let Ok(soup) = parse(&TEXT.as_bytes()[..length]) {
                assert!(soup.corners.len() == 3 * soup.face_count());
            }
        }
    }

    #[test]
    fn errors_name_the_place() {
        let nan = TEXT.replace("1e0", "nan");
        assert!(parse(nan.as_bytes()).unwrap_err().contains("line 6: position is NaN"));
        let word = TEXT.replace("1e0", "one");
        assert!(parse(word.as_bytes()).unwrap_err().contains("line 6"));
        let mut bytes = binary();
        bytes[84 + 50 + 12..][..4].copy_from_slice(&f32::NAN.to_le_bytes());
        assert!(parse(&bytes).unwrap_err().contains("face 1: position is NaN"));
        assert!(parse(&bytes[..150]).unwrap_err().contains("announces 2 facets"));
    }
}
