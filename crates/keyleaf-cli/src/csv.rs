//! Rows of points, with the columns that a user gave kept as they are.

use anyhow::{Context, bail, ensure};
use std::path::{Path, PathBuf};

/// A table of text with a header.
pub struct Csv {
    /// The file, for errors.
    file: PathBuf,
    /// The header line as it is.
    pub header: String,
    columns: Vec<String>,
    /// Line number, line as it is, and fields.
    rows: Vec<(usize, String, Vec<String>)>,
}

/// A row with its place in the file.
#[derive(Clone, Copy)]
pub struct Row<'a> {
    csv: &'a Csv,
    /// From 1, as editors count.
    pub line: usize,
    /// The line as it is.
    pub text: &'a str,
    fields: &'a [String],
}

impl Csv {
    /// Reads a file. Fields are parted by commas and may be in double quotes; empty lines do not count.
    pub fn read(file: &Path) -> anyhow::Result<Self> {
        let text = std::fs::read_to_string(file).with_context(|| format!("{}: cannot be read", file.display()))?;
        Self::parse(file, &text)
    }

    fn parse(file: &Path, text: &str) -> anyhow::Result<Self> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
        let Some((number, header)) = lines.next() else {
            bail!("{}: the file is empty; expected a header", file.display())
        };
        let columns = fields(header).with_context(|| format!("{}:{}", file.display(), number + 1))?;
        let mut rows = Vec::new();
        for (number, line) in lines {
            let at = || format!("{}:{}", file.display(), number + 1);
            let fields = fields(line).with_context(at)?;
            ensure!(
                fields.len() == columns.len(),
                "{}: {} columns; expected the {} of the header",
                at(),
                fields.len(),
                columns.len()
            );
            rows.push((number + 1, line.to_owned(), fields));
        }
        Ok(Self {
            file: file.to_path_buf(),
            header: header.to_owned(),
            columns,
            rows,
        })
    }

    /// The index of a column.
    pub fn column(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|column| column == name)
    }

    /// The names of all columns.
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// The rows in order.
    pub fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        self.rows.iter().map(|(line, text, fields)| Row {
            csv: self,
            line: *line,
            text,
            fields,
        })
    }
}

impl Row<'_> {
    /// The text in a column.
    pub fn text(&self, column: usize) -> &str {
        &self.fields[column]
    }

    /// The finite number in a column.
    pub fn number(&self, column: usize) -> anyhow::Result<f64> {
        let text = self.text(column);
        let wrong = || {
            format!(
                "{}: {} is '{text}'; expected a finite number",
                self.place(),
                self.csv.columns[column]
            )
        };
        text.parse().ok().filter(|n: &f64| n.is_finite()).with_context(wrong)
    }

    /// The whole number in a column.
    pub fn index(&self, column: usize) -> anyhow::Result<u32> {
        let text = self.text(column);
        let wrong = || {
            format!(
                "{}: {} is '{text}'; expected a whole number from 0",
                self.place(),
                self.csv.columns[column]
            )
        };
        text.parse().ok().with_context(wrong)
    }

    /// `file:line`.
    pub fn place(&self) -> String {
        format!("{}:{}", self.csv.file.display(), self.line)
    }
}

/// The fields of a line, without quotes and the space around.
fn fields(line: &str) -> anyhow::Result<Vec<String>> {
    let (mut fields, mut field, mut quoted) = (Vec::new(), String::new(), false);
    let mut characters = line.chars().peekable();
    while let Some(c) = characters.next() {
        match c {
            '"' if quoted && characters.peek() == Some(&'"') => {
                characters.next();
                field.push('"');
            }
            '"' => quoted = !quoted,
            ',' if !quoted => fields.push(std::mem::take(&mut field).trim().to_owned()),
            c => field.push(c),
        }
    }
    ensure!(!quoted, "a double quote is not closed");
    fields.push(field.trim().to_owned());
    Ok(fields)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> anyhow::Result<Csv> {
        Csv::parse("in.csv".as_ref(), text)
    }

    #[test]
    fn columns_are_found_by_name_and_lines_are_kept() {
        let csv = parse("name, face ,u\n\n\"a, \"\"b\"\"\",3, 0.5\r\n").unwrap();
        assert_eq!((csv.column("face"), csv.column("v")), (Some(1), None));
        let row = csv.rows().next().unwrap();
        assert_eq!(
            (row.text(0), row.index(1).unwrap(), row.number(2).unwrap()),
            ("a, \"b\"", 3, 0.5)
        );
        assert_eq!(
            (row.place(), row.text),
            ("in.csv:3".to_owned(), "\"a, \"\"b\"\"\",3, 0.5")
        );
    }

    #[test]
    fn errors_name_file_and_line() {
        let message = |text: &str| parse(text).map(|_| ()).unwrap_err().to_string();
        assert!(message("\n \n").starts_with("in.csv: the file is empty"));
        assert!(message("a,b\n1\n").starts_with("in.csv:2: 1 columns"));
        assert!(message("a\n\"1\n").starts_with("in.csv:2"));
        let csv = parse("face,u\n-1,nan\n").unwrap();
        let row = csv.rows().next().unwrap();
        assert!(
            row.index(0)
                .unwrap_err()
                .to_string()
                .starts_with("in.csv:2: face is '-1'")
        );
        assert!(
            row.number(1)
                .unwrap_err()
                .to_string()
                .starts_with("in.csv:2: u is 'nan'")
        );
    }
}
