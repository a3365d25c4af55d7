//! Readers against small files written here, against other readers, and against broken files.

use super::*;
use glam::{DVec3, Vec3};
use std::path::PathBuf;

fn parse(name: &str, bytes: impl AsRef<[u8]>) -> Result<Model, String> {
    decode(Path::new(name), bytes.as_ref(), &ModelOptions::default()).map_err(|e| e.to_string())
}

fn error(name: &str, bytes: impl AsRef<[u8]>) -> String {
    parse(name, bytes).map(|m| m.mesh.faces.len()).unwrap_err()
}

fn said(model: &Model, text: &str) -> bool {
    model.notes.iter().any(|note| note.text.contains(text))
}

/// Two quads and a triangle, with colours, texture coordinates and normals.
const OBJ: &str = "# a comment\nmtllib no.mtl\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 1\n\
    v 2 0 0 1 1 1\nv 2 1 0 1 1 1\nv 3 0.5 0 1 1 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 2\n\
    f 1/1/1 2/2/1 3/3/1 4/4/1\nf 2/1/1 5/2/1 \\\n6/3/1 3/4/1\nf -3/1/1 -1/2/1 -2/3/1\n";

#[test]
fn obj_keeps_polygons_and_corner_attributes() {
    let model = parse("a.obj", OBJ).unwrap();
    let faces: Vec<Vec<u32>> = model.mesh.faces.iter().map(<[u32]>::to_vec).collect();
    assert_eq!(faces, [vec![0, 1, 2, 3], vec![1, 4, 5, 2], vec![4, 6, 5]]);
    assert_eq!(model.mesh.corners.uvs.as_ref().unwrap()[2], [1.0, 1.0]);
    assert_eq!(model.mesh.corners.normals.as_ref().unwrap()[10], [0.0, 0.0, 1.0]);
    assert_eq!(model.mesh.corners.colours.as_ref().unwrap()[1], [0.0, 1.0, 0.0, 1.0]);
    assert!(said(&model, "no.mtl"));
}

#[test]
fn obj_errors_name_the_line() {
    let of = |from: &str, to: &str| error("a.obj", OBJ.replace(from, to));
    assert!(of("v 2 1 0", "v 2 nan 0").starts_with("a.obj: line 8: v is NaN"));
    assert!(of("v 2 1 0", "v 2 one 0").contains("line 8: 'one'"));
    assert!(of("v 2 1 0 1 1 1", "v 2 1").contains("line 8: 'v' needs at least 3"));
    assert!(of("v 2 1 0", "v 2 1e300 0").contains("line 8"));
    assert!(of("f 1/1/1", "f 99/1/1").contains("line 15: vertex 99 is out of range: there are 7"));
    assert!(of("f 1/1/1", "f 0/1/1").contains("line 15: vertex 0 is out of range"));
    assert!(of("f -3/1/1", "f -8/1/1").contains("line 18: vertex -8 is out of range"));
    assert!(of("f 2/1/1 5/2/1", "f 9/1/1 5/2/1").contains("line 16: vertex 9"));
    assert!(of("f 1/1/1", "f 1/9/1").contains("texture coordinate 9 is out of range"));
    assert!(of("f 1/1/1 2/2/1 3/3/1 4/4/1", "f 1 2").contains("at least 3 corners"));
    assert!(error("a.obj", "v 0 0 0\n").contains("no faces"));
    assert!(error("a.obj", "f 1 2 \\").contains("continuation"));
}

#[test]
fn non_manifold_edges_and_turned_faces_name_their_lines() {
    let fan = "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 0 1 0\nv -1 0 0\nf 1 2 3\nf 2 1 4\nf 1 2 5\n";
    let message = error("fan.obj", fan);
    assert!(
        message.contains("used by 3 faces") && message.contains("line 6, line 7, line 8"),
        "{message}"
    );
    let turned = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 3 4\n";
    assert!(error("t.obj", turned).contains("line 5, line 6"));
}

