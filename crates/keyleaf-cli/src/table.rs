//! Tables of text.

/// Columns padded to their widest cell, a line below the head. Columns whose cells are all numbers are aligned to the right.
pub fn format(head: &[&str], rows: &[Vec<String>]) -> String {
    let cell = |row: &Vec<String>, column: usize| row.get(column).cloned().unwrap_or_default();
    let width = |column: usize| {
        let cells = rows.iter().map(|row| cell(row, column).chars().count());
        cells.max().unwrap_or(0).max(head[column].chars().count())
    };
    let is_number = |column: usize| {
        let number = |text: String| text.chars().all(|c| c.is_ascii_digit() || ".,-% ".contains(c));
        rows.iter().all(|row| number(cell(row, column)))
    };
    let widths: Vec<(usize, bool)> = (0..head.len())
        .map(|column| (width(column), is_number(column)))
        .collect();
    let line = |cells: Vec<String>| {
        let padded = cells.iter().zip(&widths).map(|(cell, (width, right))| {
            if *right {
                format!("{cell:>width$}")
            } else {
                format!("{cell:<width$}")
            }
        });
        padded.collect::<Vec<_>>().join("  ").trim_end().to_owned()
    };
    let mut lines = vec![line(head.iter().map(|h| (*h).to_owned()).collect())];
    lines.push(
        widths
            .iter()
            .map(|(width, _)| "-".repeat(*width))
            .collect::<Vec<_>>()
            .join("  "),
    );
    lines.extend(
        rows.iter()
            .map(|row| line((0..head.len()).map(|column| cell(row, column)).collect())),
    );
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    #[test]
    fn numbers_stand_right_and_words_left() {
        let rows = [vec!["a".into(), "7".into()], vec!["bcd".into(), "1,000".into()]];
        let expected = "name  count\n----  -----\na         7\nbcd   1,000";
        assert_eq!(super::format(&["name", "count"], &rows), expected);
    }
}
