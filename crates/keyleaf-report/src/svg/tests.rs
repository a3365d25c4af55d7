use super::*;

fn series(name: &str, style: usize) -> PlotSeries {
    let point = |i: i32| PlotPoint {
        x: 0.5 * 1.7f64.powi(i),
        y: 1e-2 * 0.25f64.powi(i) * (1.0 + style as f64),
        name: Some(format!("{name} {i}")),
        ..PlotPoint::default()
    };
    PlotSeries {
        name: name.to_owned(),
        style,
        points: (0..9).map(point).collect(),
    }
}

fn sample() -> Plot {
    Plot {
        title: "a < b & c".to_owned(),
        x: Axis::logarithmic("ms"),
        y: Axis::logarithmic("error"),
        series: vec![series("edge", 0), series("deviation", 1)],
        line: vec![[0.5, 1e-2], [8.0, 1e-6]],
        line_name: "front".to_owned(),
    }
}

/// Places of all texts with their widths: left, right, baseline.
fn texts(svg: &str) -> Vec<[f64; 3]> {
    let attribute = |line: &str, name: &str| -> f64 {
        let start = line.find(&format!(" {name}=\"")).unwrap() + name.len() + 3;
        line[start..].split('"').next().unwrap().parse().unwrap()
    };
    let lines = svg.lines().filter(|line| line.starts_with("<text class"));
    lines
        .map(|line| {
            let text = line.split('>').nth(1).unwrap().split('<').next().unwrap();
            let (x, size) = (attribute(line, "x"), element::width(text) * 0.9);
            let left = if line.contains("\"start\"") {
                x
            } else if line.contains("\"end\"") {
                x - size
            } else {
                x - size / 2.0
            };
            [left, left + size, attribute(line, "y")]
        })
        .collect()
}

#[test]
fn texts_do_not_overlap_and_stay_in_the_figure() {
    let rows: Vec<Bar> = (0..9)
        .map(|i| Bar {
            name: format!("a setting with a name that is far too long for the room that it has {i}"),
            parts: vec![f64::from(i), 0.5],
            end: format!("{i} ms"),
        })
        .collect();
    let names: Vec<String> = (0..9).map(|i| format!("a pass of some name {i}")).collect();
    for svg in [plot(&sample()), bars("times", &names, "ms", &rows)] {
        let texts = texts(&svg);
        assert!(texts.len() > 12);
        for (i, a) in texts.iter().enumerate() {
            assert!(a[0] >= -0.5 && a[1] <= WIDTH + 0.5, "{a:?}");
            for b in &texts[..i] {
                let is_apart = a[1] <= b[0] || b[1] <= a[0] || (a[2] - b[2]).abs() >= 12.0;
                assert!(is_apart, "{a:?} {b:?}");
            }
        }
    }
}

#[test]
fn what_users_wrote_is_escaped() {
    let svg = plot(&sample());
    assert!(svg.contains("aria-label=\"a &lt; b &amp; c\""));
    assert_eq!(escape("\"<\u{1}>\""), "&quot;&lt;\u{fffd}&gt;&quot;");
    assert!(standalone(&svg).contains("<style>.fig"));
}

#[test]
fn empty_and_strange_data_are_drawn_as_nothing() {
    let mut empty = sample();
    empty.series = vec![PlotSeries {
        name: "none".to_owned(),
        style: 40,
        points: [f64::NAN, 0.0, -1.0, f64::INFINITY]
            .map(|x| PlotPoint {
                x,
                y: x,
                ..PlotPoint::default()
            })
            .into(),
    }];
    let svg = plot(&empty);
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    let svg = bars(
        "",
        &[],
        "ms",
        &[Bar {
            name: String::new(),
            parts: vec![f64::NAN],
            end: String::new(),
        }],
    );
    assert!(!svg.contains("NaN"), "{svg}");
}
