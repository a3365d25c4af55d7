//! The tables of what accuracy costs.

use crate::Folder;
use serde_json::Value;

fn report(folder: &Folder, arguments: &str) -> Value {
    let output = folder.run(arguments);
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments}: {message}");
    serde_json::from_slice(&output.stdout).unwrap()
}

fn scene(name: &str) -> String {
    format!("{}/../../scenes/{name}.ron", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn culling_that_loses_nothing_has_the_psnr_of_the_rasterisers() {
    let folder = Folder::new("accuracy-culling");
    let arguments = format!(
        "accuracy {} --suite concheiro --table culling --size 96x72",
        scene("torus")
    );
    let report = report(&folder, &format!("{arguments} --frames 1 --json --quiet"));
    let rows = report["tables"][0]["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 6 * 5);
    let row = |how: &str, pixels: f64| {
        let found = rows.iter().find(|r| r["back_faces"] == how && r["pixels"] == pixels);
        found.unwrap_or_else(|| panic!("no row {how} {pixels}"))
    };
    let triangles = |how, pixels| row(how, pixels)["triangles"].as_u64().unwrap();
    for pixels in [1.0, 2.0, 4.0, 8.0, 16.0] {
        for exact in ["conservative", "leaves"] {
            assert_eq!(
                row(exact, pixels)["psnr_db"],
                row("hidden", pixels)["psnr_db"],
                "{exact} {pixels}"
            );
            assert!(triangles(exact, pixels) <= triangles("hidden", pixels));
        }
        assert_eq!(triangles("drawn", pixels), triangles("hidden", pixels));
        assert!(triangles("leaves", pixels) < triangles("drawn", pixels), "{pixels}");
    }
    // Finer is closer.
    let decibels = |pixels| row("drawn", pixels)["psnr_db"].as_f64().unwrap();
    assert!(decibels(1.0) > decibels(4.0) && decibels(4.0) > decibels(16.0));
}

#[test]
fn tessellations_are_compared_with_the_quadtree_at_the_same_psnr() {
    let folder = Folder::new("accuracy-methods");
    let arguments = format!(
        "accuracy {} --suite concheiro --table methods --size 96x72",
        scene("torus")
    );
    let report = report(&folder, &format!("{arguments} --json --quiet"));
    let rows = report["tables"][0]["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 3 * 8);
    for row in rows {
        assert!(row["triangles"].as_u64().unwrap() > 0, "{row}");
        assert!(row["psnr_db"].as_f64().unwrap() > 15.0, "the same torus: {row}");
    }
    let high_and_low = |method: &str| {
        let mut of = rows.iter().filter(|row| row["method"] == method);
        let mut next = || of.next().unwrap()["triangles"].as_u64().unwrap();
        (next(), (next(), next()).1)
    };
    for method in ["uniform per surface", "uniform per KSQuad", "DABT, length test"] {
        let (high, low) = high_and_low(method);
        assert!(high > low, "{method}: {high} triangles at high quality, {low} at low");
    }
}

#[test]
fn khourys_screen_space_metric_makes_triangles_more_even_than_the_distance() {
    let folder = Folder::new("accuracy-khoury");
    let arguments = format!("accuracy {} --suite khoury --size 320x240", scene("fox"));
    let report = report(&folder, &format!("{arguments} --frames 1 --json --quiet"));
    let rows = report["tables"][0]["rows"].as_array().unwrap();
    let of = |name: &str| -> Vec<&Value> { rows.iter().filter(|row| row["setting"] == name).collect() };
    let (edges, distances) = (of("edge"), of("distance"));
    assert_eq!((edges.len(), distances.len(), of("base grid").len()), (4, 4, 4));
    let number = |row: &Value, column: &str| row[column].as_f64().unwrap();
    let (edge, distance) = (edges[3], distances[3]);
    let ratio = number(edge, "triangles") / number(distance, "triangles");
    assert!((0.9..1.1).contains(&ratio), "as many triangles: {edge} {distance}");
    assert!(number(edge, "area_variation") < 0.9 * number(distance, "area_variation"));
    let neighbours = of("neighbours");
    assert!(number(neighbours[0], "pairs") > 0.0 && number(neighbours[1], "pairs") == 0.0);
}

#[test]
fn what_has_no_patches_is_refused() {
    let folder = Folder::new("accuracy-refused");
    for (arguments, expected) in [
        ("accuracy cube.obj --suite concheiro", "no Bézier or NURBS surface"),
        ("accuracy --suite concheiro --table culling", "expected a SCENE"),
        ("accuracy --suite concheiro", "<SCENE>"),
        ("accuracy cube.obj --suite nobody", "concheiro"),
    ] {
        let output = folder.run(arguments);
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments}: {message}");
        assert!(message.contains(expected), "{arguments}: {message}");
    }
}

#[test]
fn the_report_has_every_setting_with_its_errors() {
    let folder = Folder::new("accuracy-report");
    folder.succeed("accuracy cube.obj --out report.html --quick --size 80x60 --frames 1");
    let page = folder.read("report.html");
    assert!(page.starts_with("<!DOCTYPE html>") && page.contains("<svg"));
    let csv = folder.read("report.csv");
    for series in ["edge", "base grid", "neighbours"] {
        assert!(csv.contains(series), "{series}: {csv}");
    }
    folder.refuse("accuracy cube.obj --out report.txt", &[".html"]);
    folder.refuse("accuracy cube.obj", &["--out"]);
}
