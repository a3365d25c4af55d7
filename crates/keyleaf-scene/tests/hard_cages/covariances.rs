//! Covariances beside a model, in its columns, and their numbers.

use crate::folder::{Folder, check_surface, refused};

const TETRAHEDRON: &str = "v 1 1 1\nv 1 -1 -1\nv -1 1 -1\nv -1 -1 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
const ROUND: &str = "0.04 0 0 0.04 0 0.04\n";

/// Every way to draw Gaussian products of covariances that a file has.
const KINDS: [&str; 4] = [
    "GaussianProduct(strict: false)",
    "GaussianProduct(scheme: Loop, strict: false)",
    "GaussianProduct(scheme: LoopWarren, solver: Adjugate, strict: false)",
    "GaussianProduct(covariances: File(\"a.cov\"), strict: false)",
];

/// A folder with a tetrahedron whose vertex 2 has this covariance.
fn with(name: &str, covariance: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("a.obj", TETRAHEDRON);
    folder.write("a.cov", &format!("covariances 4\n{ROUND}{ROUND}{covariance}\n{ROUND}"));
    let columns = |line: &str, covariance: &str| format!("{} {covariance}\n", line.trim_start_matches("v "));
    let lines: String = TETRAHEDRON
        .lines()
        .take(4)
        .enumerate()
        .map(|(vertex, line)| columns(line, if vertex == 2 { covariance } else { ROUND.trim() }))
        .collect();
    folder.write(
        "b.off",
        &format!("OFF\n4 4 0\n{lines}3 0 1 2\n3 0 3 1\n3 0 2 3\n3 1 3 2\n"),
    );
    folder
}

/// The models of such a folder and how they are drawn.
fn ways() -> impl Iterator<Item = (&'static str, &'static str)> {
    let beside = KINDS.into_iter().map(|kind| ("a.obj", kind));
    beside.chain(KINDS[..3].iter().map(|&kind| ("b.off", kind)))
}

#[test]
fn matrices_that_are_no_covariances_are_refused_with_file_and_line_or_vertex() {
    let lines = [
        ("nan 0 0 1 0 1", "covariance is NaN"),
        ("1 0 0 inf 0 1", "covariance is inf"),
        ("1 0 0 -inf 0 1", "covariance is -inf"),
        ("1e30 0 0 1 0 1", "must be finite and at most 1e15 in size"),
        ("1 0 0 one 0 1", "'one' is no number"),
    ];
    for (index, (covariance, expected)) in lines.into_iter().enumerate() {
        let folder = with(&format!("line-{index}"), covariance);
        for (model, kind) in ways() {
            let place = if model == "a.obj" {
                "a.cov: line 4: "
            } else {
                "b.off: line 5: "
            };
            refused(&folder, model, kind, &[place, expected]);
        }
    }
    // A line of nine numbers is no line of an OFF file.
    let folder = with("asymmetric", "1 0 0.5  0 1 0  -0.5 0 1");
    refused(
        &folder,
        "a.obj",
        KINDS[0],
        &["a.cov: line 4: the matrix is not symmetric: xz is 0.5, zx is -0.5"],
    );
    refused(
        &folder,
        "b.off",
        KINDS[0],
        &["b.off: line 5: a vertex with 12 numbers; the first one has 9"],
    );
    for (index, covariance) in ["0 0 0 0 0 0", "-1 0 0 -2 0 -3", "1e-200 0 0 1e-200 0 1e-200"]
        .into_iter()
        .enumerate()
    {
        let folder = with(&format!("vertex-{index}"), covariance);
        for (model, kind) in ways() {
            for kind in [kind, &kind.replace("false", "true")] {
                let place = "surfaces[0].surface.covariances: ";
                refused(
                    &folder,
                    model,
                    kind,
                    &[place, "the covariance of vertex 2 is none: its greatest variance is "],
                );
            }
        }
    }
}

