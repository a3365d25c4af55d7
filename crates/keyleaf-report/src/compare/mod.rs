//! Two runs, frame by frame.
//!
//! Both flew the same scenes along the same paths with the same settings on the same device; only the program, or the variant, differs.
//! Frame i of one is paired with frame i of the other, since both saw the same view ([`paired_change`]). A change counts where the
//! interval of its median leaves zero out, so that two runs of one build are told to be alike.

mod identity;
mod text;

pub use identity::{Difference, differences};

use crate::run::{RunRecord, SceneRun, Series};
use crate::statistics::{PairedChange, paired_change};
use serde::Serialize;
use thiserror::Error;

/// How runs are compared.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CompareOptions {
    /// Compares what was measured on other devices or with other settings as well.
    pub force: bool,
    /// The part by which a pass may be slower, such as 0.05.
    pub limit: Option<f64>,
}

/// What two runs differ by.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// Rows in the order of the first run.
    pub rows: Vec<Row>,
    /// Why they should not be compared; only with [`CompareOptions::force`].
    pub differences: Vec<Difference>,
    /// Scenes that only one of them has.
    pub unpaired: Vec<String>,
    /// The limit that was asked for.
    pub limit: Option<f64>,
}

/// One quantity of one scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// Scene and variant.
    pub scene: String,
    /// What was measured, such as `draw`.
    pub quantity: String,
    /// Its unit: `ms`, or nothing for a count.
    pub unit: &'static str,
    /// By how much it changed.
    #[serde(flatten)]
    pub change: PairedChange,
    /// What that means.
    pub verdict: Verdict,
}

/// What a change means.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// No change that the spread does not explain.
    Same,
    /// Less time.
    Faster,
    /// More time, but not above the limit.
    Slower,
    /// Above the limit, but the spread explains that as well: more frames would tell.
    Unclear,
    /// More time than the limit allows.
    AboveLimit,
    /// A count: it tells whether both did the same work.
    Count,
}

impl Verdict {
    /// In words.
    pub fn text(self) -> &'static str {
        match self {
            Self::Same => "same",
            Self::Faster => "faster",
            Self::Slower => "slower",
            Self::Unclear => "unclear: measure more frames",
            Self::AboveLimit => "ABOVE THE LIMIT",
            Self::Count => "",
        }
    }

    fn of(change: &PairedChange, limit: Option<f64>) -> Self {
        let is_above = limit.is_some_and(|limit| change.change > limit);
        match (change.interval.contains(0.0), is_above) {
            (true, false) => Self::Same,
            (true, true) => Self::Unclear,
            (false, true) => Self::AboveLimit,
            (false, false) if change.change < 0.0 => Self::Faster,
            (false, false) => Self::Slower,
        }
    }
}

/// Why two records cannot be compared.
#[derive(Debug, Error)]
pub enum CompareError {
    /// They were measured on other devices or with other settings.
    #[error("the runs differ in more than the program: {}; --force compares them nevertheless", list(.0))]
    Different(Vec<Difference>),
    /// They have no scene in common.
    #[error("the runs have no scene, path and variant in common: expected one at least")]
    NothingInCommon,
    /// A variant is not there.
    #[error("no scene was measured with the variant '{0}'; expected one of: {1}")]
    NoVariant(String, String),
}

fn list(differences: &[Difference]) -> String {
    let texts: Vec<String> = differences.iter().map(ToString::to_string).collect();
    texts.join("; ")
}

impl Comparison {
    /// Whether nothing is above the limit.
    pub fn passes(&self) -> bool {
        self.rows.iter().all(|row| row.verdict != Verdict::AboveLimit)
    }
}

