//! PLY, as text.

use std::io::{self, Write};

use super::ExportMesh;

pub(super) fn write(out: &mut impl Write, mesh: &ExportMesh<'_>) -> io::Result<()> {
    let properties: &[&str] = match mesh.normals {
        None => &["x", "y", "z"],
        Some(_) => &["x", "y", "z", "nx", "ny", "nz"],
    };
    writeln!(
        out,
        "ply\nformat ascii 1.0\ncomment keyleaf\nelement vertex {}",
        mesh.positions.len()
    )?;
    for property in properties {
        writeln!(out, "property float {property}")?;
    }
    writeln!(out, "element face {}", mesh.triangles.len())?;
    writeln!(out, "property list uchar int vertex_indices\nend_header")?;
    for (i, [x, y, z]) in mesh.positions.iter().enumerate() {
        match mesh.normals.and_then(|normals| normals.get(i)) {
            None => writeln!(out, "{x} {y} {z}")?,
            Some([nx, ny, nz]) => writeln!(out, "{x} {y} {z} {nx} {ny} {nz}")?,
        }
    }
    for [a, b, c] in mesh.triangles {
        writeln!(out, "3 {a} {b} {c}")?;
    }
    Ok(())
}
