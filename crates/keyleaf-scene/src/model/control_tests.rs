//! Control meshes: what is kept, tags, covariances, OFF files, and what is refused.

use super::control::decode;
use super::*;
use glam::DVec3;
use keyleaf_surface::{BoundaryRule, Corner, Crease, Creasing};

fn parse(name: &str, text: &str) -> Result<ControlModel, String> {
    decode(Path::new(name), text.as_bytes(), &ControlMeshOptions::default()).map_err(|e| e.to_string())
}

fn error(name: &str, text: &str) -> String {
    parse(name, text).map(|m| m.control.mesh.faces.len()).unwrap_err()
}

fn said(model: &ControlModel, text: &str) -> bool {
    model.notes.iter().any(|note| note.text.contains(text))
}

/// A concave quad and a triangle, with an unused vertex before them and one at the same position as another after them.
const OBJ: &str =
    "v 9 9 9\nv 0 0 0\nv 2 1 0\nv 0 2 0\nv 0.5 1 0\nv 3 3 0\nv -0 0 0\nf 2 3 4 5\nf 4 3 6\nt crease 2/1/0 2 3 2.5\n";

fn with(tag: &str) -> String {
    format!("{OBJ}{tag}\n")
}

#[test]
fn obj_keeps_concave_faces_and_the_numbers_of_its_vertices() {
    let model = parse("a.obj", OBJ).unwrap();
    let faces: Vec<Vec<u32>> = model.control.mesh.faces.iter().map(<[u32]>::to_vec).collect();
    assert_eq!(faces, [vec![1, 2, 3, 4], vec![3, 2, 5]]);
    assert_eq!(model.control.mesh.positions.len(), 7);
    assert!(model.control.mesh.positions[6].x.is_sign_positive());
    assert!(said(&model, "position of another one: 1"));
    assert!(model.covariances.is_none());
    // For flat drawing the quad is cut and the vertices are dropped.
    let flat = super::decode(Path::new("a.obj"), OBJ.as_bytes(), &ModelOptions::default()).unwrap();
    assert_eq!((flat.mesh.faces.len(), flat.mesh.positions.len()), (3, 5));
}

#[test]
fn tags_become_creases_corners_and_rules() {
    let text = with(
        "t crease 4/2/0 3 2 1 2 4 0.5\nt corner 2/1/0 5 1 10\nt interpolateboundary 1/0/0 1\nt creasemethod 0/0/1 chaikin\n\
         t facevaryinginterpolateboundary 1/0/0 2\nt smoothtriangles 1/0/0 1\nt hole 1/0/0 0",
    );
    let model = parse("a.obj", &text).unwrap();
    let crease = |a, b, sharpness| Crease {
        vertices: [a, b],
        sharpness,
    };
    // The later one of an edge counts.
    assert_eq!(model.control.creases, [crease(3, 2, 4.0), crease(1, 2, 0.5)]);
    let corner = |vertex| Corner {
        vertex,
        sharpness: 10.0,
    };
    assert_eq!(model.control.corners, [corner(5), corner(1)]);
    assert_eq!(model.control.boundary, BoundaryRule::EdgesAndCorners);
    assert_eq!(model.control.creasing, Creasing::Chaikin);
    assert!(said(&model, "tag 'hole' is not applied") && said(&model, "'facevaryinginterpolateboundary'"));
    let rule = |n: u32| {
        parse("a.obj", &with(&format!("t interpolateboundary 1/0/0 {n}")))
            .unwrap()
            .control
            .boundary
    };
    assert_eq!(
        [0, 1, 2].map(rule),
        [BoundaryRule::None, BoundaryRule::EdgesAndCorners, BoundaryRule::Edges]
    );
    let options = ControlMeshOptions {
        boundary: Some(BoundaryRule::None),
        creasing: Some(Creasing::Uniform),
        ..ControlMeshOptions::default()
    };
    let model = decode(Path::new("a.obj"), text.as_bytes(), &options).unwrap().control;
    assert_eq!(
        (model.boundary, model.creasing),
        (BoundaryRule::None, Creasing::Uniform)
    );
}

