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
    folder.succeed("bench two.ron hills.ron --out run.json --frames 4 --warm-up 2 --size 80x60");
    let report: Value = serde_json::from_str(&folder.read("run.json")).unwrap();
    assert!(report["device"].is_string() && report["software"].is_boolean());
    let [two, hills] = [0, 1].map(|i| &report["scenes"][i]);
    assert_eq!(
        (two["name"].as_str(), hills["name"].as_str(), two["frames"].as_u64()),
        (Some("two"), Some("hills"), Some(4))
    );
    assert!(two["leaves"]["median"].as_f64().unwrap() >= 48.0 && hills["triangles"]["median"].as_f64().unwrap() > 0.0);
    for (pass, name) in ["update", "draw"].iter().enumerate() {
        let pass = &two["passes"][pass];
        assert_eq!(pass["name"].as_str(), Some(*name));
        assert!(pass["median_ms"].as_f64().unwrap() > 0.0 && pass["cpu_ms"]["median"].as_f64().unwrap() > 0.0);
    }
    folder.succeed("bench cube.obj --out both.json --frames 3 --warm-up 1 --size 80x60 --neighbours both --no-draw");
    let both: Value = serde_json::from_str(&folder.read("both.json")).unwrap();
    assert!(both["scenes"][0]["ratio"]["cpu"].as_f64().unwrap() > 0.0);
}
