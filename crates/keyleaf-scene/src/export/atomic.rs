//! Whole files or none.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

/// Writes a file so that at no time there is a part of it under its name: to a temporary file in the same folder,
/// which is then renamed. If `write` or the system fails, the temporary file is removed and `file` is as before.
///
/// # Errors
/// What `write` or the system says.
pub fn write_whole(file: &Path, write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> io::Result<()> {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    let Some(name) = file.file_name() else {
        return Err(io::Error::new(
            io::ErrorKind::InvalidInput,
            "this is not the name of a file",
        ));
    };
    let number = COUNT.fetch_add(1, Ordering::Relaxed);
    let mut temporary_name = OsString::from(".");
    temporary_name.push(name);
    temporary_name.push(format!(".{}.{number}.part", std::process::id()));
    let temporary = file.with_file_name(temporary_name);
    let result = File::create_new(&temporary).and_then(|created| {
        let mut out = BufWriter::with_capacity(1 << 16, created);
        write(&mut out)?;
        out.flush()?;
        // Closed before it is renamed, as Windows asks for.
        drop(out);
        fs::rename(&temporary, file)
    });
    if result.is_err() {
        // There may be none, if creating it failed.
        let _ = fs::remove_file(&temporary);
    }
    result
}
