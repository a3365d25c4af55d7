//! The header of a PLY file and the stream of numbers after it, text or binary.

use std::path::Path;

use crate::error::{FilePlace, ImportError};

/// Type of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Kind {
    fn from_name(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// The value of a colour channel that means 1.
    pub fn full_scale(self) -> f64 {
        match self {
            Self::I8 => f64::from(i8::MAX),
            Self::U8 => f64::from(u8::MAX),
            Self::I16 => f64::from(i16::MAX),
            Self::U16 => f64::from(u16::MAX),
            Self::I32 => f64::from(i32::MAX),
            Self::U32 => f64::from(u32::MAX),
            Self::F32 | Self::F64 => 1.0,
        }
    }
}

/// One number, or a list of numbers, of every item of an element.
#[derive(Debug)]
pub(super) struct Property {
    pub name: String,
    /// Type of the length, if it is a list.
    pub list: Option<Kind>,
    pub kind: Kind,
}

/// A table of the file: vertices, faces...
#[derive(Debug)]
pub(super) struct Element {
    pub name: String,
    pub count: usize,
    pub properties: Vec<Property>,
    /// Line of the header that declares it.
    pub line: usize,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// What stands before `end_header`.
#[derive(Debug)]
pub(super) struct Header {
    encoding: Encoding,
    pub elements: Vec<Element>,
    lines: usize,
    bytes: usize,
}

impl Header {
    /// Reads the header; gives it and the bytes after it.
    pub fn read<'a>(file: &Path, bytes: &'a [u8]) -> Result<(Self, &'a [u8]), ImportError> {
        let mut header = Self {
            encoding: Encoding::Text,
            elements: Vec::new(),
            lines: 0,
            bytes: 0,
        };
        let mut encoding = None;
        loop {
            let rest = &bytes[header.bytes..];
            let Some(length) = rest.iter().position(|&b| b == b'\n') else {
                let reason = if header.lines == 0 {
                    "not a PLY file: the first line is not 'ply'"
                } else {
                    "the file ends before 'end_header'"
                };
                return Err(ImportError::malformed(file, FilePlace::Line(header.lines + 1), reason));
            };
            header.bytes += length + 1;
            header.lines += 1;
            let text = String::from_utf8_lossy(&rest[..length]);
            let words: Vec<&str> = text.split_ascii_whitespace().collect();
            let malformed = |reason: String| ImportError::malformed(file, FilePlace::Line(header.lines), reason);
            match words.as_slice() {
                ["ply"] if header.lines == 1 => {}
                _ if header.lines == 1 => {
                    return Err(malformed("not a PLY file: the first line is not 'ply'".into()));
                }
                [] | ["comment" | "obj_info", ..] => {}
                ["format", name, "1.0"] => {
                    encoding = Some(match *name {
                        "ascii" => Encoding::Text,
                        "binary_little_endian" => Encoding::LittleEndian,
                        "binary_big_endian" => Encoding::BigEndian,
                        other => return Err(malformed(format!("unknown format '{other}'"))),
                    });
                }
                ["element", name, count] => {
                    let count = count
                        .parse()
                        .map_err(|_| malformed(format!("'{count}' is no number of elements")))?;
                    let line = header.lines;
                    let name = (*name).to_owned();
                    header.elements.push(Element {
                        name,
                        count,
                        properties: Vec::new(),
                        line,
                    });
                }
                ["property", words @ ..] => {
                    let property = property(words).ok_or_else(|| malformed(format!("'{text}' is no property")))?;
                    let Some(element) = header.elements.last_mut() else {
                        return Err(malformed("a property before the first element".into()));
                    };
                    element.properties.push(property);
                }
                ["end_header"] => break,
                _ => return Err(malformed(format!("'{text}' is no line of a PLY 1.0 header"))),
            }
        }
        header.encoding = encoding
            .ok_or_else(|| ImportError::malformed(file, FilePlace::Line(header.lines), "the header has no format"))?;
        let body = &bytes[header.bytes..];
        Ok((header, body))
    }
}