#[test]
fn a_sharpness_of_zero_makes_an_edge_smooth_again() {
    let model = parse("a.obj", &with("t crease 2/1/0 3 2 0")).unwrap();
    assert!(model.control.creases.is_empty());
}

#[test]
fn malformed_tags_tell_their_line() {
    let cases = [
        ("t", "line 11: a tag without a name"),
        ("t crease", "line 11: tag 'crease': expected how many"),
        (
            "t crease 2/1 2 3 1",
            "expected how many integers, numbers and strings follow, as in 2/1/0, found '2/1'",
        ),
        (
            "t crease 2/1/0 2 3",
            "2/1/0 announces other values than the 2 that follow",
        ),
        ("t crease 18446744073709551615/9/9 2", "announces other values"),
        (
            "t crease 2/1/0 2 3.5 1",
            "'3.5' is no number of the kind that 2/1/0 says",
        ),
        ("t crease 3/1/0 2 3 4 1", "3 vertices; expected pairs"),
        (
            "t crease 2/1/0 2 7 1",
            "line 11: vertex (tags count from 0) 7 is out of range: there are 7",
        ),
        ("t crease 2/1/0 -1 2 1", "vertex (tags count from 0) -1 is out of range"),
        (
            "t crease 2/1/0 2 4 1",
            "line 11: the crease from vertex 2 to vertex 4, counted from 0, is no edge",
        ),
        (
            "t crease 2/3/0 2 3 1 1 1",
            "3 sharpnesses for 1; expected one, or one each",
        ),
        ("t crease 2/1/0 2 3 nan", "line 11: sharpness is NaN"),
        ("t corner 1/1/0 2 -1", "tag 'corner': the sharpness -1 is below 0"),
        ("t corner 0/1/0 2", "no vertex; expected at least one"),
        (
            "t interpolateboundary 1/0/0 3",
            "expected one of 0 (none), 1 (edges and corners), 2 (edges)",
        ),
        ("t creasemethod 0/0/1 catmull", "expected one of normal, chaikin"),
    ];
    for (tag, expected) in cases {
        let message = error("a.obj", &with(tag));
        assert!(
            message.starts_with("a.obj: line 11: ") && message.contains(expected),
            "{tag}: {message}"
        );
    }
}

#[test]
fn what_is_no_surface_tells_its_lines() {
    assert!(error("a.obj", "v 0 0 0\n").contains("no faces"));
    let fan = "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 0 1 0\nv -1 0 0\nf 1 2 3\nf 2 1 4\nf 1 2 5\n";
    assert!(error("a.obj", fan).contains("line 6, line 7, line 8"));
    assert!(error("a.obj", "v 0 0 0\nv 0 0 1\nv 1 0 0\nf 1 2 3 2\n").contains("(in the file: line 4)"));
}

const OFF: &str =
    "# by hand\nOFF # text\n5 2 6\n0 0 0\n1 0 0\n\n1 1 0\n0 1 0\n7 7 7 # unused\n3 0 1 2\n3 0 2 3 255 0 0\n";

#[test]
fn off_is_read_flat_and_as_a_control_mesh() {
    let model = parse("a.off", OFF).unwrap();
    assert_eq!(model.control.mesh.positions.len(), 5);
    assert_eq!(model.control.mesh.faces.get(1), Some(&[0, 2, 3][..]));
    assert!(said(&model, "colours of faces are not read: 1"));
    let flat = super::decode(Path::new("a.off"), OFF.as_bytes(), &ModelOptions::default()).unwrap();
    assert_eq!(flat.mesh.positions.len(), 4);
    let one_line = parse("a.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").unwrap();
    assert_eq!(one_line.control.mesh.faces.len(), 1);
}

