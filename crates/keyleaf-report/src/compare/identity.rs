//! What must be equal in two runs before their times can be compared.

use crate::run::{RunRecord, SceneRun};
use serde::Serialize;
use std::fmt;

/// A property in which two runs differ.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Difference {
    /// The property.
    pub what: String,
    /// Of the first run.
    pub before: String,
    /// Of the second run.
    pub after: String,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shown = |text: &str| {
            if text.is_empty() {
                "nothing".to_owned()
            } else {
                format!("'{text}'")
            }
        };
        write!(f, "{} is {} and {}", self.what, shown(&self.before), shown(&self.after))
    }
}

fn differing<const N: usize>(properties: [(&str, String, String); N]) -> Vec<Difference> {
    let unequal = properties.into_iter().filter(|(_, before, after)| before != after);
    unequal
        .map(|(what, before, after)| Difference {
            what: what.to_owned(),
            before,
            after,
        })
        .collect()
}

/// Everything that speaks against comparing two records: device, build profile, size, and the settings of the scenes that both have.
/// Version and commit may differ: that is what is compared.
pub fn differences(before: &RunRecord, after: &RunRecord) -> Vec<Difference> {
    let mut all = of_records(before, after);
    for run in &before.runs {
        all.extend(after.find(run).into_iter().flat_map(|other| of_runs(run, other)));
    }
    all
}

pub(super) fn of_records(before: &RunRecord, after: &RunRecord) -> Vec<Difference> {
    let (a, b) = (&before.device, &after.device);
    let size = |record: &RunRecord| format!("{} x {}", record.size[0], record.size[1]);
    differing([
        ("device", a.name.clone(), b.name.clone()),
        ("driver", a.driver.clone(), b.driver.clone()),
        ("backend", a.backend.clone(), b.backend.clone()),
        ("features", a.features.join(", "), b.features.join(", ")),
        ("flags", a.flags.join(", "), b.flags.join(", ")),
        ("cores", a.cores.to_string(), b.cores.to_string()),
        (
            "validation of indirect calls",
            a.indirect_validation.to_string(),
            b.indirect_validation.to_string(),
        ),
        ("build profile", before.tool.profile.clone(), after.tool.profile.clone()),
        ("size", size(before), size(after)),
        ("warm-up", before.warm_up.to_string(), after.warm_up.to_string()),
    ])
}

pub(super) fn of_runs(before: &SceneRun, after: &SceneRun) -> Vec<Difference> {
    let mut all = differing([
        ("frames", before.frames.to_string(), after.frames.to_string()),
        ("clock", before.clock.text().to_owned(), after.clock.text().to_owned()),
    ]);
    let names = before.settings.keys().chain(
        after
            .settings
            .keys()
            .filter(|name| !before.settings.contains_key(*name)),
    );
    for name in names {
        let value = |run: &SceneRun| run.settings.get(name).cloned().unwrap_or_default();
        all.extend(differing([(name.as_str(), value(before), value(after))]));
    }
    for difference in &mut all {
        difference.what = format!("{}: {}", before.name(), difference.what);
    }
    all
}
