//! Camera paths: `check` and `bench`.

use super::Folder;
use serde_json::Value;

#[test]
fn check_finds_nothing_wrong_also_when_starved() {
    let folder = Folder::new("check");
    for arguments in [
        "two.ron --step 0.05",
        "two.ron --step 0.1 --capacity 120 --pixels 2",
        "hills.ron --step 0.5 --pixels 40",
    ] {
        let report = folder.succeed_with_json(&format!("check {arguments} --size 160x120 --json"));
        assert_eq!(report["findings"], 0, "{report}");
        assert_eq!(report["frames"], report["checked"]);
        let starved = report["starved_frames"].as_array().unwrap().len();
        assert_eq!(starved > 0, arguments.contains("120 --pixels"), "{report}");
    }
    let few = folder.succeed_with_json("check two.ron --step 0.05 --every 4 --size 64x48 --json");
    assert_eq!((few["frames"].as_u64(), few["checked"].as_u64()), (Some(7), Some(3)));
}

#[test]
fn check_finds_the_cracks_of_leaves_that_do_not_look_at_each_other() {
    let folder = Folder::new("check-fails");
    let output = folder.run("check two.ron --step 0.05 --size 320x240 --no-neighbours");
    let text = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{text}");
    assert!(text.contains("T-junction") && text.contains("keys"), "{text}");
}

#[test]
fn bench_reports_every_pass() {
    let folder = Folder::new("bench");
    folder.succeed("bench two.ron hills.ron --out run.json --csv run.csv --frames 4 --warm-up 2 --size 80x60");
    let report: Value = serde_json::from_str(&folder.read("run.json")).unwrap();
    assert!(report["device"]["name"].is_string() && report["device"]["software"].is_boolean());
    let [two, hills] = [0, 1].map(|i| &report["runs"][i]);
    assert_eq!(
        (two["scene"].as_str(), hills["scene"].as_str(), two["frames"].as_u64()),
        (Some("two"), Some("hills"), Some(4))
    );
    assert!(two["leaves"]["p50"].as_f64().unwrap() >= 48.0 && hills["triangles"]["p50"].as_f64().unwrap() > 0.0);
    for (pass, name) in ["update", "draw"].iter().enumerate() {
        let pass = &two["passes"][pass];
        assert_eq!(pass["name"].as_str(), Some(*name));
        assert!(pass["ms"]["p50"].as_f64().unwrap() > 0.0 && pass["cpu_ms"]["p50"].as_f64().unwrap() > 0.0);
        assert_eq!(pass["ms"]["samples"].as_array().unwrap().len(), 4);
    }
    let lines = folder.read("run.csv");
    assert!(lines.lines().count() > 4 && lines.contains("\"hills\""), "{lines}");
}

#[test]
fn compare_pairs_the_frames_of_variants_and_runs() {
    let folder = Folder::new("compare");
    let flight = "--frames 8 --warm-up 1 --size 80x60 --no-draw";
    folder.succeed(&format!(
        "bench cube.obj --out both.json --sweep neighbours=on,off --interleave {flight}"
    ));
    let text = folder.succeed("compare both.json --variants neighbours=off,neighbours=on");
    assert!(text.contains("update") && text.contains("leaves"), "{text}");
    // The same work on the same device: only time may differ.
    folder.succeed(&format!(
        "bench cube.obj --out again.json --sweep neighbours=on,off --interleave {flight}"
    ));
    let report = folder.succeed_with_json("compare both.json again.json --json");
    let rows = report["rows"].as_array().unwrap();
    assert!(
        rows.iter()
            .any(|row| row["quantity"] == "leaves" && row["change"].as_f64() == Some(0.0))
    );
    folder.succeed(&format!("bench cube.obj --out other.json --sweep edge=4 {flight}"));
    folder.refuse("compare both.json other.json", &["in common"]);
    folder.refuse("compare both.json", &["--variants"]);
    folder.refuse("compare both.json nothing.json", &["nothing.json"]);
    folder.refuse("bench cube.obj --out run.json --sweep colour=1", &["base-grid"]);
}

#[test]
fn compare_finds_a_pass_that_takes_longer() {
    let folder = Folder::new("compare-slower");
    folder.succeed("bench cube.obj --out before.json --frames 12 --warm-up 1 --size 80x60 --no-draw");
    let mut slower: Value = serde_json::from_str(&folder.read("before.json")).unwrap();
    let ms = &mut slower["runs"][0]["passes"][0]["ms"];
    for key in ["p50", "p95", "p99", "max", "mean"] {
        ms[key] = (ms[key].as_f64().unwrap() * 1.5).into();
    }
    for sample in ms["samples"].as_array_mut().unwrap() {
        *sample = (sample.as_f64().unwrap() * 1.5).into();
    }
    std::fs::write(folder.0.join("after.json"), slower.to_string()).unwrap();
    folder.succeed("compare before.json before.json --fail-above 5%");
    assert_eq!(
        folder
            .run("compare before.json after.json --fail-above 5%")
            .status
            .code(),
        Some(1)
    );
    folder.succeed("compare before.json after.json --fail-above 60%");
}
