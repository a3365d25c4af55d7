//! What can be wrong with a scene file: file, line, column, field, and what was expected.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::locate::{self, Field};

/// Why a scene was refused.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The file is missing or cannot be read.
    #[error("{}: cannot be read: {source}", file.display())]
    Read {
        /// The file.
        file: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The text is no scene: broken RON, an unknown field, a value of the wrong type.
    #[error("{}:{line}:{column}: {}{problem}", file.display(), locate::prefix(field))]
    Syntax {
        /// The file.
        file: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Column in characters, from 1.
        column: usize,
        /// The field, such as `paths[0].keys[1].eye`; empty at the outermost level.
        field: String,
        /// What is wrong, and what was expected.
        problem: String,
    },
    /// A value is out of its range, or two values do not fit each other.
    #[error("{}:{} {}{problem}", file.display(), locate::position(line, column), locate::prefix(field))]
    Invalid {
        /// The file.
        file: PathBuf,
        /// Line, from 1, if the field stands in the file.
        line: Option<usize>,
        /// Column in characters, from 1.
        column: Option<usize>,
        /// The field, such as `settings.capacity`.
        field: String,
        /// What is wrong, and what was expected.
        problem: String,
    },
    /// A file that the scene refers to was refused, or cannot be made the surface that the scene asks for.
    #[error("{}:{} {}{source}", file.display(), locate::position(line, column), locate::prefix(field))]
    Reference {
        /// The scene file.
        file: PathBuf,
        /// Line, from 1, if the field stands in the file.
        line: Option<usize>,
        /// Column in characters, from 1.
        column: Option<usize>,
        /// The field, such as `surfaces[0].source`.
        field: String,
        /// Why.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// The scene cannot be written as RON.
    #[error("the scene cannot be written: {reason}")]
    Write {
        /// Why.
        reason: String,
    },
}

/// A problem with one field, before it is known where the field stands.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Problem {
    pub field: String,
    pub problem: String,
}

impl Problem {
    pub fn new(field: impl Into<String>, problem: impl Into<String>) -> Self {
        Self {
            field: field.into(),
            problem: problem.into(),
        }
    }

    /// As an error, with the place of the field in the text of the scene.
    pub fn at(self, file: &Path, text: &str) -> SceneError {
        let (line, column) = place_of(&self.field, text).unzip();
        let Self { field, problem } = self;
        SceneError::Invalid {
            file: file.to_path_buf(),
            line,
            column,
            field,
            problem,
        }
    }
}

/// What is wrong with a file that a field refers to.
pub(crate) fn reference(
    file: &Path,
    text: &str,
    field: String,
    source: impl Into<Box<dyn std::error::Error + Send + Sync>>,
) -> SceneError {
    let (line, column) = place_of(&field, text).unzip();
    let source = source.into();
    SceneError::Reference {
        file: file.to_path_buf(),
        line,
        column,
        field,
        source,
    }
}

/// Where a field stands in the text of a scene, or, where it is left out, what it would stand in.
fn place_of(field: &str, text: &str) -> Option<(usize, usize)> {
    let fields = locate::fields(text);
    let mut wanted = field;
    loop {
        if let Some(found) = fields.iter().find(|f| f.path == wanted) {
            return Some(found.start);
        }
        wanted = &wanted[..wanted.rfind(['.', '['])?];
    }
}

/// Wraps what RON says: with the field, and with the names that would have been right.
pub(super) fn syntax(file: &Path, text: &str, error: &ron::error::SpannedError) -> SceneError {
    use ron::error::Error;
    let fields = locate::fields(text);
    let start = (error.span.start.line, error.span.start.col);
    let end = (error.span.end.line, error.span.end.col);
    let (at, field, problem) = match &error.code {
        Error::NoSuchStructField { expected, found, .. } => {
            let known = fields
                .iter()
                .find(|f| f.name() == found && f.key.0 <= end.0 && f.end >= start);
            let at = known.map_or(start, |f| f.key);
            let path = known.map_or(String::new(), Field::parent);
            (
                at,
                path,
                format!("unknown field `{found}`, expected one of {}", listed(expected)),
            )
        }
        Error::NoSuchEnumVariant { expected, found, .. } => {
            let path = innermost(&fields, end);
            (
                start,
                path,
                format!("unknown choice `{found}`, expected one of {}", listed(expected)),
            )
        }
        Error::MissingStructField { field, .. } => {
            // The error is found before the closing bracket of the struct that lacks it.
            let around = |f: &&Field| f.is_struct && f.start <= end && end < f.end;
            let inside = fields.iter().filter(around).max_by_key(|f| f.start);
            let path = inside.map_or(String::new(), |f| f.path.clone());
            let at = inside.map_or(start, |f| f.start);
            (at, path, format!("missing field `{field}`"))
        }
        Error::DuplicateStructField { field, .. } => (
            start,
            innermost(&fields, end),
            format!("field `{field}` is there twice"),
        ),
        other => {
            let field = innermost(&fields, end);
            // RON counts from the end of what came before.
            let value = fields.iter().find(|f| f.path == field).map_or(start, |f| f.start);
            let at = if start <= value && value <= end { value } else { start };
            (at, field, lower_first(&other.to_string()))
        }
    };
    SceneError::Syntax {
        file: file.to_path_buf(),
        line: at.0,
        column: at.1,
        field,
        problem,
    }
}

/// The path of the smallest field around a position.
fn innermost(fields: &[Field], at: (usize, usize)) -> String {
    fields
        .iter()
        .filter(|f| f.start <= at && at <= f.end)
        .max_by_key(|f| f.start)
        .map_or(String::new(), |f| f.path.clone())
}

fn listed(names: &[&str]) -> String {
    names
        .iter()
        .map(|name| format!("`{name}`"))
        .collect::<Vec<_>>()
        .join(", ")
}

fn lower_first(text: &str) -> String {
    let mut characters = text.chars();
    characters
        .next()
        .map_or(String::new(), |c| c.to_lowercase().chain(characters).collect())
}
