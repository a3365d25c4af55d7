//! What can be wrong with the file of a run.

use std::path::PathBuf;
use thiserror::Error;

/// A record that cannot be read or written.
#[derive(Debug, Error)]
pub enum RunError {
    /// The file cannot be opened or read.
    #[error("{}: cannot be read: {source}", file.display())]
    Read {
        /// The file.
        file: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The text is no JSON, or not that of a record.
    #[error("{}:{line}:{column}: {reason}; expected a file that `keyleaf bench --out` wrote", file.display())]
    Syntax {
        /// The file.
        file: PathBuf,
        /// The line, from 1.
        line: usize,
        /// The column, from 1.
        column: usize,
        /// What is wrong there.
        reason: String,
    },
    /// There is no `schema`: the file is of another program, or older than the format.
    #[error("{}: has no \"schema\"; expected a file that `keyleaf bench --out` wrote: measure again", file.display())]
    NoSchema {
        /// The file.
        file: PathBuf,
    },
    /// The format has another number.
    #[error(
        "{}: has schema {found}, and this program reads {}: measure again, or use the program that wrote it",
        file.display(),
        super::SCHEMA
    )]
    Schema {
        /// The file.
        file: PathBuf,
        /// The number that it has.
        found: u64,
    },
    /// A value cannot have been measured.
    #[error("{}: run {run} ({scene}): {field} {reason}", file.display())]
    Value {
        /// The file.
        file: PathBuf,
        /// Which of its runs, from 1.
        run: usize,
        /// Name of the scene.
        scene: String,
        /// The field.
        field: String,
        /// What is wrong with it.
        reason: String,
    },
    /// The file holds no runs.
    #[error("{}: holds no runs; expected one at least", file.display())]
    Empty {
        /// The file.
        file: PathBuf,
    },
}
