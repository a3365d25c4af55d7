use super::page;
use crate::report::{GrowthPoint, Point, Report, SceneReport};
use crate::run::Clock;
use crate::sample;
use crate::scaling::{CostModel, device_classes, scaling};

fn report() -> Report {
    let record = sample::record(1.0, 0);
    let point = |i: i32| {
        let mut point = Point::of_run("edge <b>", &format!("{i} px"), &record.runs[0]);
        point.ms *= 1.5f64.powi(i);
        point.errors.object = Some(crate::error::Measure {
            max: 0.3f64.powi(i),
            rms: 0.1f64.powi(i),
        });
        point
    };
    let model = CostModel {
        moved_per_leaf: 64.0,
        kept_per_leaf: 120.0,
        kept_fixed: 0.0,
        passes: 12.0,
        start_us: 5.0,
        efficiency: 0.5,
    };
    let growth = [1e3, 1e4, 1e5].map(|leaves| GrowthPoint {
        leaves,
        ms: 0.1 + leaves * 1e-5,
        bytes: 0,
    });
    Report {
        title: "What accuracy & time cost".to_owned(),
        tool: record.tool,
        device: record.device,
        notes: vec!["A note.".to_owned()],
        scaling: Some(scaling(
            &model,
            &device_classes(),
            &growth.map(|g| (g.leaves, g.ms)),
            None,
        )),
        scenes: vec![SceneReport {
            name: "torus".to_owned(),
            camera: "start".to_owned(),
            size: [640, 480],
            clock: Clock::Timestamps,
            points: (0..6).map(point).collect(),
            growth: growth.into(),
            notes: Vec::new(),
        }],
    }
}

#[test]
fn the_page_stands_alone() {
    let page = page(&report());
    for foreign in ["<script", "http://", "https://", "@import", "url("] {
        assert!(
            !page.replace("http://www.w3.org/2000/svg", "").contains(foreign),
            "{foreign}"
        );
    }
    assert!(page.contains("edge &lt;b&gt;") && !page.contains("edge <b>"));
    assert!(!page.contains("NaN"));
}

#[test]
fn every_figure_says_device_size_scene_and_commit() {
    let page = page(&report());
    let captions: Vec<&str> = page.split("<figcaption>").skip(1).collect();
    assert_eq!(captions.len(), 5);
    for caption in captions {
        let caption = caption.split("</figcaption>").next().unwrap();
        for part in ["A device", "640 × 480", "scene torus", "commit 1234567"] {
            assert!(caption.contains(part), "{caption}");
        }
    }
}

#[test]
fn software_devices_and_debug_builds_are_warned_of() {
    let mut report = report();
    assert!(!page(&report).contains("class=\"warning\""));
    report.device.software = true;
    report.tool.profile = "debug".to_owned();
    let page = page(&report);
    assert_eq!(page.matches("class=\"warning\"").count(), 2);
    assert!(page.contains("not a GPU time;"));
}

#[test]
fn elements_are_closed() {
    let page = page(&report());
    for element in [
        "section", "figure", "table", "tr", "td", "th", "div", "svg", "text", "p", "dl", "h2", "h3",
    ] {
        let opened = page.matches(&format!("<{element}>")).count() + page.matches(&format!("<{element} ")).count();
        assert_eq!(opened, page.matches(&format!("</{element}>")).count(), "{element}");
    }
}

#[test]
fn an_empty_report_is_a_page() {
    assert!(page(&Report::default()).ends_with("</html>\n"));
}
