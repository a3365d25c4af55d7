//! A comparison as a table.

use super::{Comparison, Verdict};
use crate::table::{change, figure, format};

impl Comparison {
    /// The table, what speaks against the comparison, and whether the limit holds.
    pub fn text(&self) -> String {
        let row = |row: &super::Row| {
            let spread = row.change.interval;
            vec![
                row.scene.clone(),
                row.quantity.clone(),
                format!("{} {}", figure(row.change.before), row.unit)
                    .trim_end()
                    .to_owned(),
                format!("{} {}", figure(row.change.after), row.unit)
                    .trim_end()
                    .to_owned(),
                change(row.change.change),
                format!("{} to {}", change(spread.low), change(spread.high)),
                row.verdict.text().to_owned(),
            ]
        };
        let head = ["scene", "quantity", "before", "after", "change", "spread", ""];
        let rows: Vec<Vec<String>> = self.rows.iter().map(row).collect();
        let mut lines = vec![format(&head, &rows)];
        lines.extend(self.differences.iter().map(|d| format!("not alike: {d}")));
        lines.extend(self.unpaired.iter().map(|scene| format!("in one run only: {scene}")));
        lines.extend(self.conclusion());
        lines.join("\n")
    }

    fn conclusion(&self) -> Option<String> {
        let percent = format!("{:.1} %", 100.0 * self.limit?);
        let above = self.rows.iter().filter(|row| row.verdict == Verdict::AboveLimit);
        let names: Vec<String> = above.map(|row| format!("{} {}", row.scene, row.quantity)).collect();
        Some(if names.is_empty() {
            format!("nothing is more than {percent} slower")
        } else {
            format!("more than {percent} slower: {}", names.join(", "))
        })
    }
}
