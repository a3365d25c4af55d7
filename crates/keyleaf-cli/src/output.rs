//! Results: to stdout, or to a file that is whole or not there.

use anyhow::{Context, ensure};
use serde::Serialize;
use std::io::{ErrorKind, Write};
use std::path::Path;

/// Prints a result. A reader that has gone away is no error.
pub fn print(text: &str) -> anyhow::Result<()> {
    match writeln!(std::io::stdout().lock(), "{text}") {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        result => result.context("cannot write to standard output"),
    }
}

/// Prints a result as JSON.
pub fn print_json(value: &impl Serialize) -> anyhow::Result<()> {
    print(&serde_json::to_string_pretty(value)?)
}

/// Says no before long work whose result could not be written.
pub fn ensure_writable(file: &Path) -> anyhow::Result<()> {
    let folder = file
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    ensure!(
        folder.is_dir(),
        "{}: there is no folder {}",
        file.display(),
        folder.display()
    );
    ensure!(!file.is_dir(), "{}: this is a folder", file.display());
    Ok(())
}

/// Writes a file, whole or not at all.
pub fn write(file: &Path, bytes: &[u8]) -> anyhow::Result<()> {
    keyleaf_scene::write_whole(file, |out| out.write_all(bytes))
        .with_context(|| format!("{}: cannot be written", file.display()))
}

/// The ending of a file's name in lower case.
pub fn extension(file: &Path) -> String {
    file.extension().unwrap_or_default().to_string_lossy().to_lowercase()
}

/// A whole number with commas between thousands.
pub fn thousands(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    #[test]
    fn thousands_have_commas() {
        let texts = [0, 999, 1000, 1_234_567].map(super::thousands);
        assert_eq!(texts, ["0", "999", "1,000", "1,234,567"]);
    }
}