/// Compares two records: what `after` takes more than `before`.
///
/// # Errors
/// [`CompareError`] if they differ in device or settings, unless forced, or have nothing in common.
pub fn compare(before: &RunRecord, after: &RunRecord, options: &CompareOptions) -> Result<Comparison, CompareError> {
    let pairs: Vec<(&SceneRun, &SceneRun)> = before
        .runs
        .iter()
        .filter_map(|run| Some((run, after.find(run)?)))
        .collect();
    if pairs.is_empty() {
        return Err(CompareError::NothingInCommon);
    }
    let mut differences = identity::of_records(before, after);
    differences.extend(pairs.iter().flat_map(|(a, b)| identity::of_runs(a, b)));
    let alone = |runs: &RunRecord, others: &RunRecord| -> Vec<String> {
        let alone = runs.runs.iter().filter(|run| others.find(run).is_none());
        alone.map(SceneRun::name).collect()
    };
    let unpaired = [alone(before, after), alone(after, before)].concat();
    conclude(&pairs, before.device.software, differences, unpaired, options)
}

/// Compares two variants of one record, as `bench` measures them in turn: what `after` takes more than `before`. Their settings differ
/// on purpose.
///
/// # Errors
/// [`CompareError::NoVariant`] if no scene has both.
pub fn compare_variants(
    record: &RunRecord,
    before: &str,
    after: &str,
    options: &CompareOptions,
) -> Result<Comparison, CompareError> {
    let other = |run: &SceneRun| {
        let same = |r: &&SceneRun| r.variant == after && (&r.scene, &r.path) == (&run.scene, &run.path);
        record.runs.iter().find(same)
    };
    let firsts = record.runs.iter().filter(|run| run.variant == before);
    let pairs: Vec<(&SceneRun, &SceneRun)> = firsts.filter_map(|run| Some((run, other(run)?))).collect();
    if pairs.is_empty() {
        let mut known: Vec<&str> = record.runs.iter().map(|run| run.variant.as_str()).collect();
        known.dedup();
        let missing = if known.contains(&before) { after } else { before };
        return Err(CompareError::NoVariant(missing.to_owned(), known.join(", ")));
    }
    conclude(&pairs, record.device.software, Vec::new(), Vec::new(), options)
}

fn conclude(
    pairs: &[(&SceneRun, &SceneRun)],
    software: bool,
    differences: Vec<Difference>,
    unpaired: Vec<String>,
    options: &CompareOptions,
) -> Result<Comparison, CompareError> {
    if !differences.is_empty() && !options.force {
        return Err(CompareError::Different(differences));
    }
    Ok(Comparison {
        rows: pairs
            .iter()
            .flat_map(|(a, b)| rows(a, b, software, options.limit))
            .collect(),
        differences,
        unpaired,
        limit: options.limit,
    })
}

/// Of the quantities of a pair; the limit holds for the passes and the frame, and on a software device for the CPU time, which is the
/// cost there.
fn rows(before: &SceneRun, after: &SceneRun, software: bool, limit: Option<f64>) -> Vec<Row> {
    let mut rows = Vec::new();
    let mut add = |quantity: &str, unit, [a, b]: [&Series; 2], limit: Option<f64>| {
        let Some(change) = paired_change(&a.samples, &b.samples) else {
            return;
        };
        let verdict = match unit {
            "ms" => Verdict::of(&change, limit),
            _ => Verdict::Count,
        };
        rows.push(Row {
            scene: before.name(),
            quantity: quantity.to_owned(),
            unit,
            change,
            verdict,
        });
    };
    for pass in &before.passes {
        let Some(other) = after.passes.iter().find(|other| other.name == pass.name) else {
            continue;
        };
        add(&pass.name, "ms", [&pass.ms, &other.ms], limit);
        for phase in &pass.phases {
            let same = other.phases.iter().find(|other| other.name == phase.name);
            if let Some(other) = same {
                add(
                    &format!("{}: {}", pass.name, phase.name),
                    "ms",
                    [&phase.ms, &other.ms],
                    None,
                );
            }
        }
    }
    add("all passes", "ms", [&before.frame_ms(), &after.frame_ms()], limit);
    add(
        "CPU time",
        "ms",
        [&before.cpu_ms, &after.cpu_ms],
        limit.filter(|_| software),
    );
    add("recording", "ms", [&before.record_ms, &after.record_ms], None);
    add("wall time", "ms", [&before.wall_ms, &after.wall_ms], None);
    add("leaves", "", [&before.leaves, &after.leaves], None);
    add("triangles", "", [&before.triangles, &after.triangles], None);
    rows
}

#[cfg(test)]
mod tests;
