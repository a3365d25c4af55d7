//! Bézier and NURBS surfaces in scene files: what is read, what is written, what is refused and where.

use super::*;

/// A file, a NURBS surface with all fields, one with few, and a rational Bézier patch.
const FULL: &str = r#"(
    surfaces: [
        (name: "pot", source: Patches(path: "teapot", tolerance: 1e-5, basis: Stair, ignore_trims: true, even_spans: true)),
        (name: "sheet", source: Nurbs(
            surfaces: [
                (
                    degree: (2, 1),
                    knots_u: [0, 0, 0, 0.5, 1, 1, 1],
                    knots_v: [0, 0, 1, 1],
                    points: [
                        [(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0)],
                        [(0, 1, 0), (1, 1, 0, 0.5), (2, 1, 0), (3, 1, 0)],
                    ],
                ),
                (degree: (1, 1), points: [[(0, 0, 0), (1, 0, 0), (2, 0, 1)], [(0, 1, 0), (1, 1, 0), (2, 1, 1)]]),
            ],
            basis: DeBoor,
            even_spans: true,
        )),
        (name: "wall", source: Bezier(
            patches: [
                [[(1, 0, 0), (1, 1, 0, 0.70710678), (0, 1, 0)], [(1, 0, 1), (1, 1, 1, 0.70710678), (0, 1, 1)]],
            ],
        )),
    ],
)"#;

fn read(text: &str) -> Result<Scene, String> {
    Scene::from_ron(text, Path::new("s.ron")).map_err(|e| e.to_string())
}

fn broken(from: &str, to: &str) -> String {
    assert!(FULL.contains(from), "{from}");
    read(&FULL.replacen(from, to, 1)).unwrap_err()
}

#[test]
fn every_field_is_read_and_written_back() {
    let scene = read(FULL).unwrap();
    let [file, nurbs, bezier] = &scene.surfaces[..] else {
        panic!()
    };
    let expected = PatchesSource {
        path: "teapot".into(),
        tolerance: 1e-5,
        basis: Some(Basis::Stair),
        ignore_trims: true,
        even_spans: true,
    };
    assert_eq!(file.source, Source::Patches(expected));
    let Source::Nurbs(nurbs) = &nurbs.source else { panic!() };
    assert_eq!(
        (nurbs.basis, nurbs.tolerance, nurbs.even_spans),
        (Basis::DeBoor, 1e-6, true)
    );
    assert_eq!(nurbs.surfaces[0].points[1][1].weight, 0.5);
    let surface = nurbs.surfaces[0].surface().unwrap();
    assert_eq!(surface.point_counts(), [4, 2]);
    assert_eq!(surface.weights()[5], 0.5);
    let Source::Bezier(bezier) = &bezier.source else {
        panic!()
    };
    assert_eq!(bezier_surface(&bezier.patches[0]).unwrap().degree(), [2, 1]);
    let text = scene.to_ron().unwrap();
    assert_eq!(read(&text).unwrap(), scene, "{text}");
}

#[test]
fn knots_are_clamped_and_uniform_unless_given() {
    let scene = read(FULL).unwrap();
    let Source::Nurbs(nurbs) = &scene.surfaces[1].source else {
        panic!()
    };
    let surface = nurbs.surfaces[1].surface().unwrap();
    assert_eq!(
        surface.knots(),
        [&[0.0, 0.0, 1.0, 2.0, 2.0][..], &[0.0, 0.0, 1.0, 1.0][..]]
    );
    let cubic = NurbsPatch {
        degree: [3, 3],
        knots_u: None,
        knots_v: None,
        points: (0..4)
            .map(|j| {
                let point = |i: i32| ControlPoint {
                    position: [i.into(), j.into(), 0.0],
                    weight: 1.0,
                };
                (0..6).map(point).collect()
            })
            .collect(),
    };
    let surface = cubic.surface().unwrap();
    assert_eq!(surface.knots()[0], [0., 0., 0., 0., 1., 2., 3., 3., 3., 3.]);
    assert_eq!(surface.domain(), [[0.0, 3.0], [0.0, 1.0]]);
}

