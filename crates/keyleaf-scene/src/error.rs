//! What can be wrong with a model, an image or a height map: which file, where in it, and why.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use keyleaf_key::TopologyError;
use thiserror::Error;

/// A place inside a file, in the words of its format. Indices are 0-based, lines 1-based.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FilePlace {
    /// The file as a whole.
    Whole,
    /// A line of a text format.
    Line(usize),
    /// A byte offset of a binary format.
    Byte(u64),
    /// A vertex, in the order of the file.
    Vertex(usize),
    /// A face (facet, primitive triangle), in the order of the file.
    Face(usize),
    /// A sample of a height map.
    Sample {
        /// Row, 0 at the top of the picture.
        row: usize,
        /// Column, 0 at the left.
        column: usize,
    },
    /// A part that the format names itself, such as `mesh 0, primitive 2`.
    Part(String),
}

impl fmt::Display for FilePlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Whole => Ok(()),
            Self::Line(line) => write!(f, "line {line}: "),
            Self::Byte(byte) => write!(f, "byte {byte}: "),
            Self::Vertex(vertex) => write!(f, "vertex {vertex}: "),
            Self::Face(face) => write!(f, "face {face}: "),
            Self::Sample { row, column } => write!(f, "row {row}, column {column}: "),
            Self::Part(part) => write!(f, "{part}: "),
        }
    }
}

/// Why a model, an image or a height map was refused.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ImportError {
    /// The file is missing or cannot be read.
    #[error("{}: cannot be read: {source}", file.display())]
    Read {
        /// The file.
        file: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The name ends in something that no importer knows.
    #[error("{}: unknown file type '{extension}'; expected one of {expected}", file.display())]
    UnknownExtension {
        /// The file.
        file: PathBuf,
        /// What the name ends in; empty if there is no dot.
        extension: String,
        /// The known endings, separated by commas.
        expected: &'static str,
    },
    /// Truncated, or against the rules of its format.
    #[error("{}: {place}{reason}", file.display())]
    Malformed {
        /// The file.
        file: PathBuf,
        /// Where.
        place: FilePlace,
        /// What is wrong, and what was expected.
        reason: String,
    },
    /// Valid, but with something that keyleaf does not read.
    #[error("{}: {place}{reason}", file.display())]
    Unsupported {
        /// The file.
        file: PathBuf,
        /// Where.
        place: FilePlace,
        /// What is not read, and what to do about it.
        reason: String,
    },
    /// A face or an accessor refers to an element that is not there.
    #[error(
        "{}: {place}{what} {index} is out of range: there are {count}",
        file.display()
    )]
    IndexOutOfRange {
        /// The file.
        file: PathBuf,
        /// Where.
        place: FilePlace,
        /// What the index counts, such as `vertex`.
        what: &'static str,
        /// The index as the file writes it.
        index: i64,
        /// How many elements there are.
        count: usize,
    },
    /// A coordinate is NaN, infinite, or beyond [`crate::MAX_COORDINATE`].
    #[error(
        "{}: {place}{what} is {value}; every number must be finite and at most {:e} in size",
        file.display(),
        crate::MAX_COORDINATE
    )]
    NotFinite {
        /// The file.
        file: PathBuf,
        /// Where.
        place: FilePlace,
        /// Which number, such as `position`.
        what: &'static str,
        /// The offending number.
        value: f64,
    },
    /// Nothing to draw.
    #[error("{}: {reason}", file.display())]
    Empty {
        /// The file.
        file: PathBuf,
        /// What is missing.
        reason: String,
    },
    /// The faces do not form a surface: an edge with three faces, inconsistent winding...
    #[error("{}: {source}{origin}", file.display())]
    Topology {
        /// The file.
        file: PathBuf,
        /// What `keyleaf-key` found, in faces and vertices of the imported mesh.
        source: TopologyError,
        /// Where these faces stand in the file, if that is known; else empty.
        origin: String,
    },
}

impl ImportError {
    /// A [`ImportError::Malformed`] without ceremony.
    pub(crate) fn malformed(file: &Path, place: FilePlace, reason: impl Into<String>) -> Self {
        Self::Malformed {
            file: file.to_path_buf(),
            place,
            reason: reason.into(),
        }
    }

    /// An [`ImportError::Unsupported`] without ceremony.
    pub(crate) fn unsupported(file: &Path, place: FilePlace, reason: impl Into<String>) -> Self {
        Self::Unsupported {
            file: file.to_path_buf(),
            place,
            reason: reason.into(),
        }
    }

    /// An [`ImportError::Empty`] without ceremony.
    pub(crate) fn empty(file: &Path, reason: impl Into<String>) -> Self {
        Self::Empty {
            file: file.to_path_buf(),
            reason: reason.into(),
        }
    }

    /// The file that was refused.
    pub fn file(&self) -> &Path {
        match self {
            Self::Read { file, .. }
            | Self::UnknownExtension { file, .. }
            | Self::Malformed { file, .. }
            | Self::Unsupported { file, .. }
            | Self::IndexOutOfRange { file, .. }
            | Self::NotFinite { file, .. }
            | Self::Empty { file, .. }
            | Self::Topology { file, .. } => file,
        }
    }
}

/// Reads a whole file; a folder or a missing file is an [`ImportError::Read`].
pub(crate) fn read_file(file: &Path) -> Result<Vec<u8>, ImportError> {
    std::fs::read(file).map_err(|source| ImportError::Read {
        file: file.to_path_buf(),
        source,
    })
}

/// The ending of a file name in lower case, without the dot; empty if there is none.
pub(crate) fn extension(file: &Path) -> String {
    file.extension()
        .map(|e| e.to_string_lossy().to_lowercase())
        .unwrap_or_default()
}
