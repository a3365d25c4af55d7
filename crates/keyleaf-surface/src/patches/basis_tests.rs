//! All methods against the exact tables, and where knots are hard.

use super::*;
use crate::patches::span::{MAX_DEGREE, spans};
use serde_json::Value;

const METHODS: [BasisMethod; 4] = [
    BasisMethod::Triangular,
    BasisMethod::Stair,
    BasisMethod::DeBoor,
    BasisMethod::Extraction,
];

fn floats(value: &Value) -> Vec<f64> {
    let array = value.as_array().expect("an array");
    array.iter().map(|x| x.as_f64().expect("a number")).collect()
}

/// Derivatives from functions of one degree less (Piegl & Tiller 2.7), in knot units.
fn derivatives(method: BasisMethod, span: &Span, at: Fraction) -> Vec<f64> {
    let p = span.degree;
    let lower = values(method, p - 1, span, at);
    let step = |r: usize| p as f64 * lower[r] / (span.width(r + 1, p - r) * span.length());
    (0..=p)
        .map(|r| if r > 0 { step(r - 1) } else { 0.0 } - if r < p { step(r) } else { 0.0 })
        .collect()
}

#[test]
fn all_methods_agree_with_the_exact_tables() {
    let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/oracles/stair/basis_exact.json");
    let Ok(text) = std::fs::read_to_string(&file) else {
        println!("skipped: there is no {}", file.display());
        return;
    };
    let tables: Value = serde_json::from_str(&text).expect("JSON");
    let mut rows = 0;
    for table in tables["tables"].as_array().expect("tables") {
        let (degree, knots) = (table["p"].as_u64().expect("a degree") as usize, floats(&table["knots"]));
        let spans = spans(degree, &knots);
        for row in table["rows"].as_array().expect("rows") {
            let (index, u) = (row[0].as_u64().expect("a span") as usize, row[1].as_f64().expect("u"));
            let span = &spans[crate::patches::span::find(&spans, u).expect("inside")];
            assert_eq!(span.index, index, "{} at {u}", table["kind"]);
            let at = span.fraction(u);
            for method in METHODS {
                let own = values(method, degree, span, at);
                for (value, exact) in own.iter().zip(floats(&row[2])) {
                    assert!(
                        (value - exact).abs() < 1e-14,
                        "{method:?}, {} at {u}: {own:?}",
                        table["kind"]
                    );
                }
                for (value, exact) in derivatives(method, span, at).iter().zip(floats(&row[3])) {
                    let room = 1e-13 * (1.0 + exact.abs().max(degree as f64 / span.length()));
                    assert!(
                        (value - exact).abs() < room,
                        "{method:?}, {} at {u}: {value} {exact}",
                        table["kind"]
                    );
                }
            }
            rows += 1;
        }
    }
    assert!(rows > 500);
}

/// Knots of every multiplicity, 1e-6 apart, and far from zero.
fn hard_knots(degree: usize) -> Vec<Vec<f64>> {
    let clamped = |inner: &[f64], offset: f64| -> Vec<f64> {
        let ends = |x: f64| vec![x; degree + 1];
        let all = [ends(0.0), inner.to_vec(), ends(1.0)].concat();
        all.into_iter().map(|x| x + offset).collect()
    };
    let mut knots = vec![
        clamped(&[], 0.0),
        clamped(&[0.5, 0.5 + 1e-6, 0.5 + 2e-6], 0.0),
        clamped(&[0.25, 0.5, 0.5 + 1.0 / 1_048_576.0], 1e4),
        (0..2 * degree + 4).map(|k| 1e4 + k as f64).collect(),
        (0..2 * degree + 6).map(|k| (k as f64 * 0.7).exp2()).collect(),
    ];
    knots.extend((1..=degree + 1).map(|multiplicity| clamped(&vec![0.375; multiplicity], 0.0)));
    knots
}

#[test]
fn functions_are_not_negative_and_sum_to_one_for_hard_knots_and_all_degrees() {
    for degree in 1..=MAX_DEGREE {
        for knots in hard_knots(degree) {
            for span in spans(degree, &knots) {
                for f in [0.0, 1e-9, 0.125, 0.5, 0.8, 1.0 - 1e-9, 1.0] {
                    let reference = values(BasisMethod::Triangular, degree, &span, Fraction::new(f));
                    for method in METHODS {
                        let n = values(method, degree, &span, Fraction::new(f));
                        assert!(n.iter().all(|&value| value >= 0.0), "{method:?} {knots:?} {n:?}");
                        assert!(
                            (n.iter().sum::<f64>() - 1.0).abs() < 1e-14,
                            "{method:?} {knots:?} {n:?}"
                        );
                        for (a, b) in n.iter().zip(reference) {
                            assert!((a - b).abs() < 1e-14, "{method:?} {knots:?}: {n:?} {reference:?}");
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn ends_of_clamped_spans_are_control_points_to_the_last_bit() {
    for degree in 1..=MAX_DEGREE {
        let knots = [vec![-3.0; degree + 1], vec![0.1, 0.7], vec![0.9; degree + 1]].concat();
        let spans = spans(degree, &knots);
        for method in METHODS {
            let first = values(method, degree, &spans[0], Fraction::START);
            let last = values(method, degree, &spans[spans.len() - 1], Fraction::END);
            assert!(
                (0..MAX_ORDER).all(|r| first[r] == if r == 0 { 1.0 } else { 0.0 }),
                "{method:?} {first:?}"
            );
            assert!(
                (0..MAX_ORDER).all(|r| last[r] == if r == degree { 1.0 } else { 0.0 }),
                "{method:?} {last:?}"
            );
        }
    }
}

#[test]
fn the_staircases_are_not_all_paths_above_degree_three() {
    let knots = [0.0, 1.0, 2.5, 3.0, 4.0, 6.0, 7.0, 7.5, 9.0, 10.0];
    let span = &spans(4, &knots)[0];
    let at = Fraction::new(0.4);
    assert!((staircases(2, 2, span, at) - all_paths(Path::START, [2, 2], span, at)).abs() > 0.01);
    assert!((staircases(1, 2, span, at) - all_paths(Path::START, [1, 2], span, at)).abs() < 1e-15);
}
