//! What is written reads back with the same bits, and nothing is left behind when it fails.

use super::*;
use crate::model::{ModelOptions, read_model};

fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("keyleaf-export-{name}-{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// Numbers that few digits would not keep: neighbours in f32, the smallest, the largest that models allow.
const POSITIONS: [[f32; 3]; 4] = [
    [0.1, 16_777_217.0, -1.0e-45],
    [0.100_000_01, 1.0 / 3.0, 9.9e14],
    [-123.456_79, f32::MIN_POSITIVE, 0.3],
    [7.0, 1.0e-7, 2.5],
];
const TETRAHEDRON: [[u32; 3]; 4] = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]];

fn mesh(normals: bool) -> ExportMesh<'static> {
    const NORMALS: [[f32; 3]; 4] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.6, 0.8, 0.0]];
    ExportMesh {
        positions: &POSITIONS,
        normals: normals.then_some(&NORMALS[..]),
        triangles: &TETRAHEDRON,
    }
}

#[test]
fn written_positions_read_back_with_the_same_bits() {
    let folder = folder("bits");
    for name in ["a.obj", "a.ply", "a.stl"] {
        for normals in [false, true] {
            let file = folder.join(name);
            write_mesh(&file, &mesh(normals)).unwrap();
            let model = read_model(&file, &ModelOptions::default()).unwrap();
            let bits = |v: glam::DVec3| v.as_vec3().to_array().map(f32::to_bits);
            let read: Vec<_> = model
                .mesh
                .faces
                .iter()
                .map(|f| [f[0], f[1], f[2]].map(|v| bits(model.mesh.positions[v as usize])))
                .collect();
            let written = TETRAHEDRON.map(|t| t.map(|v| POSITIONS[v as usize].map(f32::to_bits)));
            assert_eq!(read, written, "{name}");
            assert_eq!(model.mesh.corners.normals.is_some(), normals && name != "a.stl");
        }
    }
    assert_eq!(
        std::fs::read_dir(&folder).unwrap().count(),
        3,
        "no temporary file is left"
    );
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn stl_is_read_by_another_program() {
    let mut bytes = Vec::new();
    stl::write(&mut bytes, &mesh(false)).unwrap();
    let read = stl_io::read_stl(&mut io::Cursor::new(bytes)).unwrap();
    assert_eq!((read.faces.len(), read.vertices.len()), (4, 4));
}

#[test]
fn failure_leaves_what_was_there() {
    let folder = folder("failure");
    let file = folder.join("a.obj");
    std::fs::write(&file, "before").unwrap();
    let nan = ExportMesh {
        positions: &[[f32::NAN; 3]],
        ..ExportMesh::default()
    };
    assert!(
        write_mesh(&file, &nan)
            .unwrap_err()
            .to_string()
            .contains("position 0 is not finite")
    );
    let beyond = ExportMesh {
        triangles: &[[0, 1, 9]],
        ..mesh(false)
    };
    assert!(
        write_mesh(&file, &beyond)
            .unwrap_err()
            .to_string()
            .contains("triangle 0")
    );
    let few = ExportMesh {
        normals: Some(&[]),
        ..mesh(false)
    };
    assert!(matches!(write_mesh(&file, &few), Err(ExportError::Inconsistent { .. })));
    let broken = write_whole(&file, |out| {
        io::Write::write_all(out, b"half of it")?;
        Err(io::Error::other("full"))
    });
    assert!(broken.is_err());
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "before");
    assert!(matches!(
        write_mesh(&folder.join("no/a.obj"), &mesh(false)),
        Err(ExportError::Write { .. })
    ));
    assert!(matches!(
        write_mesh(&folder.join("a.fbx"), &mesh(false)),
        Err(ExportError::UnknownExtension { .. })
    ));
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 1);
    std::fs::remove_dir_all(folder).unwrap();
}
