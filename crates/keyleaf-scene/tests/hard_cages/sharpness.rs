//! Creases, corners and rules of boundaries.

use crate::folder::{Folder, check_surface, refused};
use crate::kinds::all_kinds;
use crate::models::{SQUARE, faces, tetrahedron, vertices};

const SUBDIVIDED: [&str; 4] = [
    "CatmullClark()",
    "Loop()",
    "GaussianProduct(covariances: Isotropic(0.4))",
    "GaussianProduct(scheme: Loop, covariances: FromNormals())",
];

#[test]
fn tags_that_are_wrong_are_refused_by_every_kind_with_file_and_line() {
    let folder = Folder::new("tags");
    for (tag, expected) in [
        ("t", "a tag without a name"),
        (
            "t crease 2/1/0 0 9 1",
            "vertex (tags count from 0) 9 is out of range: there are 4",
        ),
        (
            "t crease 2/1/0 0 0 1",
            "the crease from vertex 0 to vertex 0, counted from 0, is no edge of the mesh",
        ),
        ("t crease 2/1/0 0 1", "announces other values than the 2 that follow"),
        (
            "t crease 2/1/0 0 1 2 3",
            "announces other values than the 4 that follow",
        ),
        (
            "t crease -2/1/0 0 1 2",
            "expected how many integers, numbers and strings follow",
        ),
        (
            "t crease 99999999999999999999/1/0 0 1 2",
            "expected how many integers, numbers and strings follow",
        ),
        (
            "t crease 4/3/0 0 1 1 2 3 4 5",
            "3 sharpnesses for 2; expected one, or one each",
        ),
        ("t crease 2/0/0 0 1", "0 sharpnesses for 1; expected one, or one each"),
        ("t crease 2/1/0 0 1 nan", "sharpness is NaN"),
        ("t crease 2/1/0 0 1 inf", "sharpness is inf"),
        ("t crease 2/1/0 0 1 -0.5", "the sharpness -0.5 is below 0"),
        ("t crease 2/1/0 0 1 1e30", "must be finite and at most 1e15 in size"),
        (
            "t corner 1/1/0 4 1",
            "vertex (tags count from 0) 4 is out of range: there are 4",
        ),
        (
            "t corner 2/3/0 0 1 2 3 4",
            "3 sharpnesses for 2; expected one, or one each",
        ),
        (
            "t interpolateboundary 1/0/0 7",
            "expected one of 0 (none), 1 (edges and corners), 2 (edges)",
        ),
        (
            "t interpolateboundary 0/0/0",
            "expected one of 0 (none), 1 (edges and corners), 2 (edges)",
        ),
    ] {
        folder.write("a.obj", &format!("{}{tag}\n", tetrahedron(1.0)));
        for shape in all_kinds() {
            refused(&folder, "a.obj", shape, &["s.ron:1:", "a.obj: line 9: ", expected]);
        }
    }
    let square = vertices(SQUARE) + &faces([[1, 2, 3, 4]]);
    folder.write("b.obj", &format!("{square}t crease 2/1/0 0 2 1\n"));
    refused(
        &folder,
        "b.obj",
        SUBDIVIDED[0],
        &["b.obj: line 6: the crease from vertex 0 to vertex 2, counted from 0, is no edge"],
    );
}

#[test]
fn sharpness_of_a_scene_that_is_wrong_is_refused_with_its_field() {
    let folder = Folder::new("fields");
    folder.write("a.obj", &tetrahedron(1.0));
    for shape in ["CatmullClark", "Loop"] {
        for (sharpness, expected) in [
            ("creases: [(0, 4, 1)]", "creases[0]"),
            ("creases: [(0, 1, 1), (2, 2, 1)]", "creases[1]"),
            ("creases: [(0, 1, NaN)]", "creases[0]"),
            ("creases: [(0, 1, inf)]", "creases[0]"),
            ("creases: [(0, 1, -1)]", "creases[0]"),
            ("corners: [(0, 1), (4, 1)]", "corners[1]"),
            ("corners: [(0, NaN)]", "corners[0]"),
            ("corners: [(0, -1)]", "corners[0]"),
        ] {
            let shape = format!("{shape}(sharpness: ({sharpness}))");
            refused(
                &folder,
                "a.obj",
                &shape,
                &["s.ron:1:", "surfaces[0].surface.sharpness", expected],
            );
        }
    }
}

#[test]
fn any_sharpness_from_0_has_a_surface() {
    let folder = Folder::new("any");
    for (index, sharpness) in ["0", "1e-300", "0.3", "4.999", "9.999", "10", "1e15"]
        .into_iter()
        .enumerate()
    {
        let edges = "0 1 0 2 0 3 1 2 1 3 2 3";
        for (name, tags) in [
            ("one", format!("t crease 2/1/0 0 1 {sharpness}\n")),
            (
                "all",
                format!("t crease 12/1/0 {edges} {sharpness}\nt corner 2/1/0 0 3 {sharpness}\n"),
            ),
        ] {
            let model = format!("{name}{index}.obj");
            folder.write(&model, &(tetrahedron(1.0) + &tags));
            for shape in SUBDIVIDED.into_iter().chain(["Qas()"]) {
                let opened = folder
                    .open(&model, shape)
                    .unwrap_or_else(|error| panic!("{name} {shape}: {error}"));
                check_surface(&format!("{name} {sharpness} as {shape}"), &opened);
            }
        }
    }
}

#[test]
fn a_crease_with_and_without_a_boundary_rule_at_a_boundary_has_a_surface() {
    let folder = Folder::new("boundary");
    let grid = (0..16).map(|k| [f64::from(k % 4), f64::from(k / 4), 0.1 * f64::from(k * k % 5)]);
    let quad = |k: usize| [k + 1, k + 2, k + 6, k + 5];
    let quads = faces([0, 1, 2, 4, 5, 6, 8, 9, 10].map(quad));
    for rule in [0, 1, 2] {
        let tags = format!("t crease 4/2/0 0 1 5 6 3 0.7\nt interpolateboundary 1/0/0 {rule}\n");
        folder.write("a.obj", &(vertices(grid.clone()) + &quads + &tags));
        for shape in [SUBDIVIDED[0], SUBDIVIDED[2]] {
            let opened = folder
                .open("a.obj", shape)
                .unwrap_or_else(|error| panic!("{rule} {shape}: {error}"));
            check_surface(&format!("rule {rule} as {shape}"), &opened);
            let is_told = |text: &str| text.contains("not drawn, since the boundary rule is none: 8 of 9");
            assert_eq!(
                opened.notes.iter().any(|note| is_told(&note.text)),
                rule == 0,
                "{:?}",
                opened.notes
            );
            let drawn = opened.surfaces[0].surface.topology().face_count();
            assert_eq!(drawn, if rule == 0 { 1 } else { 9 }, "rule {rule} as {shape}");
        }
    }
}