#[test]
fn off_has_covariances_colours_and_normals() {
    let columns = |keyword: &str, more: &str| {
        let vertex = |x: u32, y: u32| format!("{x} {y} 0 {more}\n");
        let text = format!(
            "{keyword}\n3 1 0\n{}{}{}3 0 1 2\n",
            vertex(0, 0),
            vertex(1, 0),
            vertex(0, 1)
        );
        parse("a.off", &text)
    };
    let covariance = columns("OFF", "4 0.5 0 3 0 2").unwrap();
    assert_eq!(covariance.covariances.unwrap(), [[4.0, 0.5, 0.0, 3.0, 0.0, 2.0]; 3]);
    let bytes = columns("COFF", "255 0 51 255").unwrap();
    let floats = columns("OFF", "1 0 0.2").unwrap();
    assert_eq!(bytes.control.mesh.corners.colours, floats.control.mesh.corners.colours);
    assert_eq!(bytes.control.mesh.corners.colours.unwrap()[0][0], 1.0);
    let all = columns("CNOFF", "0 0 2 1 1 1 1 4 0 0 4 0 4").unwrap();
    assert_eq!(all.control.mesh.corners.normals.unwrap()[2], [0.0, 0.0, 1.0]);
    assert_eq!(all.covariances.unwrap()[1][5], 4.0);
    assert!(
        columns("OFF", "1 2")
            .unwrap_err()
            .contains("line 3: a vertex with 5 numbers; expected 3 coordinates")
    );
    assert!(columns("COFF", "").unwrap_err().contains("a colour of 3 or 4 numbers"));
}

#[test]
fn off_errors_name_the_line() {
    let of = |from: &str, to: &str| error("a.off", &OFF.replacen(from, to, 1));
    assert!(error("a.off", "").contains("line 1: the file ends where the keyword OFF was expected"));
    assert!(of("OFF #", "4OFF #").contains("line 2: '4OFF' is no keyword of OFF"));
    assert!(of("OFF #", "OFF BINARY #").contains("binary OFF files are not read"));
    assert!(of("5 2 6", "5").contains("line 3: expected the number of faces"));
    assert!(of("5 2 6", "-5 2 6").contains("expected the number of vertices"));
    assert!(of("1 0 0\n", "1 0 x\n").contains("line 5: 'x' is no number"));
    assert!(of("1 0 0\n", "1 0 nan\n").contains("line 5: position is NaN"));
    assert!(of("1 0 0\n", "1 0\n").contains("line 5: a vertex with 2 numbers; the first one has 3"));
    assert!(of("3 0 2 3", "3 0 2 5").contains("line 11: vertex 5 is out of range: there are 5"));
    assert!(of("3 0 2 3", "4 0 2 3").contains("line 11: vertex 255 is out of range"));
    assert!(of("3 0 1 2", "2 0 1").contains("line 10: a face needs at least 3 corners"));
    assert!(of("3 0 1 2\n", "3 0 1\n").contains("line 10: expected the vertex of a corner"));
    assert!(of("5 2 6", "5 3 6").contains("line 11: the file ends where a face was expected"));
    assert!(of("5 2 6", "99999999999 3 6").contains("line 10: a vertex with 4 numbers; the first one has 3"));
}

/// A folder of its own, removed when done.
struct Folder(std::path::PathBuf);

