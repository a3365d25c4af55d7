//! Tables of text, and figures as people read them.

/// Columns padded to their widest cell, a line below the head. Columns whose cells all begin with a digit or a sign stand right.
pub fn format(head: &[&str], rows: &[Vec<String>]) -> String {
    let cell = |row: &[String], column: usize| row.get(column).cloned().unwrap_or_default();
    let columns: Vec<(usize, bool)> = (0..head.len())
        .map(|column| {
            let cells = || rows.iter().map(|row| cell(row, column));
            let width = cells().map(|text| text.chars().count()).max().unwrap_or(0);
            (
                width.max(head[column].chars().count()),
                cells().all(|text| is_number(&text)),
            )
        })
        .collect();
    let line = |cells: &[String]| {
        let padded = columns.iter().enumerate().map(|(i, (width, is_number))| {
            let text = cell(cells, i);
            if *is_number {
                format!("{text:>width$}")
            } else {
                format!("{text:<width$}")
            }
        });
        padded.collect::<Vec<_>>().join("  ").trim_end().to_owned()
    };
    let names: Vec<String> = head.iter().map(|name| (*name).to_owned()).collect();
    let rule: Vec<String> = columns.iter().map(|(width, _)| "-".repeat(*width)).collect();
    let mut lines = vec![line(&names), rule.join("  ")];
    lines.extend(rows.iter().map(|row| line(row)));
    lines.join("\n")
}

/// Whether a cell stands right: a figure, or nothing.
pub(crate) fn is_number(text: &str) -> bool {
    text.chars()
        .next()
        .is_none_or(|c| c.is_ascii_digit() || "+-−–".contains(c))
}

/// A whole number with commas between thousands.
pub fn thousands(number: f64) -> String {
    let digits = format!("{:.0}", number.abs());
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    if number < 0.0 { format!("−{text}") } else { text }
}

/// Three significant digits: 0.0123, 4.57, 123, 1,230; 1.2e-6 below a thousandth.
pub fn figure(value: f64) -> String {
    let size = value.abs();
    if !value.is_finite() {
        "–".to_owned()
    } else if size == 0.0 {
        "0".to_owned()
    } else if size < 0.001 {
        format!("{value:.1e}")
    } else if size >= 1000.0 {
        thousands(value)
    } else {
        let decimals = 2 - size.log10().floor() as i32;
        format!("{value:.*}", decimals.max(0) as usize)
    }
}

/// Bytes in the unit that fits.
pub fn bytes(bytes: f64) -> String {
    const UNITS: [&str; 5] = ["B", "KiB", "MiB", "GiB", "TiB"];
    let power = (bytes.max(1.0).log2() / 10.0).floor().min(4.0);
    format!("{} {}", figure(bytes / (power * 10.0).exp2()), UNITS[power as usize])
}

/// A part as per cent with its sign.
pub fn change(part: f64) -> String {
    let text = format!("{:+.1} %", 100.0 * part);
    text.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_right_and_words_left() {
        let rows = [vec!["a".into(), "7".into()], vec!["bcd".into(), "1,000".into()]];
        let expected = "name  count\n----  -----\na         7\nbcd   1,000";
        assert_eq!(format(&["name", "count"], &rows), expected);
    }

    #[test]
    fn figures_have_three_digits() {
        let values = [
            0.0,
            1.23456e-6,
            0.0123456,
            4.5678,
            99.95,
            123.4,
            1234567.8,
            -0.5,
            f64::NAN,
        ];
        let texts = values.map(figure);
        let expected = [
            "0",
            "1.2e-6",
            "0.0123",
            "4.57",
            "100.0",
            "123",
            "1,234,568",
            "-0.500",
            "–",
        ];
        assert_eq!(texts, expected);
        assert_eq!([1.0, 1536.0, 3.0e9].map(bytes), ["1.00 B", "1.50 KiB", "2.79 GiB"]);
        assert_eq!([0.05, -0.123].map(change), ["+5.0 %", "−12.3 %"]);
    }
}
