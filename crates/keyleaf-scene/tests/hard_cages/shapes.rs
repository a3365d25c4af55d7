//! Faces, vertices and how they meet.

use glam::DVec3;

use crate::folder::{Folder, check_surface, refused};
use crate::kinds::{OF_POLYGONS, OF_TRIANGLES, all_kinds};
use crate::models::{SQUARE, faces, hard_polygons, hard_triangles, vertices};

#[test]
fn hard_triangles_have_surfaces_of_every_kind() {
    let folder = Folder::new("triangles");
    for (name, text) in hard_triangles() {
        let model = format!("{name}.obj");
        folder.write(&model, &text);
        for shape in all_kinds() {
            match folder.open(&model, shape) {
                Ok(opened) => check_surface(&format!("{name} as {shape}"), &opened),
                Err(error) => panic!("{name} as {shape}: {error}"),
            }
        }
    }
}

#[test]
fn hard_polygons_have_surfaces_or_are_no_triangles() {
    let folder = Folder::new("polygons");
    for (name, text) in hard_polygons() {
        let model = format!("{name}.obj");
        folder.write(&model, &text);
        for shape in OF_POLYGONS {
            match folder.open(&model, shape) {
                Ok(opened) => check_surface(&format!("{name} as {shape}"), &opened),
                Err(error) => panic!("{name} as {shape}: {error}"),
            }
        }
        for shape in OF_TRIANGLES {
            refused(
                &folder,
                &model,
                shape,
                &["s.ron:1:", "surfaces[0].surface: ", "face ", " corners"],
            );
        }
    }
}

#[test]
fn vertices_in_one_point_have_surfaces_except_where_covariances_come_from_their_distances() {
    let folder = Folder::new("point");
    folder.write(
        "a.obj",
        &(vertices([[2.0, -1.0, 0.5]; 4]) + &faces([[1, 2, 3], [3, 2, 4]])),
    );
    folder.write("a.cov", &format!("covariances 4\n{}", "1 0 0 1 0 1\n".repeat(4)));
    let given = [
        "GaussianProduct()",
        "GaussianProduct(scheme: LoopWarren, solver: Adjugate)",
    ];
    for shape in all_kinds().filter(|shape| !shape.contains("covariances")).chain(given) {
        let opened = folder
            .open("a.obj", shape)
            .unwrap_or_else(|error| panic!("{shape}: {error}"));
        check_surface(shape, &opened);
        let surface = &opened.surfaces[0].surface;
        let point = surface.point(surface.face_coord(1, 0.25, 0.25).unwrap());
        assert!(point.distance(DVec3::new(2.0, -1.0, 0.5)) < 1e-12, "{shape}: {point}");
    }
    for shape in all_kinds().filter(|shape| shape.contains("covariances")) {
        refused(
            &folder,
            "a.obj",
            shape,
            &["surface.covariances: ", "all edges of the mesh have the length 0"],
        );
    }
}

#[test]
fn what_is_no_surface_is_refused_by_every_kind_with_file_and_line() {
    let folder = Folder::new("refused");
    let square = vertices(SQUARE);
    let cases = [
        ("empty.obj", String::new(), "the mesh is empty: 0 vertices, no faces"),
        (
            "no_faces.obj",
            square.clone(),
            "the mesh is empty: 4 vertices, no faces",
        ),
        (
            "empty.off",
            "OFF\n0 0 0\n".into(),
            "the mesh is empty: 0 vertices, no faces",
        ),
        (
            "two_corners.obj",
            format!("{square}f 1 2\n"),
            "line 5: a face needs at least 3 corners, this one has 2",
        ),
        (
            "repeated.obj",
            format!("{square}f 1 2 3\nf 1 3 3\n"),
            "are the same vertex 2 (in the file: line 6)",
        ),
        (
            "three_faces.obj",
            format!("{square}v 0 0 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n"),
            "used by 3 faces (0, 1, 2); a surface has at most 2 at an edge (in the file: line 6, line 7, line 8)",
        ),
        (
            "turned.obj",
            format!("{square}f 1 2 3\nf 1 3 4\nf 1 2 4\n"),
            "(in the file: line ",
        ),
        (
            "winding.obj",
            format!("{square}f 1 2 3\nf 1 4 3\nf 2 3 4\n"),
            "(in the file: line ",
        ),
        (
            "one_turned.obj",
            format!("{square}f 1 2 3\nf 3 1 4\nf 3 1 2\n"),
            "(in the file: line ",
        ),
        (
            "opposite.obj",
            format!("{square}f 1 2 3\nf 1 2 4\n"),
            "both run from vertex 0 to vertex 1; one of them must be turned",
        ),
        (
            "doubled.obj",
            format!("{square}f 1 2 3\nf 2 3 1\n"),
            "faces 0 and 1 are the same polygon",
        ),
        (
            "missing.obj",
            format!("{square}f 1 2 5\n"),
            "line 5: vertex 5 is out of range: there are 4",
        ),
        ("far.obj", format!("v 1e30 0 0\n{square}f 1 2 3\n"), "line 1: "),
        ("nan.obj", format!("{square}v 0 nan 0\nf 1 2 3\n"), "line 5: "),
        (
            "infinite.off",
            "OFF\n3 1 0\n0 0 0\n1 0 0\n0 -inf 0\n3 0 1 2\n".into(),
            "line 5: position is -inf",
        ),
        (
            "two_corners.off",
            "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n".into(),
            "line 6: a face needs at least 3 corners",
        ),
        (
            "none.obj",
            format!("{square}f\n"),
            "line 5: a face needs at least 3 corners, this one has 0",
        ),
        (
            "all_lost.obj",
            format!("{square}f 1 2 3 4\nt interpolateboundary 1/0/0 0\n"),
            "every face touches a boundary, and the boundary rule is none",
        ),
    ];
    for (model, text, expected) in &cases {
        folder.write(model, text);
        let is_lost = model.starts_with("all_lost");
        for shape in all_kinds().filter(|shape| !is_lost || OF_POLYGONS.contains(shape)) {
            refused(&folder, model, shape, &["s.ron:1:", expected]);
            assert!(
                is_lost || folder.open(model, shape).unwrap_err().contains(model),
                "{model}"
            );
        }
    }
}
