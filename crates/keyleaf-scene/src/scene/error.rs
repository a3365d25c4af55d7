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
        Self { field: field.into(), problem: problem.into() }
    }

    /// Looks for the field in the text of the scene, or, where it is left out, for what it would stand in.
    pub fn at(self, file: &Path, text: &str) -> SceneError {
        let fields = locate::fields(text);
        let mut wanted = self.field.as_str();
        let found = loop {
            if let Some(found) = fields.iter().find(|f| f.path == wanted) {
                break Some(found);
            }
            match wanted.rfind(['.', '[']) {
                Some(end) => wanted = &wanted[..end],
                None => break None,
            }
        };
        SceneError::Invalid {
            file: file.to_path_buf(),
            line: found.map(|f| f.start.0),
            column: found.map(|f| f.start.1),
            field: self.field,
            problem: self.problem,
        }
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
            let known = fields.iter().find(|f| f.name() == found && f.key.0 <= end.0 && f.end >= start);
            let at = known.map_or(start, |f| f.key);
            let path = known.map_or(String::new(), Field::parent);
            (at, path, format!("unknown field `{found}`, expected one of {}", listed(expected)))
        }
        Error::NoSuchEnumVariant { expected, found, .. } => {
            let path = innermost(&fields, end);
            (start, path, format!("unknown choice `{found}`, expected one of {}", listed(expected)))
        }
        Error::MissingStructField { field, .. } => {
            // The error is found at the end of the struct that lacks it.
            let inside = fields.iter().rfind(|f| f.end <= end && f.is_struct);
            let path = inside.map_or(String::new(), |f| f.path.clone());
            let at = inside.map_or(start, |f| f.start);
            (at, path, format!("missing field `{field}`"))
        }
        Error::DuplicateStructField { field, .. } => {
            (start, innermost(&fields, end), format!("field `{field}` is there twice"))
        }
        other => (start, innermost(&fields, end), lower_first(&other.to_string())),
    };
    SceneError::Syntax { file: file.to_path_buf(), line: at.0, column: at.1, field, problem }
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
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

fn lower_first(text: &str) -> String {
    let mut characters = text.chars();
    characters.next().map_or(String::new(), |c| c.to_lowercase().chain(characters).collect())
}