fn property(words: &[&str]) -> Option<Property> {
    match *words {
        ["list", length, kind, name] => Some(Property {
            name: name.to_owned(),
            list: Some(Kind::from_name(length)?),
            kind: Kind::from_name(kind)?,
        }),
        [kind, name] => Some(Property {
            name: name.to_owned(),
            list: None,
            kind: Kind::from_name(kind)?,
        }),
        _ => None,
    }
}

/// The numbers after the header, one after the other.
pub(super) struct Values<'a> {
    file: &'a Path,
    encoding: Encoding,
    rest: &'a [u8],
    /// Line (text) or byte (binary) of the next number.
    at: usize,
}

impl<'a> Values<'a> {
    pub fn new(file: &'a Path, header: &Header, body: &'a [u8]) -> Self {
        let text = header.encoding == Encoding::Text;
        let at = if text { header.lines + 1 } else { header.bytes };
        Self {
            file,
            encoding: header.encoding,
            rest: body,
            at,
        }
    }

    /// The line of the next number, if the file has lines.
    pub fn line(&mut self) -> Option<usize> {
        if self.encoding != Encoding::Text {
            return None;
        }
        self.skip_spaces();
        Some(self.at)
    }

    fn place(&self) -> FilePlace {
        match self.encoding {
            Encoding::Text => FilePlace::Line(self.at),
            _ => FilePlace::Byte(self.at as u64),
        }
    }

    fn skip_spaces(&mut self) {
        let spaces = self.rest.iter().take_while(|b| b.is_ascii_whitespace()).count();
        self.at += self.rest[..spaces].iter().filter(|&&b| b == b'\n').count();
        self.rest = &self.rest[spaces..];
    }

    /// How many numbers the next property has: 1, or the length that a list begins with.
    pub fn list_length(&mut self, property: &Property) -> Result<usize, ImportError> {
        let Some(kind) = property.list else { return Ok(1) };
        let place = self.place();
        let length = self.number(kind)?;
        // A list cannot be longer than what is left of the file.
        if !(length >= 0.0 && length <= self.rest.len() as f64 && length.fract() == 0.0) {
            let reason = format!("a list '{}' of {length} numbers does not fit the file", property.name);
            return Err(ImportError::malformed(self.file, place, reason));
        }
        Ok(length as usize)
    }

    /// The next number; all types are exact in f64.
    pub fn number(&mut self, kind: Kind) -> Result<f64, ImportError> {
        if self.encoding == Encoding::Text {
            self.text_number()
        } else {
            self.binary_number(kind)
        }
    }

    fn text_number(&mut self) -> Result<f64, ImportError> {
        self.skip_spaces();
        let length = self.rest.iter().take_while(|b| !b.is_ascii_whitespace()).count();
        if length == 0 {
            return Err(self.truncated());
        }
        let (word, rest) = self.rest.split_at(length);
        let word = String::from_utf8_lossy(word);
        let value = word
            .parse()
            .map_err(|_| ImportError::malformed(self.file, self.place(), format!("'{word}' is no number")))?;
        self.rest = rest;
        Ok(value)
    }

    fn binary_number(&mut self, kind: Kind) -> Result<f64, ImportError> {
        let size = kind.size();
        let Some((bytes, rest)) = self.rest.split_at_checked(size) else {
            return Err(self.truncated());
        };
        let mut word = [0; 8];
        word[..size].copy_from_slice(bytes);
        if self.encoding == Encoding::BigEndian {
            word[..size].reverse();
        }
        self.rest = rest;
        self.at += size;
        let [a, b, c, d, ..] = word;
        Ok(match kind {
            Kind::I8 => f64::from(a as i8),
            Kind::U8 => f64::from(a),
            Kind::I16 => f64::from(i16::from_le_bytes([a, b])),
            Kind::U16 => f64::from(u16::from_le_bytes([a, b])),
            Kind::I32 => f64::from(i32::from_le_bytes([a, b, c, d])),
            Kind::U32 => f64::from(u32::from_le_bytes([a, b, c, d])),
            Kind::F32 => f64::from(f32::from_le_bytes([a, b, c, d])),
            Kind::F64 => f64::from_le_bytes(word),
        })
    }

    fn truncated(&self) -> ImportError {
        let reason = "the file ends before all its elements are read";
        ImportError::malformed(self.file, self.place(), reason)
    }
}