#[test]
fn values_out_of_range_tell_line_and_field() {
    let check = |from: &str, to: &str, expected: &[&str]| {
        let error = broken(from, to);
        for part in expected {
            assert!(error.contains(part), "{error}");
        }
    };
    check(
        "1e-5",
        "0.5",
        &[
            "s.ron:3:",
            "surfaces[0].source.tolerance: 0.5 is not allowed; expected a number from 0 to 0.01",
        ],
    );
    check("1e-5", "-1", &["surfaces[0].source.tolerance"]);
    check(
        "\"teapot\"",
        "\" \"",
        &["surfaces[0].source.path: expected the path of a file"],
    );
    check(
        "basis: Stair",
        "basis: Stairs",
        &["unknown choice `Stairs`, expected one of `Triangular`, `Loops`, `Stair`"],
    );
    check(
        "ignore_trims",
        "trims",
        &["unknown field `trims`, expected one of `path`, `tolerance`"],
    );
    check(
        "even_spans: true",
        "even_spans: 2",
        &["s.ron:3:", "surfaces[0].source.even_spans"],
    );
    check(
        "degree: (2, 1)",
        "degree: (8, 1)",
        &[
            "s.ron:7:",
            "surfaces[1].source.surfaces[0].degree: the degree in u is 8",
        ],
    );
    check(
        "0, 0.5, 1, 1, 1]",
        "0, 0.5, 0.4, 1, 1]",
        &["s.ron:8:45: ", "surfaces[0].knots_u[4]: knot 4 in u is 0.4, less than"],
    );
    check(
        "0.5, 1, 1, 1]",
        "1, 1, 1]",
        &["s.ron:8:", "knots_u: 6 knots; 4 points a row of degree 2 need 7"],
    );
    check(
        "knots_v: [0, 0, 1, 1]",
        "knots_v: [0, 0, 1]",
        &["s.ron:9:", "knots_v: 3 knots; 2 rows of degree 1 need 4"],
    );
    check(
        "knots_v: [0, 0, 1, 1]",
        "knots_v: [0, 0, 0, 1]",
        &["surfaces[0].knots_v: the domain in v is empty"],
    );
    check(
        "(3, 1, 0)]",
        "]",
        &[
            "s.ron:12:",
            "surfaces[0].points[1]: the row has 3 control points, the first has 4",
        ],
    );
    check(
        "(1, 1, 0, 0.5)",
        "(1, 1, 0, -0.5)",
        &[
            "s.ron:12:37: ",
            "surfaces[0].points[1][1]: the weight of control point 5 is -0.5",
        ],
    );
    check(
        "(1, 1, 0, 0.5)",
        "(1, NaN, 0)",
        &["s.ron:12:37: ", "points[1][1]: control point 5 is (1, NaN, 0)"],
    );
    check(
        "(1, 1, 0, 0.5)",
        "(1, 1)",
        &[
            "s.ron:12:",
            "points[1][1]",
            "expected a control point (x, y, z) or (x, y, z, w)",
        ],
    );
    check("(1, 1, 0, 0.5)", "(1, 1, 0, 1, 1)", &["s.ron:12:", "points[1][1]"]);
    check(
        "degree: (1, 1), points",
        "degree: (1, 2), points",
        &[
            "s.ron:15:",
            "points: 2 rows are too few for degree 2; expected at least 3",
        ],
    );
    check(
        "[[(1, 0, 0), (1, 1, 0, 0.70710678), (0, 1, 0)], [",
        "[[",
        &["s.ron:22:", "surfaces[2].source.patches[0]: the degree in v is 0"],
    );
    check(
        "(0, 1, 1)]]",
        "]]",
        &["patches[0][1]: the row has 2 control points, the first has 3"],
    );
    check(
        "[(1, 0, 0), (1, 1, 0, 0.70710678), (0, 1, 0)], ",
        "[], ",
        &["patches[0][0]: the row has no control points"],
    );
}

#[test]
fn patches_are_neither_displaced_nor_textured() {
    let displaced = broken(
        "ignore_trims: true, even_spans: true)",
        "), surface: Displaced(height: Noise(amplitude: 1, wavelength: 1))",
    );
    assert!(
        displaced.contains("surfaces[0].surface: only a Mesh can be Displaced"),
        "{displaced}"
    );
    let textured = broken(
        "ignore_trims: true, even_spans: true)",
        "), material: (texture: \"a.png\")",
    );
    assert!(
        textured.contains("surfaces[0].material.texture: Bézier and NURBS surfaces have no texture"),
        "{textured}"
    );
    let empty = read("(surfaces: [(name: \"a\", source: Nurbs(surfaces: []))])").unwrap_err();
    assert!(
        empty.contains("surfaces[0].source.surfaces: the list is empty; expected at least one"),
        "{empty}"
    );
    let empty = read("(surfaces: [(name: \"a\", source: Bezier(patches: [[]]))])").unwrap_err();
    assert!(
        empty.contains("surfaces[0].source.patches[0]: there are no control points"),
        "{empty}"
    );
}
