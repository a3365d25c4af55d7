//! `keyleaf compare`: two runs of `bench`.

use crate::{Outcome, output};
use anyhow::{Context, ensure};
use clap::Args;
use keyleaf_report::compare::{CompareOptions, Comparison, compare, compare_variants};
use keyleaf_report::run::RunRecord;
use std::path::PathBuf;

/// Compare two runs of `bench` frame by frame
///
/// Frames of the same scene, path and variant are taken in pairs, since both saw the same view. A change counts where the spread of the
/// pairs leaves no doubt of it. Runs of other devices or other settings are refused. With one file and --variants, two variants of it
/// are compared, which bench --interleave measured in turn.
#[derive(Args)]
#[command(after_help = "Examples:
  keyleaf compare before.json after.json --fail-above 5%
  keyleaf compare run.json --variants neighbours=off,neighbours=on")]
pub struct Arguments {
    /// The runs, the earlier one first
    #[arg(value_name = "RUN", num_args = 1..=2, required = true)]
    runs: Vec<PathBuf>,
    /// Two variants of one run, by their names
    #[arg(long, value_name = "A,B", value_delimiter = ',', num_args = 1)]
    variants: Vec<String>,
    /// Exit with 1 if a pass takes that much more time
    #[arg(long, value_name = "PERCENT", value_parser = parse_percent)]
    fail_above: Option<f64>,
    /// Compare other devices and settings as well
    #[arg(long)]
    force: bool,
    /// Print the comparison as JSON
    #[arg(long)]
    json: bool,
}

/// `5%` or `5` as 0.05.
fn parse_percent(text: &str) -> anyhow::Result<f64> {
    let number = text.trim().trim_end_matches('%').trim();
    let percent: f64 = number.parse().context("expected a number of percent, such as 5%")?;
    ensure!(
        percent >= 0.0 && percent.is_finite(),
        "expected a number of percent from 0"
    );
    Ok(percent / 100.0)
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> anyhow::Result<Outcome> {
    let options = CompareOptions {
        force: arguments.force,
        limit: arguments.fail_above,
    };
    let comparison = match (&arguments.runs[..], &arguments.variants[..]) {
        ([file], [a, b]) => compare_variants(&RunRecord::read(file)?, a, b, &options)?,
        ([before, after], []) => compare(&RunRecord::read(before)?, &RunRecord::read(after)?, &options)?,
        ([_], _) => anyhow::bail!("expected two runs, or one with --variants A,B"),
        _ => anyhow::bail!("--variants compares two variants of one run: expected one file"),
    };
    show(arguments, &comparison)?;
    Ok(if comparison.passes() {
        Outcome::Done
    } else {
        Outcome::Failed
    })
}

fn show(arguments: &Arguments, comparison: &Comparison) -> anyhow::Result<()> {
    if arguments.json {
        output::print_json(&serde_json::to_value(comparison)?)
    } else {
        output::print(&comparison.text())
    }
}

#[cfg(test)]
mod tests {
    use super::parse_percent;

    #[test]
    fn limits_are_in_percent() {
        assert_eq!((parse_percent("5%").unwrap(), parse_percent("0").unwrap()), (0.05, 0.0));
        for wrong in ["", "x%", "-1%", "nan"] {
            assert!(parse_percent(wrong).is_err(), "{wrong}");
        }
    }
}