#[test]
fn indefinite_and_singular_matrices_are_made_rounder_or_refused_where_strict() {
    for (index, covariance) in [
        "1 0 0 1 0 0",
        "1 0 0 0 0 0",
        "1 0 0 1 0 -0.5",
        "1 2 0 1 0 1",
        "1 1 1 1 1 1",
        "1 0 0 1 0 1e-9",
        "1e12 0 0 1 0 1",
        "1e-30 0 0 1e-60 0 1e-90",
        "0 1 0 0 0 0",
    ]
    .into_iter()
    .enumerate()
    {
        let folder = with(&format!("flat-{index}"), covariance);
        for (model, kind) in ways() {
            let opened = folder
                .open(model, kind)
                .unwrap_or_else(|error| panic!("{covariance} as {kind}: {error}"));
            check_surface(&format!("{covariance} as {kind}"), &opened);
            let is_told = |text: &str| text.contains("made rounder") && text.contains(": 1, the first at vertex 2");
            assert!(
                opened.notes.iter().any(|note| is_told(&note.text)),
                "{:?}",
                opened.notes
            );
            let expected = [
                "surface.covariances: ",
                "the covariance of vertex 2 is none: its variances run from ",
            ];
            refused(&folder, model, &kind.replace("false", "true"), &expected);
        }
    }
}

#[test]
fn covariances_of_any_size_and_of_a_condition_to_1e7_have_surfaces_also_where_strict() {
    for (index, covariance) in [
        "1e14 0 0 1e14 0 1e14",
        "1e-90 0 0 1e-90 0 1e-90",
        "1e-30 0 0 1e-33 0 1e-36",
        "1 0 0 1 0 1e-6",
        "1 0 0 1e-6 0 1e-6",
        "0.5000005 0.4999995 0 0.5000005 0 1",
    ]
    .into_iter()
    .enumerate()
    {
        let folder = with(&format!("sound-{index}"), covariance);
        for (model, kind) in ways() {
            let kind = kind.replace("false", "true");
            let opened = folder
                .open(model, &kind)
                .unwrap_or_else(|error| panic!("{covariance} as {kind}: {error}"));
            check_surface(&format!("{covariance} as {kind}"), &opened);
            assert!(
                !opened.notes.iter().any(|note| note.text.contains("rounder")),
                "{covariance}"
            );
        }
    }
}

#[test]
fn another_number_of_covariances_than_vertices_is_refused() {
    let folder = Folder::new("count");
    folder.write("a.obj", TETRAHEDRON);
    let cases = [
        (String::new(), "a.cov: line 1: expected the header 'covariances'"),
        (
            format!("covariances 3\n{}", ROUND.repeat(3)),
            "a.cov: line 1: the header says 3 vertices, the model has 4",
        ),
        (
            format!("covariances 5\n{}", ROUND.repeat(5)),
            "a.cov: line 1: the header says 5 vertices, the model has 4",
        ),
        (
            format!("covariances 4\n{}", ROUND.repeat(3)),
            "a.cov: line 4: the file ends after 3 of 4",
        ),
        (
            format!("covariances 4\n{}", ROUND.repeat(5)),
            "a.cov: line 6: a covariance more than the 4",
        ),
        (
            format!("covariances -4\n{}", ROUND.repeat(4)),
            "a.cov: line 1: expected the header",
        ),
        (
            format!("covariances 4\n{}1 0 0 1 0\n", ROUND.repeat(3)),
            "a.cov: line 5: a covariance has 6 numbers",
        ),
        (
            format!("covariances 4\n{}1 0 0 1 0 1 0\n", ROUND.repeat(3)),
            "a.cov: line 5: a covariance has 6 numbers",
        ),
        (
            "covariances 99999999999999999999\n".into(),
            "a.cov: line 1: expected the header",
        ),
    ];
    for (text, expected) in &cases {
        folder.write("a.cov", text);
        for kind in KINDS {
            refused(&folder, "a.obj", kind, &["s.ron:1:", expected]);
        }
    }
    let off = |columns: [&str; 3]| {
        let lines: String = columns
            .iter()
            .enumerate()
            .map(|(x, more)| format!("{x} {} 0 {more}\n", x * x))
            .collect();
        format!("OFF\n3 1 0\n{lines}3 0 1 2\n")
    };
    let round = ROUND.trim();
    for (columns, expected) in [
        (
            [round, "1 0 0 1 0", round],
            "b.off: line 4: a vertex with 8 numbers; the first one has 9",
        ),
        (
            [round, "1 0 0 1 0 1 0", round],
            "b.off: line 4: a vertex with 10 numbers; the first one has 9",
        ),
        (
            [round, "", round],
            "b.off: line 4: a vertex with 3 numbers; the first one has 9",
        ),
        (["1 0 0 1 0", round, round], "b.off: line 3: a vertex with 8 numbers"),
        (
            ["", "", ""],
            "there are no covariances: expected the file b.cov beside it",
        ),
    ] {
        folder.write("b.off", &off(columns));
        refused(&folder, "b.off", KINDS[0], &[expected]);
    }
}
