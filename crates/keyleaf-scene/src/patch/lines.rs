//! Text files of which every line holds a fixed number of values, in a fixed order.

use std::path::Path;
use std::str::FromStr;

use glam::DVec3;

use crate::error::{FilePlace, ImportError};
use crate::soup::check_finite;

/// The lines of a file that are not blank, each with its number.
pub(super) struct Lines<'a> {
    file: &'a Path,
    rest: std::iter::Enumerate<std::str::Lines<'a>>,
    /// The line that was read last.
    number: usize,
}

impl<'a> Lines<'a> {
    pub fn new(file: &'a Path, text: &'a str) -> Self {
        Self {
            file,
            rest: text.lines().enumerate(),
            number: 0,
        }
    }

    /// An error about the line that was read last.
    pub fn error(&self, reason: impl Into<String>) -> ImportError {
        ImportError::malformed(self.file, FilePlace::Line(self.number.max(1)), reason)
    }

    /// The line that was read last.
    pub fn number(&self) -> usize {
        self.number
    }

    fn next(&mut self) -> Option<&'a str> {
        let (index, line) = self.rest.find(|(_, line)| !line.trim().is_empty())?;
        self.number = index + 1;
        Some(line)
    }

    /// The next line as `N` values, separated by blanks or commas. `what` is what they are.
    pub fn values<T: FromStr + Copy + Default, const N: usize>(&mut self, what: &str) -> Result<[T; N], ImportError> {
        let Some(line) = self.next() else {
            return Err(self.error(format!("the file ends after this line; expected {what}")));
        };
        let words = || {
            line.split(|c: char| c == ',' || c.is_whitespace())
                .filter(|w| !w.is_empty())
        };
        let found = words().count();
        if found != N {
            return Err(self.error(format!("expected {what}, found {found} values")));
        }
        let mut values = [T::default(); N];
        for (value, word) in values.iter_mut().zip(words()) {
            *value = word
                .parse()
                .map_err(|_| self.error(format!("expected {what}, found '{word}'")))?;
        }
        Ok(values)
    }

    /// The next line as a position.
    pub fn position(&mut self, what: &'static str) -> Result<DVec3, ImportError> {
        let position = self.values::<f64, 3>(&format!("{what} x y z"))?;
        check_finite(self.file, || FilePlace::Line(self.number), what, &position)?;
        Ok(position.into())
    }

    /// The next line as how many of something there are, at least one.
    pub fn count(&mut self, what: &str) -> Result<usize, ImportError> {
        let [count] = self.values::<usize, 1>(&format!("the number of {what}"))?;
        if count == 0 {
            return Err(self.error(format!("there are no {what}")));
        }
        Ok(count)
    }

    /// Refuses what follows.
    pub fn end(&mut self, what: &str) -> Result<(), ImportError> {
        match self.next() {
            None => Ok(()),
            Some(_) => Err(self.error(format!("the file goes on after the last of its {what}"))),
        }
    }
}
