//! Scenes of control meshes: shapes, sharpness, motion, and what is refused.

use super::*;

/// Every shape whose polygons are a control mesh, on lines that the tests name.
const FULL: &str = r#"(
    surfaces: [
        (name: "cc", source: Mesh("a.obj"), surface: CatmullClark(
            isolation: 5,
            sharpness: (boundary: EdgesAndCorners, creasing: Chaikin, creases: [(0, 1, 2.5), (1, 2, 10)], corners: [(3, 1)]),
        )),
        (name: "loop", source: Mesh("a.obj"), surface: Loop(weights: Warren, isolation: 16)),
        (name: "qas", source: Mesh("a.obj"), surface: Qas(variant: Interpolating)),
        (name: "pn", source: Mesh("a.obj"), surface: PnTriangles, material: (matcap: "clay.png")),
        (name: "gauss", source: Mesh("a.obj"), surface: GaussianProduct(
            scheme: LoopWarren,
            covariances: FromNormals(factor: 0.4, flatness: 0.2),
            strict: true,
            solver: Adjugate,
        )),
        (name: "file", source: Mesh("a.obj"), surface: GaussianProduct(covariances: File("b.cov"))),
        (name: "ball", source: Mesh("a.obj"), surface: GaussianProduct(covariances: Isotropic(0.5))),
        (name: "moving", source: Mesh("a.obj"), surface: CatmullClark(), motion: Keys([
            Blend(path: "b.obj", keys: [(time: 0), (time: 1, weight: 0.5, ease: Smooth)], looped: true),
            Group(name: "hip", pivot: (0, 1, 0), keys: [(time: 0, translation: (0, 0.1, 0)), (time: 2, scale: 2)]),
            Group(name: "leg", parent: "hip", vertices: [(0, 3), (7, 7)], keys: [(time: -1, rotation: (0, 90, 0))], looped: true),
        ])),
    ],
)"#;

fn read(text: &str) -> Result<Scene, String> {
    Scene::from_ron(text, Path::new("s.ron")).map_err(|e| e.to_string())
}

#[test]
fn every_field_is_read_and_written_back() {
    let scene = read(FULL).unwrap();
    let Shape::CatmullClark(shape) = &scene.surfaces[0].surface else {
        panic!()
    };
    assert_eq!((shape.isolation, shape.sharpness.creases[0]), (5, (0, 1, 2.5)));
    assert_eq!(scene.surfaces[3].surface, Shape::PnTriangles);
    let Motion::Keys(tracks) = &scene.surfaces[7].motion else {
        panic!()
    };
    assert_eq!(tracks.len(), 3);
    let text = scene.to_ron().unwrap();
    assert_eq!(read(&text).unwrap(), scene, "{text}");
}

#[test]
fn the_name_of_a_shape_suffices() {
    for name in [
        "CatmullClark()",
        "Loop()",
        "Qas()",
        "PnTriangles",
        "GaussianProduct()",
        "Flat",
    ] {
        let text = format!("(surfaces: [(name: \"a\", source: Mesh(\"a.obj\"), surface: {name})])");
        let scene = read(&text).unwrap();
        assert_eq!(scene.surfaces[0].surface.name(), name.trim_end_matches("()"));
        assert_eq!(read(&scene.to_ron().unwrap()).unwrap(), scene);
    }
    for name in ShapeName::ALL {
        assert_eq!(name.as_str().parse(), Ok(name));
    }
    let error = "round".parse::<ShapeName>().unwrap_err().to_string();
    assert!(
        error.contains("'round' is no kind of surface; expected one of flat, catmull-clark"),
        "{error}"
    );
    assert_eq!(Shape::from(ShapeName::Loop), Shape::Loop(LoopShape::default()));
}