#[test]
fn stl_soup_is_welded_to_a_closed_cube() {
    let mut text = String::from("solid cube\n");
    for axis in 0..3 {
        for side in [0.0, 1.0] {
            let corner = |a: f64, b: f64| {
                let mut p = [0.0; 3];
                (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) = (side, a, b);
                // The negative zero is another bit pattern of the same position.
                p.map(|c| if c == 0.0 && side == 1.0 { -0.0 } else { c })
            };
            let mut quad = [corner(0., 0.), corner(1., 0.), corner(1., 1.), corner(0., 1.)];
            if side == 0.0 {
                quad.reverse();
            }
            for t in [[0, 1, 2], [0, 2, 3]] {
                text += "facet normal 0 0 0\nouter loop\n";
                t.iter()
                    .for_each(|&i| text += &format!("vertex {} {} {}\n", quad[i][0], quad[i][1], quad[i][2]));
                text += "endloop\nendfacet\n";
            }
        }
    }
    text += "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\nendsolid\n";
    let model = parse("cube.stl", text).unwrap();
    assert_eq!((model.mesh.positions.len(), model.mesh.faces.len()), (8, 12));
    assert!(
        model
            .mesh
            .positions
            .iter()
            .all(|p| p.to_array().iter().all(|c| c.is_sign_positive()))
    );
    let topology = keyleaf_key::Topology::new(8, model.mesh.faces.iter()).unwrap();
    assert!((0..12).all(|face| (0..3).all(|root| topology.twin(face, root).is_some())));
    assert!(said(&model, "are welded") && said(&model, "1 face has fewer than 3"));
}

#[test]
fn concave_polygons_are_triangulated_and_convex_ones_kept() {
    let text = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 3 1 0\nv 4 -3 0\nv 2 -4 0\nv 0 -3 0\nf 1 2 4 3\nf 1 7 6 5 2\n";
    let model = parse("dart.obj", text).unwrap();
    let sizes: Vec<usize> = model.mesh.faces.iter().map(<[u32]>::len).collect();
    assert_eq!(sizes, [3, 3, 5]);
    assert!(said(&model, "1 face is not convex"));
}

#[test]
fn doubled_faces_and_unused_vertices_are_dropped() {
    let text = "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\nf 3 4 2\n";
    let model = parse("d.obj", text).unwrap();
    assert_eq!((model.mesh.positions.len(), model.mesh.faces.len()), (3, 1));
    assert!(said(&model, "there twice") && said(&model, "1 vertex has no face"));
}

#[test]
fn stated_topology_wins_where_welding_gives_no_surface() {
    // Two tetrahedra that touch along an edge, each with its own vertices.
    let tetrahedron = |z: i32| format!("v 0 0 0\nv 1 0 0\nv 0 1 {z}\nv 1 1 {z}\n");
    let mut text = tetrahedron(1) + &tetrahedron(-1);
    text = text.replace("v 1 1 1", "v 0 2 1").replace("v 1 1 -1", "v 0 2 -1");
    text += "f 1 2 3\nf 1 4 2\nf 2 4 3\nf 1 3 4\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 5 8 7\n";
    let model = parse("two.obj", &text).unwrap();
    assert_eq!(model.mesh.positions.len(), 8);
    assert!(said(&model, "not welded"));
}

fn ply(format: &str, body: &[u8]) -> Vec<u8> {
    let header = format!(
        "ply\nformat {format} 1.0\ncomment by a test\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
         property uchar red\nproperty uchar green\nproperty uchar blue\nelement extra 1\nproperty list uchar int a\n\
         element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    );
    [header.as_bytes(), body].concat()
}

fn binary_ply(big: bool) -> Vec<u8> {
    let mut body = Vec::new();
    let word = |bytes: [u8; 4]| {
        let mut bytes = bytes.to_vec();
        if big {
            bytes.reverse();
        }
        bytes
    };
    for p in [[0.0f32, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.5]] {
        p.iter().for_each(|c| body.extend(word(c.to_le_bytes())));
        body.extend([255, 0, 128]);
    }
    body.push(2);
    [7i32, 8].iter().for_each(|i| body.extend(word(i.to_le_bytes())));
    body.push(4);
    [0i32, 1, 2, 3].iter().for_each(|i| body.extend(word(i.to_le_bytes())));
    ply(
        if big {
            "binary_big_endian"
        } else {
            "binary_little_endian"
        },
        &body,
    )
}

const PLY_TEXT: &str = "0 0 0 255 0 128\n1 0 0 255 0 128\n1 1 0 255 0 128\n0 1 0.5 255 0 128\n2 7 8\n4 0 1 2 3\n";

#[test]
fn ply_text_and_binary_of_both_orders_are_the_same() {
    let text = parse("a.ply", ply("ascii", PLY_TEXT.as_bytes())).unwrap();
    assert_eq!(text.mesh.faces.iter().next(), Some(&[0, 1, 2, 3][..]));
    let colour = text.mesh.corners.colours.as_ref().unwrap()[0];
    assert!(colour[0] == 1.0 && (colour[2] - 0.2158).abs() < 1e-3, "{colour:?}");
    for big in [false, true] {
        assert_eq!(parse("b.ply", binary_ply(big)).unwrap().mesh, text.mesh);
    }
    assert!(said(&text, "'extra' is not read"));
}

