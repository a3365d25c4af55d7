//! What an importer did to a file that its author may want to know. Returned as a list, never printed.

use std::fmt;
use std::path::{Path, PathBuf};

/// How much a note matters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// Something was done that does not change what is seen.
    Note,
    /// Something may look or run differently from what the author expects.
    Warning,
}

/// One remark about one file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Note {
    /// How much it matters.
    pub severity: Severity,
    /// The file it is about.
    pub file: PathBuf,
    /// One sentence.
    pub text: String,
}

impl Note {
    /// A note of severity [`Severity::Note`].
    pub fn remark(file: &Path, text: impl Into<String>) -> Self {
        Self {
            severity: Severity::Note,
            file: file.to_path_buf(),
            text: text.into(),
        }
    }

    /// A note of severity [`Severity::Warning`].
    pub fn warning(file: &Path, text: impl Into<String>) -> Self {
        Self {
            severity: Severity::Warning,
            file: file.to_path_buf(),
            text: text.into(),
        }
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kind = match self.severity {
            Severity::Note => "note",
            Severity::Warning => "warning",
        };
        write!(f, "{kind}: {}: {}", self.file.display(), self.text)
    }
}
