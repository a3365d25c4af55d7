//! The text of Wavefront OBJ files: lines, numbers and indices, for polygons and for free-form surfaces.

use std::path::Path;

use crate::error::{FilePlace, ImportError};
use crate::soup::check_finite;

/// Calls `read` with every line without its comment, and the number of the first of the lines that a `\` joins.
pub(crate) fn for_each_line(
    file: &Path,
    text: &str,
    mut read: impl FnMut(usize, &str) -> Result<(), ImportError>,
) -> Result<(), ImportError> {
    let mut joined = String::new();
    let mut first_line = 0;
    for (index, line) in text.lines().enumerate() {
        let number = index + 1;
        let line = line.split('#').next().unwrap_or("");
        if let Some(start) = line.trim_end().strip_suffix('\\') {
            if joined.is_empty() {
                first_line = number;
            }
            joined.push_str(start);
            joined.push(' ');
            continue;
        }
        if joined.is_empty() {
            read(number, line)?;
        } else {
            joined.push_str(line);
            read(first_line, &joined)?;
            joined.clear();
        }
    }
    if joined.is_empty() {
        return Ok(());
    }
    let place = FilePlace::Line(text.lines().count());
    let reason = "the last line ends in a continuation '\\'";
    Err(ImportError::malformed(file, place, reason))
}

/// The rest of a line after its keyword, trimmed: names may hold spaces.
pub(crate) fn rest_of<'a>(line: &'a str, keyword: &str) -> &'a str {
    line.trim_start().strip_prefix(keyword).unwrap_or("").trim()
}

/// Up to `N` finite numbers, at least `least` of them, and how many there were. More are ignored.
pub(crate) fn numbers<'a, const N: usize>(
    file: &Path,
    line: usize,
    keyword: &'static str,
    least: usize,
    words: impl Iterator<Item = &'a str>,
) -> Result<([f64; N], usize), ImportError> {
    let mut values = [0.0; N];
    let mut count = 0;
    for (value, word) in values.iter_mut().zip(words) {
        *value = word.parse().map_err(|_| {
            let reason = format!("'{word}' after '{keyword}' is no number");
            ImportError::malformed(file, FilePlace::Line(line), reason)
        })?;
        count += 1;
    }
    if count < least {
        let reason = format!("'{keyword}' needs at least {least} numbers, found {count}");
        return Err(ImportError::malformed(file, FilePlace::Line(line), reason));
    }
    check_finite(file, || FilePlace::Line(line), keyword, &values)?;
    Ok((values, count))
}

/// A 1-based or, if negative, backward index as a 0-based one.
pub(crate) fn index(
    file: &Path,
    line: usize,
    what: &'static str,
    text: &str,
    count: usize,
) -> Result<u32, ImportError> {
    let place = FilePlace::Line(line);
    let Ok(index) = text.parse::<i64>() else {
        let reason = format!("'{text}' is no {what} index");
        return Err(ImportError::malformed(file, place, reason));
    };
    let from_start = if index > 0 {
        index - 1
    } else {
        index.saturating_add(count as i64)
    };
    if index == 0 || from_start < 0 || from_start >= count as i64 {
        return Err(ImportError::IndexOutOfRange {
            file: file.to_path_buf(),
            place,
            what,
            index,
            count,
        });
    }
    Ok(from_start as u32)
}
