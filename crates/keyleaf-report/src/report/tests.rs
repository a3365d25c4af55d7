use super::*;
use crate::sample;

fn point(ms: f64, error: f64) -> Point {
    let measure = Measure {
        max: error,
        rms: error / 2.0,
    };
    Point {
        series: "edge, \"fine\"".to_owned(),
        label: format!("{ms} px"),
        ms,
        errors: Errors {
            object: Some(measure),
            picture: Some(PictureError {
                psnr: Some(60.0 - error),
                ssim: 0.9,
                covered: 1.0,
            }),
            ..Errors::default()
        },
        ..Point::default()
    }
}

fn scene(points: Vec<Point>) -> SceneReport {
    SceneReport {
        name: "torus".to_owned(),
        camera: "start".to_owned(),
        size: [640, 480],
        clock: Clock::Wall,
        points,
        growth: Vec::new(),
        notes: Vec::new(),
    }
}

#[test]
fn the_front_takes_less_error_and_more_decibels() {
    let scene = scene(vec![point(1.0, 9.0), point(2.0, 10.0), point(3.0, 1.0)]);
    assert_eq!(scene.front(Quantity::Object), [0, 2]);
    assert_eq!(scene.front(Quantity::Psnr), [0, 2]);
    assert_eq!(scene.front(Quantity::Pixels), [0; 0]);
}

#[test]
fn csv_has_a_cell_for_every_column_and_quotes_what_needs_it() {
    let report = Report {
        scenes: vec![scene(vec![point(1.0, 9.0)])],
        ..Report::default()
    };
    let text = report.csv();
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines[1].contains(",\"edge, \"\"fine\"\"\",1 px,1,"), "{text}");
    let cells = lines[1].replace("\"edge, \"\"fine\"\"\"", "x");
    assert_eq!(cells.split(',').count(), lines[0].split(',').count());
    assert!(lines[1].contains(",object psnr dissimilarity,"), "{text}");
}

#[test]
fn a_run_becomes_a_point_with_its_passes() {
    let record = sample::record(1.0, 0);
    let run = &record.runs[0];
    let point = Point::of_run("edge", "4 px", run);
    assert_eq!(point.ms, run.frame_ms().p50);
    assert!(point.spread.unwrap().contains(point.ms));
    assert_eq!(
        point.passes.iter().map(|p| p.name.as_str()).collect::<Vec<_>>(),
        ["update", "draw"]
    );
    assert_eq!((point.bytes, point.leaves), (1 << 20, run.leaves.p50));
}
