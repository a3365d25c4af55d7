//! Other programs: cargo, keyleaf, the package manager.

use std::ffi::OsString;
use std::fmt;
use std::path::PathBuf;
use std::process::{Command, ExitStatus, Stdio};

use anyhow::Context;

/// A failure with an exit code of its own.
#[derive(Debug)]
pub struct Failed {
    /// The exit code for the shell.
    pub code: u8,
    message: String,
}

impl Failed {
    /// Bad use, or a machine that lacks something: exit code 2.
    pub fn bad_use(message: impl Into<String>) -> Self {
        Self {
            code: 2,
            message: message.into(),
        }
    }

    /// The same failure without a message of its own, since the command that failed has said enough.
    pub fn silently(error: anyhow::Error) -> anyhow::Error {
        match error.downcast_ref::<Self>() {
            Some(failed) => Self {
                code: failed.code,
                message: String::new(),
            }
            .into(),
            None => error,
        }
    }

    /// A command ended with `status`: its exit code, or 1 where it has none (a signal).
    fn command(command: &Command, status: ExitStatus) -> Self {
        let code = status.code().and_then(|code| u8::try_from(code).ok()).unwrap_or(1);
        Self {
            code,
            message: format!("`{}` failed: {status}", line(command)),
        }
    }
}

impl fmt::Display for Failed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Failed {}

/// The command as one line, for messages.
fn line(command: &Command) -> String {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    words.map(|word| word.to_string_lossy()).collect::<Vec<_>>().join(" ")
}

/// Runs a command that writes to this terminal and reads nothing.
///
/// # Errors
/// The program cannot be started, or ends with another code than 0.
pub fn run(command: &mut Command) -> anyhow::Result<()> {
    let status = command
        .stdin(Stdio::null())
        .status()
        .with_context(|| format!("cannot start `{}`", line(command)))?;
    if status.success() {
        Ok(())
    } else {
        Err(Failed::command(command, status).into())
    }
}

/// Runs a command and returns what it wrote to its standard output; its messages go to this terminal.
///
/// # Errors
/// As [`run`], or the output is not UTF-8.
pub fn output(command: &mut Command) -> anyhow::Result<String> {
    let output = command
        .stdin(Stdio::null())
        .stderr(Stdio::inherit())
        .output()
        .with_context(|| format!("cannot start `{}`", line(command)))?;
    if !output.status.success() {
        return Err(Failed::command(command, output.status).into());
    }
    String::from_utf8(output.stdout).with_context(|| format!("`{}` wrote bytes that are not UTF-8", line(command)))
}

/// Whether a command can be started and ends with code 0; it writes nothing.
pub fn succeeds(program: &str, arguments: &[&str]) -> bool {
    let mut command = Command::new(program);
    command
        .args(arguments)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    command.status().is_ok_and(|status| status.success())
}

/// Runs the cargo that runs this program, in the root of the workspace.
///
/// # Errors
/// As [`run`].
pub fn cargo(arguments: &[&str]) -> anyhow::Result<()> {
    let program = std::env::var_os("CARGO").unwrap_or_else(|| OsString::from("cargo"));
    run(Command::new(program).args(arguments).current_dir(workspace()))
}

/// The root of the workspace: two folders above this crate.
pub fn workspace() -> PathBuf {
    let here = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    here.ancestors().nth(2).map(PathBuf::from).unwrap_or(here)
}