#[test]
fn values_out_of_range_tell_line_and_field() {
    let cases = [
        (
            "isolation: 5",
            "isolation: 17",
            "s.ron:4:24: surfaces[0].surface.isolation: 17 is not allowed",
        ),
        (
            "(1, 2, 10)",
            "(1, 0, 10)",
            "surfaces[0].surface.sharpness.creases[1]: the crease from vertex 1 to vertex 0 is there twice",
        ),
        (
            "(1, 2, 10)",
            "(2, 2, 10)",
            "creases[1]: a crease from vertex 2 to itself",
        ),
        (
            "(0, 1, 2.5)",
            "(0, 1, -1)",
            "s.ron:5:81: surfaces[0].surface.sharpness.creases[0]: the sharpness -1",
        ),
        ("(3, 1)]", "(3, inf)]", "surfaces[0].surface.sharpness.corners[0]: inf"),
        (
            "(3, 1)]",
            "(3, 1), (3, 2)]",
            "corners[1]: the corner at vertex 3 is there twice",
        ),
        (
            "boundary: EdgesAndCorners",
            "boundary: Sharp",
            "expected one of `NotDrawn`, `Edges`, `EdgesAndCorners`",
        ),
        ("factor: 0.4", "factor: 0", "surfaces[4].surface.covariances.factor: 0"),
        (
            "flatness: 0.2",
            "flatness: 2",
            "surfaces[4].surface.covariances.flatness: 2 is not allowed",
        ),
        (
            "File(\"b.cov\")",
            "File(\"\")",
            "surfaces[5].surface.covariances: expected the path",
        ),
        ("Isotropic(0.5)", "Isotropic(-1)", "surfaces[6].surface.covariances: -1"),
        ("scheme: LoopWarren", "scheme: Quad", "unknown choice `Quad`"),
        (
            "weight: 0.5",
            "weight: NaN",
            "surfaces[7].motion[0].keys[1].weight: NaN",
        ),
        (
            "(time: 0), (time: 1",
            "(time: 1), (time: 1",
            "surfaces[7].motion[0].keys[1].time: 1 is not later",
        ),
        ("scale: 2", "scale: 0", "surfaces[7].motion[1].keys[1].scale: 0"),
        ("(time: -1,", "(time: inf,", "surfaces[7].motion[2].keys[0].time: inf"),
        (
            "parent: \"hip\"",
            "parent: \"leg\"",
            "surfaces[7].motion[2].parent: no group before this one has the name `leg`",
        ),
        (
            "name: \"leg\"",
            "name: \"hip\"",
            "surfaces[7].motion[2].name: the name `hip` is there twice",
        ),
        ("(7, 7)", "(7, 6)", "surfaces[7].motion[2].vertices[1]: (7, 6)"),
        (
            "path: \"b.obj\"",
            "path: \" \"",
            "surfaces[7].motion[0].path: expected the path",
        ),
        (
            "surface: CatmullClark(), motion",
            "motion",
            "surfaces[7].motion: only a control mesh can move",
        ),
        (
            "matcap: \"clay.png\"",
            "matcap: \"clay.png\", texture: \"a.png\"",
            "surfaces[3].material.matcap: a texture and a matcap",
        ),
        (
            "matcap: \"clay.png\"",
            "matcap: \"clay.png\", colouring: Terrain()",
            "surfaces[3].material.matcap: a matcap, and colours",
        ),
        (
            "source: Mesh(\"a.obj\"), surface: PnTriangles",
            "source: Terrain(), surface: PnTriangles",
            "only a Mesh can be PnTriangles; expected Flat",
        ),
    ];
    for (from, to, expected) in cases {
        assert!(FULL.contains(from), "{from}");
        let error = read(&FULL.replacen(from, to, 1)).unwrap_err();
        assert!(error.contains(expected), "{to}: {error}");
    }
    let empty = "(surfaces: [(name: \"a\", source: Mesh(\"a\"), surface: Loop(), motion: Keys([]))])";
    assert!(
        read(empty)
            .unwrap_err()
            .contains("surfaces[0].motion: the list is empty")
    );
}
