//! A table of text for the terminal.

/// Lines of equally wide columns under a rule; columns in which every cell is a number are aligned to the right.
pub fn format(head: &[&str], rows: &[Vec<String>]) -> String {
    let cell = |row: &Vec<String>, column: usize| row.get(column).cloned().unwrap_or_default();
    let mut lines = vec![String::new(); rows.len() + 2];
    for (column, title) in head.iter().enumerate() {
        let cells: Vec<String> = rows.iter().map(|row| cell(row, column)).collect();
        let width = cells
            .iter()
            .map(|text| text.chars().count())
            .chain([title.chars().count()])
            .max()
            .unwrap_or(0);
        let numbers = cells
            .iter()
            .all(|text| text.starts_with(|c: char| c.is_ascii_digit() || c == '-'));
        let aligned = |text: &str| {
            if numbers {
                format!("{text:>width$}")
            } else {
                format!("{text:<width$}")
            }
        };
        let gap = if column == 0 { "" } else { "  " };
        lines[0] += &format!("{gap}{}", aligned(title));
        lines[1] += &format!("{gap}{}", "-".repeat(width));
        for (line, text) in lines[2..].iter_mut().zip(&cells) {
            *line += &format!("{gap}{}", aligned(text));
        }
    }
    lines.iter().map(|line| line.trim_end()).collect::<Vec<_>>().join("\n")
}

/// A count with commas between thousands.
pub fn thousands(count: u64) -> String {
    let digits = count.to_string();
    let mut text = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousands_are_separated_by_commas() {
        assert_eq!(
            ["0", "999", "1,000", "1,234,567"],
            [0, 999, 1000, 1_234_567].map(thousands).each_ref().map(String::as_str)
        );
    }

    #[test]
    fn numbers_are_aligned_to_the_right_and_text_to_the_left() {
        let rows = [vec!["a".into(), "5".into()], vec!["bcd".into(), "1,000".into()]];
        assert_eq!(
            format(&["scene", "n"], &rows),
            "scene      n\n-----  -----\na          5\nbcd    1,000"
        );
    }
}