impl Folder {
    fn new(name: &str, files: &[(&str, &str)]) -> Self {
        let folder = std::env::temp_dir().join(format!("keyleaf-control-{name}-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        for (file, text) in files {
            std::fs::write(folder.join(file), text).unwrap();
        }
        Self(folder)
    }

    fn read(&self, model: &str, covariances: CovarianceSource) -> Result<ControlModel, String> {
        let options = ControlMeshOptions {
            covariances,
            ..ControlMeshOptions::default()
        };
        read_control_mesh(&self.0.join(model), &options).map_err(|e| e.to_string())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

#[test]
fn covariances_are_found_in_the_model_beside_it_or_by_name() {
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let off = "OFF\n3 1 0\n0 0 0 2 0 0 2 0 2\n1 0 0 2 0 0 2 0 2\n0 1 0 2 0 0 2 0 2\n3 0 1 2\n";
    let cov = "covariances 3\n1 0 0 1 0 1\n1 0 0 1 0 1\n1 0 0 1 0 1\n";
    let folder = Folder::new(
        "found",
        &[
            ("a.obj", triangle),
            ("a.cov", cov),
            ("b.obj", triangle),
            ("c.off", off),
            ("c.cov", cov),
            ("few.cov", "covariances 2\n"),
        ],
    );
    let first = |model: ControlModel| model.covariances.map(|c| c[0][0]);
    let beside = folder.read("a.obj", CovarianceSource::Model).unwrap();
    assert_eq!(beside.covariance_file, Some(folder.0.join("a.cov")));
    assert_eq!(first(beside), Some(1.0));
    assert_eq!(first(folder.read("a.obj", CovarianceSource::IfAny).unwrap()), None);
    assert_eq!(first(folder.read("c.off", CovarianceSource::IfAny).unwrap()), Some(2.0));
    assert_eq!(first(folder.read("c.off", CovarianceSource::Model).unwrap()), Some(2.0));
    let named = CovarianceSource::File(folder.0.join("a.cov"));
    assert_eq!(first(folder.read("c.off", named.clone()).unwrap()), Some(1.0));
    assert_eq!(first(folder.read("b.obj", named).unwrap()), Some(1.0));
    let none = folder.read("b.obj", CovarianceSource::Model).unwrap_err();
    assert!(none.contains("expected the file b.cov beside it"), "{none}");
    let few = folder
        .read("b.obj", CovarianceSource::File(folder.0.join("few.cov")))
        .unwrap_err();
    assert!(
        few.contains("few.cov: line 1: the header says 2 vertices, the model has 3"),
        "{few}"
    );
}

#[test]
fn soups_are_welded_and_count_their_vertices_in_the_order_of_their_positions() {
    let facet = |points: [[f64; 3]; 3]| {
        let corner = |[x, y, z]: [f64; 3]| format!("vertex {x} {y} {z}\n");
        format!(
            "facet normal 0 0 0\nouter loop\n{}endloop\nendfacet\n",
            points.map(corner).concat()
        )
    };
    let [a, b, c, d] = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.5]];
    let text = format!(
        "solid\n{}{}{}endsolid\n",
        facet([a, b, c]),
        facet([a, c, d]),
        facet([d, d, a])
    );
    let model = parse("a.stl", &text).unwrap();
    assert_eq!(model.control.mesh.positions, [a, b, c, d].map(DVec3::from));
    assert_eq!(model.control.mesh.faces.len(), 2);
    assert!(said(&model, "welded to one with equal position: 5") && said(&model, "fewer than 3 different corners: 1"));
}

#[test]
fn damaged_control_meshes_never_panic() {
    let full = with("t corner 2/2/0 5 1 10 2\nt interpolateboundary 1/0/0 1\nt creasemethod 0/0/1 chaikin");
    let mut state = 3u64;
    let mut random = |below: usize| {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 33) as usize % below
    };
    for (name, text) in [("a.obj", full.as_str()), ("a.off", OFF)] {
        for length in 0..text.len() {
            let _ = parse(name, &text[..length]);
        }
        for _ in 0..3000 {
            let mut bytes = text.as_bytes().to_vec();
            for _ in 0..1 + random(3) {
                let at = random(bytes.len());
                bytes[at] = b"0123456789-/. \nt#"[random(17)];
            }
            let _ = parse(name, &String::from_utf8_lossy(&bytes));
        }
    }
}
