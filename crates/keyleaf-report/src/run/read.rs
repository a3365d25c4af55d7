//! Reading and writing records.

use super::{RunError, RunRecord, SCHEMA};
use std::path::Path;

impl RunRecord {
    /// Reads a file.
    ///
    /// # Errors
    /// [`RunError`] with the file, the line where the text is at fault, and the reason.
    pub fn read(file: &Path) -> Result<Self, RunError> {
        let text = std::fs::read_to_string(file).map_err(|source| RunError::Read {
            file: file.to_path_buf(),
            source,
        })?;
        Self::parse(file, &text)
    }

    /// The record that a text holds; `file` is for errors.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn parse(file: &Path, text: &str) -> Result<Self, RunError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let syntax = |error: serde_json::Error| {
            let whole = error.to_string();
            let place = format!(" at line {} column {}", error.line(), error.column());
            RunError::Syntax {
                file: file.to_path_buf(),
                line: error.line().max(1),
                column: error.column().max(1),
                reason: whole.strip_suffix(&place).unwrap_or(&whole).to_owned(),
            }
        };
        let value: serde_json::Value = serde_json::from_str(text).map_err(syntax)?;
        match value.get("schema").and_then(serde_json::Value::as_u64) {
            None => {
                return Err(RunError::NoSchema {
                    file: file.to_path_buf(),
                });
            }
            Some(found) if found != u64::from(SCHEMA) => {
                let file = file.to_path_buf();
                return Err(RunError::Schema { file, found });
            }
            Some(_) => {}
        }
        // From the text again: only then do errors have lines.
        let record: Self = serde_json::from_str(text).map_err(syntax)?;
        record.check(file)?;
        Ok(record)
    }

    /// The text of the file.
    ///
    /// # Errors
    /// None that a finite record can cause.
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string_pretty(self)
    }

    fn check(&self, file: &Path) -> Result<(), RunError> {
        if self.runs.is_empty() {
            return Err(RunError::Empty {
                file: file.to_path_buf(),
            });
        }
        for (i, run) in self.runs.iter().enumerate() {
            let wrong = |field: String, reason: String| RunError::Value {
                file: file.to_path_buf(),
                run: i + 1,
                scene: run.name(),
                field,
                reason,
            };
            if run.frames == 0 {
                return Err(wrong("frames".to_owned(), "is 0; expected one at least".to_owned()));
            }
            for (field, series) in run.series() {
                if let Some(reason) = series.problem(run.frames) {
                    return Err(wrong(field, reason));
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use crate::run::RunRecord;
    use crate::sample;

    fn error(text: &str) -> String {
        RunRecord::parse("run.json".as_ref(), text).unwrap_err().to_string()
    }

    #[test]
    fn a_record_comes_back_as_it_was_written() {
        let record = sample::record(1.0, 0);
        let text = record.to_json().unwrap();
        let mut read = RunRecord::parse("run.json".as_ref(), &text).unwrap();
        for (read, written) in read.runs[0].series().into_iter().zip(record.runs[0].series()) {
            assert_eq!(read.1.samples, written.1.samples);
            assert!((read.1.mean - written.1.mean).abs() <= 1e-12 * written.1.mean);
        }
        read.runs.clone_from(&record.runs);
        assert_eq!(read, record);
        assert!(text.contains("\"schema\": 1"));
    }

    #[test]
    fn errors_name_file_line_and_reason() {
        assert!(
            RunRecord::read("no/such.json".as_ref())
                .unwrap_err()
                .to_string()
                .starts_with("no/such.json: cannot")
        );
        assert!(error("{\n  \"schema\": 1,,\n}").starts_with("run.json:2:"));
        assert!(error("{}").starts_with("run.json: has no \"schema\""));
        assert!(error("{\"schema\": 2}").starts_with("run.json: has schema 2"));
        assert!(error("{\"schema\": 1,\n\"tool\": 3}").starts_with("run.json:2:9: invalid type"));
        let mut record = sample::record(1.0, 0);
        record.runs[0].passes[0].ms.samples.pop();
        let message = error(&record.to_json().unwrap());
        assert!(
            message.starts_with("run.json: run 1 (torus): update.ms has 119 samples"),
            "{message}"
        );
        record.runs[0].passes[0].ms.samples.push(-1.0);
        assert!(error(&record.to_json().unwrap()).contains("below 0"));
        record.runs.clear();
        assert!(error(&record.to_json().unwrap()).contains("no runs"));
    }
}