#[test]
fn ply_errors_name_line_or_byte() {
    let of = |from: &str, to: &str| error("a.ply", ply("ascii", PLY_TEXT.replace(from, to).as_bytes()));
    assert!(of("4 0 1 2 3", "4 0 1 2 9").contains("line 21: vertex 9 is out of range: there are 4"));
    assert!(of("4 0 1 2 3", "4 0 1 2").contains("ends before"));
    assert!(of("4 0 1 2 3", "2 0 1").contains("at least 3 corners"));
    assert!(of("1 1 0 255", "1 inf 0 255").contains("vertex 2: position is inf"));
    assert!(error("a.ply", "ply\nformat ascii 1.0\n").contains("line 3: the file ends before 'end_header'"));
    assert!(error("a.ply", "solid").contains("not a PLY file"));
    let huge = String::from_utf8(ply("ascii", b"0 0 0 1 1 1\n"))
        .unwrap()
        .replace("vertex 4", "vertex 99999999999999");
    assert!(error("a.ply", huge).contains("ends before"));
}

#[test]
fn truncated_and_damaged_files_never_panic() {
    let samples: [(&str, Vec<u8>); 5] = [
        ("a.obj", OBJ.as_bytes().to_vec()),
        ("a.ply", ply("ascii", PLY_TEXT.as_bytes())),
        ("a.ply", binary_ply(false)),
        ("a.glb", super::gltf_tests::glb()),
        ("a.gltf", super::gltf_tests::json(true).into_bytes()),
    ];
    for (name, bytes) in &samples {
        for length in 0..bytes.len() {
            let _ = parse(name, &bytes[..length]);
        }
        // A simple generator: the same damage in every run.
        let mut state = 1u64;
        let mut random = |below: usize| {
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (state >> 33) as usize % below
        };
        for _ in 0..3000 {
            let mut damaged = bytes.clone();
            for _ in 0..1 + random(3) {
                let at = random(damaged.len());
                damaged[at] = [random(256) as u8, b'9', b'-', 0, 255][random(5)];
            }
            let _ = parse(name, &damaged);
        }
    }
}

/// The folder of models that are not part of the project.
fn shared() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/subd");
    if folder.is_dir() {
        return Some(folder);
    }
    println!("skipped: there is no {}", folder.display());
    None
}

#[test]
fn real_models_agree_with_another_reader() {
    let Some(folder) = shared() else { return };
    let files = [folder.clone(), folder.join("osd_shapes")]
        .into_iter()
        .flat_map(|f| std::fs::read_dir(f).unwrap());
    let mut compared = 0;
    for file in files.map(|f| f.unwrap().path()).filter(|f| extension(f) == "obj") {
        let (models, _) = tobj::load_obj(&file, &tobj::LoadOptions::default()).unwrap();
        let corners: usize = models.iter().map(|m| m.mesh.indices.len()).sum();
        let sum: Vec3 = models
            .iter()
            .flat_map(|m| {
                m.mesh
                    .indices
                    .iter()
                    .map(|&i| Vec3::from_slice(&m.mesh.positions[3 * i as usize..]))
            })
            .sum();
        match read_model(&file, &ModelOptions::default()) {
            Ok(model) if !said(&model, "not convex") => {
                let own: DVec3 = model
                    .mesh
                    .faces
                    .iter()
                    .flatten()
                    .map(|&v| model.mesh.positions[v as usize])
                    .sum();
                assert_eq!(model.mesh.faces.corner_count(), corners, "{}", file.display());
                assert!(
                    (own.as_vec3() - sum).length() < 1e-3 * (1.0 + corners as f32),
                    "{}",
                    file.display()
                );
                compared += 1;
            }
            Ok(model) => println!("{:?}", model.notes),
            Err(error) => {
                assert!(error.to_string().contains("used by"), "{error}");
                assert!(
                    file.to_string_lossy().contains("nonman_edges")
                        || ["loop_val2_interior.obj", "catmark_fan.obj"]
                            .iter()
                            .any(|f| file.ends_with(f)),
                    "{error}"
                );
            }
        }
    }
    assert!(compared > 35, "{compared}");
}
