use super::*;
use crate::sample::record;

const FIVE_PERCENT: CompareOptions = CompareOptions {
    force: false,
    limit: Some(0.05),
};

#[test]
fn two_runs_of_one_build_are_the_same() {
    let comparison = compare(&record(1.0, 0), &record(1.0, 1000), &FIVE_PERCENT).unwrap();
    assert!(comparison.passes());
    let times = comparison.rows.iter().filter(|row| row.unit == "ms");
    assert!(
        times.clone().all(|row| row.verdict == Verdict::Same),
        "{}",
        comparison.text()
    );
    assert_eq!(times.count(), 6);
}

#[test]
fn a_slowed_pass_is_found_and_named() {
    let comparison = compare(&record(1.0, 0), &record(1.2, 1000), &FIVE_PERCENT).unwrap();
    assert!(!comparison.passes());
    let verdict = |name: &str| comparison.rows.iter().find(|row| row.quantity == name).unwrap().verdict;
    assert_eq!(
        (verdict("draw"), verdict("update")),
        (Verdict::AboveLimit, Verdict::Same)
    );
    let text = comparison.text();
    assert!(text.contains("more than 5.0 % slower: torus draw"), "{text}");
    let faster = compare(&record(1.2, 0), &record(1.0, 1000), &FIVE_PERCENT).unwrap();
    assert!(faster.passes() && faster.text().contains("faster"));
}

#[test]
fn other_devices_and_settings_are_refused_unless_forced() {
    let before = record(1.0, 0);
    let mut after = record(1.0, 1);
    after.device.name = "Another".to_owned();
    after.runs[0]
        .settings
        .insert("metric".to_owned(), "edge 2 px".to_owned());
    let message = compare(&before, &after, &FIVE_PERCENT).unwrap_err().to_string();
    assert!(message.contains("device is 'A device' and 'Another'"), "{message}");
    assert!(
        message.contains("torus: metric is 'edge 4 px' and 'edge 2 px'"),
        "{message}"
    );
    let options = CompareOptions {
        force: true,
        ..FIVE_PERCENT
    };
    let forced = compare(&before, &after, &options).unwrap();
    assert_eq!(forced.differences.len(), 2);
    assert!(forced.text().contains("not alike: device"));
}

#[test]
fn version_and_commit_may_differ() {
    let mut after = record(1.0, 1);
    after.tool.commit = "89abcde".to_owned();
    assert!(compare(&record(1.0, 0), &after, &FIVE_PERCENT).is_ok());
}

#[test]
fn what_only_one_run_has_is_listed() {
    let before = record(1.0, 0);
    let mut after = record(1.0, 1);
    let mut other = after.runs[0].clone();
    other.scene = "cube".to_owned();
    after.runs.push(other);
    assert_eq!(compare(&before, &after, &FIVE_PERCENT).unwrap().unpaired, ["cube"]);
    after.runs.remove(0);
    assert!(matches!(
        compare(&before, &after, &FIVE_PERCENT),
        Err(CompareError::NothingInCommon)
    ));
}

#[test]
fn variants_of_one_record_are_compared() {
    let mut both = record(1.0, 0);
    let mut other = record(1.3, 1000).runs.remove(0);
    other.variant = "no neighbours".to_owned();
    both.runs.push(other);
    let comparison = compare_variants(&both, "", "no neighbours", &FIVE_PERCENT).unwrap();
    assert!(!comparison.passes());
    let message = compare_variants(&both, "", "x", &FIVE_PERCENT).unwrap_err().to_string();
    assert!(
        message.contains("the variant 'x'; expected one of: , no neighbours"),
        "{message}"
    );
}

#[test]
fn json_names_every_row() {
    let comparison = compare(&record(1.0, 0), &record(1.2, 1), &FIVE_PERCENT).unwrap();
    let value = serde_json::to_value(&comparison).unwrap();
    let draw = value["rows"]
        .as_array()
        .unwrap()
        .iter()
        .find(|row| row["quantity"] == "draw")
        .unwrap();
    assert_eq!(draw["verdict"], "above_limit");
    assert!(draw["change"].as_f64().unwrap() > 0.1 && draw["interval"]["low"].as_f64().unwrap() > 0.1);
}
